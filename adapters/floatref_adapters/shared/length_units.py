"""Units of length as profile files spell them, and the names that they give wheel paths."""

from typing import overload

import numpy as np
from numpy.typing import NDArray

Ratio = tuple[int, int]
"""Numerator and denominator: a number times one, over the other, is rounded but once."""

WHEEL_PATHS = {"lelev": "left", "relev": "right"}
"""Names that ProVAL's own examples give the two wheel paths."""

_SPELLINGS: dict[Ratio, str] = {
    (1, 1): "m meter meters metre metres",
    (1, 100): "cm",
    (1, 1000): "mm millimeter millimeters millimetre millimetres",
    (1, 1_000_000): "um micron microns",
    (1000, 1): "km kilometer kilometers kilometre kilometres",
    (254, 10_000): "in inch inches",
    (254, 10_000_000): "mil mils",
    (3048, 10_000): "ft foot feet",
    (1_609_344, 1000): "mi mile miles",
}
LENGTHS = {word: ratio for ratio, words in _SPELLINGS.items() for word in words.split()}


def find_length_unit(text: str) -> Ratio | None:
    """Return what one ``text`` is in m, whatever its case; None if it is no unit of length."""
    return LENGTHS.get(text.strip().rstrip(".").lower())


@overload
def to_metres(value: float, unit: Ratio) -> float: ...
@overload
def to_metres(value: NDArray[np.float64], unit: Ratio) -> NDArray[np.float64]: ...
def to_metres(value: float | NDArray[np.float64], unit: Ratio) -> float | NDArray[np.float64]:
    """Return ``value`` in m; one in m comes back as it is, with every digit."""
    numerator, denominator = unit
    return value if numerator == denominator else value * numerator / denominator
