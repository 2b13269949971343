"""A road of sine waves of known lengths, by which gain and phase are measured.

Their slopes have equal amplitudes: elevation falls with the wave number as that of a road does.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from floatref.values.arrays import FloatArray, frozen
from floatref_conformance.proving_ground.roads.road import (
    SPACING_M,
    START_M,
    Road,
    lateral_positions,
    points_of,
)
from floatref_conformance.proving_ground.roads.shaping import with_level_start

BEYOND_M, CUT_OFF_M = 137.16, 91.44
"""Three halves of the cut-off wavelength, and it (AASHTO M 328-14)."""
LONGEST_FLAT_M, SHORTEST_FLAT_M = 42.9, 0.6
"""The waveband of the IRI (section 2.1.3)."""
FLAT_WAVES = 32
"""So many waves lie in that band, five to an octave."""
WAVELENGTHS_M = frozen(
    [BEYOND_M, CUT_OFF_M, *np.geomspace(LONGEST_FLAT_M, SHORTEST_FLAT_M, FLAT_WAVES)]
)
"""Length of every wave in m, from the longest to the shortest."""
SHARED_FROM_M = 15.0
"""Waves of this length and longer are the same in all wheel paths, as those of real roads nearly
are: otherwise the body would roll with them, and its accelerometers with it against gravity."""
SLOPE = 1e-3
"""Amplitude of every wave's slope on the unscaled road."""


def sines_road(
    length_m: float,
    seed: int,
    spacing_m: float = SPACING_M,
    tracks: Sequence[str] | Mapping[str, float] = ("left", "right"),
    start_m: float = START_M,
) -> Road:
    """Make a road of the waves of `WAVELENGTHS_M`, usable up to ``length_m``.

    It fades in from the start of the grid on: under no sensor is it level, which to a device
    would look as if the sensor were stuck. ``seed`` draws the phases. Raises InputError for
    impossible lengths or wheel paths.
    """
    sides = lateral_positions(tracks)
    x = start_m + spacing_m * np.arange(points_of(length_m, spacing_m, start_m), dtype=np.float64)
    shared = _phases(seed)
    elevation = {}
    for place, name in enumerate(sides):
        own = np.where(WAVELENGTHS_M >= SHARED_FROM_M, shared, _phases(seed, place + 1))
        elevation[name] = _sum(x, own)
    return with_level_start(Road(start_m, spacing_m, elevation, sides), start_m)


def _phases(seed: int, place: int = 0) -> FloatArray:
    source = np.random.SeedSequence(seed, spawn_key=(place,))
    return np.random.default_rng(source).uniform(0.0, 2 * np.pi, WAVELENGTHS_M.size)


def _sum(x: FloatArray, phases: FloatArray) -> FloatArray:
    z = np.zeros(x.size)
    for wavelength, phase in zip(WAVELENGTHS_M, phases, strict=True):
        radian = 2 * np.pi / wavelength
        z += SLOPE / radian * np.sin(radian * x + phase)
    return z
