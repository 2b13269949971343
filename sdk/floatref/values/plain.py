"""Numbers and arrays from a caller: converted to float64, or refused with one line."""

from collections.abc import Iterable
from decimal import Decimal
from math import isfinite
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray

NUMERIC = "biuf"
"""Kinds of dtype that hold real numbers: truth values, integers and floating point."""


def above_zero(name: str, value: float) -> float:
    """Return ``value``, called ``name``; InputError unless it is finite and above zero."""
    if not isinstance(value, Real) or isinstance(value, bool):
        raise InputError(f"{name} is {value!r}, not a number; give one above zero")
    if not (isfinite(value) and value > 0.0):
        raise InputError(f"{name} is {value}; give a number above zero")
    return float(value)


def numbers(name: str, values: ArrayLike) -> FloatArray:
    """Return ``values``, called ``name``, as a read-only C-contiguous float64 array.

    A float64 array of that layout is not copied, and stays writable to its owner. Masked entries
    become NaN. Raises InputError for values that are not real numbers, or are infinite.
    """
    try:
        array = _real(np.asanyarray(values))
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{name} is not an array of numbers; give float64") from error
    infinite = np.isinf(array)
    if infinite.any():
        where = int(infinite.argmax())
        value = array.flat[where]
        raise InputError(f"{name} sample {where} is {value}; give NaN for a missing one")
    view = array.view()
    view.flags.writeable = False
    return view


def _real(array: NDArray[Any]) -> FloatArray:
    masked = np.ma.getmaskarray(array) if isinstance(array, np.ma.MaskedArray) else None
    plain = np.asarray(array)
    if plain.dtype.kind == "O":
        plain = np.array(_floats(plain.flat), dtype=np.float64).reshape(plain.shape)
    elif plain.dtype.kind not in NUMERIC:
        raise TypeError(f"{plain.dtype} holds no real numbers")
    # Extended precision beyond float64 becomes infinite, which is refused.
    with np.errstate(over="ignore"):
        real = np.require(plain, np.float64, ("C", "A"))
    return real if masked is None else np.where(masked, np.nan, real)


def _floats(values: Iterable[Any]) -> list[float]:
    values = list(values)
    for value in values:
        if not isinstance(value, Real | Decimal):
            raise TypeError(f"{value!r} is no number")
    return [float(value) for value in values]
