"""Random roads of a given elevation spectrum, their wheel paths coherent at long waves.

A wheel path is a sum of waves k/P of Gaussian amplitudes, its period P at least twice the
road's length. With the one-sided density G(ν) in m³/cycle a wave has the variance G(ν)/P, so
a sum of independent white-noise sources is drawn by the sum of their densities.

Wheel paths a distance y apart have the coherence of an isotropic surface whose density falls
with the square of the wave number (Dodds and Robson 1973): γ(ν) = x·K1(x), x = 2πνy, which
is 0.98 at 100 m, 0.57 at 10 m and below 0.001 at 1 m for y = 1.72 m. With more than two wheel
paths each follows its neighbour on the right.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.special import k1

from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.road import (
    RUN_OUT_M,
    SPACING_M,
    START_M,
    Road,
    lateral_positions,
    points_of,
)
from floatref_conformance.proving_ground.shaping import with_level_start

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
