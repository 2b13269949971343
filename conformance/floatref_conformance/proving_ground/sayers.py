"""Roads of Sayers' three-term spectrum, with the four cases of Table 2.2.

(2.4): G(ν) = G_e + G_s/(2πν)² + G_a/(2πν)⁴, white noise in elevation, slope and spatial
acceleration. White elevation without an end would make a bed of spikes, so G_e holds up to
the shortest wave of interest, 0.14 m (section 2.1.5), and falls with the fourth power of the
wave number beyond, which bounds the slopes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.road import SPACING_M, START_M, Road
from floatref_conformance.proving_ground.spectral import spectral_road

SHORTEST_WHITE_WAVE_M = 0.14


@dataclass(frozen=True)
class SayersCoefficients:
    """Coefficients of (2.4).

    Attributes:
        acceleration: G_a, white spatial acceleration, in 1/(m·cycle).
        slope: G_s, white slope, in m/cycle.
        elevation: G_e, white elevation, in m³/cycle.
    """

    acceleration: float
    slope: float
    elevation: float

    def __post_init__(self) -> None:
        """Refuse negative coefficients and three zeros."""
        values = (self.acceleration, self.slope, self.elevation)
        if not np.isfinite(values).all() or min(values) < 0 or max(values) == 0:
            raise InputError(f"{self}: coefficients must not be negative, nor all zero")

    def density(self, wave_number: FloatArray) -> FloatArray:
        """Return (2.4) in m³/cycle at wave numbers in cycles/m, with G_e rolled off."""
        radian = 2 * np.pi * wave_number
        white = self.elevation / np.maximum(1.0, wave_number * SHORTEST_WHITE_WAVE_M) ** 4
        return np.asarray(white + self.slope / radian**2 + self.acceleration / radian**4)


CASES: Mapping[str, SayersCoefficients] = MappingProxyType(
    {
        "normal": SayersCoefficients(0.0, 20e-6, 0.0),
        "asphalt-long-waves": SayersCoefficients(7e-6, 20e-6, 0.0),
        "rough": SayersCoefficients(0.0, 100e-6, 1e-6),
        "limit": SayersCoefficients(0.0, 300e-6, 8e-6),
    }
)
"""Table 2.2."""


def sayers_road(
    case: str | SayersCoefficients,
    length_m: float,
    seed: int,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Draw a road of the spectrum (2.4), usable up to ``length_m``.

    ``case`` is a name of `CASES` or coefficients. InputError for an unknown name.
    """
    if isinstance(case, str):
        if case not in CASES:
            raise InputError(f"road case {case}: unknown; choose from {', '.join(CASES)}")
        case = CASES[case]
    return spectral_road(case.density, length_m, seed, spacing_m, tracks, start_m)
