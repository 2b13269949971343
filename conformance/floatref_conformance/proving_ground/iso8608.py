"""Roads of the classes A to H of ISO 8608.

(2.1) with w = 2: G(ν) = G(ν0)·(ν/ν0)⁻², ν0 = 0.1 cycles/m. The geometric mean of class A is
16·10⁻⁶ m³ and quadruples from class to class. The standard's band is 0.011 to 2.83 cycles/m:
longer waves are left out, and the same line goes on to the grid's limit as texture.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.road import SPACING_M, START_M, Road
from floatref_conformance.proving_ground.spectral import spectral_road

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
