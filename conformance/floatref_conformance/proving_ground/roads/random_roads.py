"""Random roads of a spectrum: of any, of the classes of ISO 8608, and of Sayers' three terms.

A wheel path is a sum of waves k/P of Gaussian amplitudes, its period P at least twice the
road's length. With the one-sided density G(ν) in m³/cycle a wave has the variance G(ν)/P, so
a sum of independent white-noise sources is drawn by the sum of their densities.

Wheel paths a distance y apart have the coherence of an isotropic surface whose density falls
with the square of the wave number (Dodds and Robson 1973): γ(ν) = x·K1(x), x = 2πνy, which
is 0.98 at 100 m, 0.57 at 10 m and below 0.001 at 1 m for y = 1.72 m. With more than two wheel
paths each follows its neighbour on the right.

(2.1) with w = 2: G(ν) = G(ν0)·(ν/ν0)⁻², ν0 = 0.1 cycles/m. The geometric mean of class A is
16·10⁻⁶ m³ and quadruples from class to class. The standard's band is 0.011 to 2.83 cycles/m:
longer waves are left out, and the same line goes on to the grid's limit as texture.

(2.4): G(ν) = G_e + G_s/(2πν)² + G_a/(2πν)⁴, white noise in elevation, slope and spatial
acceleration. White elevation without an end would make a bed of spikes, so G_e holds up to
the shortest wave of interest, 0.14 m (section 2.1.5), and falls with the fourth power of the
wave number beyond, which bounds the slopes.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.special import k1

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.display.similar_names import suggest
from floatref_conformance.proving_ground.roads.road import (
    RUN_OUT_M,
    SPACING_M,
    START_M,
    Road,
    lateral_positions,
    points_of,
)
from floatref_conformance.proving_ground.roads.shaping import with_level_start

PERIOD_STEP_M = 100.0
ComplexArray = NDArray[np.complex128]
Density = Callable[[FloatArray], FloatArray]
"""One-sided elevation density in m³/cycle at wave numbers in cycles/m, both above zero."""


def coherence(wave_number: FloatArray, apart_m: float) -> FloatArray:
    """Return γ = x·K1(x), x = 2πν·apart, at wave numbers in cycles/m; 1 at wave number 0."""
    x = 2 * np.pi * np.asarray(wave_number, dtype=np.float64) * abs(apart_m)
    bent = np.where(x > 0, x, 1.0)
    return np.where(x > 0, np.minimum(bent * k1(bent), 1.0), 1.0)


def spectral_road(
    density: Density,
    length_m: float,
    seed: int,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Draw a road of the given density, usable up to ``length_m``, with a level start.

    A finer spacing adds short waves and leaves the others alone: amplitudes are drawn from
    the longest wave down. Raises InputError for impossible lengths or wheel paths.
    """
    sides = lateral_positions(tracks)
    points = points_of(length_m, spacing_m, start_m)
    reach_m = length_m + RUN_OUT_M - start_m
    period_m = PERIOD_STEP_M * float(np.ceil(2 * reach_m / PERIOD_STEP_M))
    periodic = round(period_m / spacing_m)
    wave_numbers = np.arange(1, (periodic + 1) // 2) / (periodic * spacing_m)
    size = np.sqrt(density(wave_numbers) / (periodic * spacing_m)) * periodic / 2
    waves = _coherent_waves(wave_numbers, sides, seed)
    elevation = {
        name: np.fft.irfft(np.concatenate([[0.0], size * waves[name]]), periodic)[:points]
        for name in sides
    }
    return with_level_start(Road(start_m, spacing_m, elevation, sides))


def _coherent_waves(
    wave_numbers: FloatArray, sides: Mapping[str, float], seed: int
) -> dict[str, ComplexArray]:
    """Return complex amplitudes of variance 1 per component for each wheel path."""
    names = sorted(sides, key=lambda name: sides[name])
    waves: dict[str, ComplexArray] = {}
    for place, child in enumerate(np.random.SeedSequence(seed).spawn(len(names))):
        pairs = np.random.default_rng(child).standard_normal((wave_numbers.size, 2))
        drawn = pairs[:, 0] - 1j * pairs[:, 1]
        if place > 0:
            right = names[place - 1]
            shared = coherence(wave_numbers, sides[names[place]] - sides[right])
            drawn = shared * waves[right] + np.sqrt(1 - shared**2) * drawn
        waves[names[place]] = drawn
    return waves


CLASSES = "ABCDEFGH"
REFERENCE_WAVE_NUMBER = 0.1
LOWEST_WAVE_NUMBER = 0.011
CLASS_A = 16e-6
"""Geometric mean of G(ν0) of class A, in m³/cycle."""


def class_density(road_class: str, wave_number: FloatArray) -> FloatArray:
    """Return (2.1), as (14) of Zhu, in m³/cycle at wave numbers in cycles/m.

    Raises InputError for an unknown class.
    """
    if len(road_class) != 1 or road_class not in CLASSES:
        raise InputError(f"ISO 8608 class {road_class}: unknown; choose one of A to H")
    level = CLASS_A * 4.0 ** CLASSES.index(road_class)
    line = level * (wave_number / REFERENCE_WAVE_NUMBER) ** -2.0
    return np.where(wave_number >= LOWEST_WAVE_NUMBER, line, 0.0)


def iso8608_road(
    road_class: str,
    length_m: float,
    seed: int,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Draw a road of class ``road_class`` ("A" to "H"), usable up to ``length_m``."""

    def density(wave_number: FloatArray) -> FloatArray:
        return class_density(road_class, wave_number)

    return spectral_road(density, length_m, seed, spacing_m, tracks, start_m)


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
            raise InputError(f"road case {case}: unknown; {suggest(case, CASES, 'choose from')}")
        case = CASES[case]
    return spectral_road(case.density, length_m, seed, spacing_m, tracks, start_m)
