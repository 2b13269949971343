"""Conversions of MDF 4 by tables of values and ranges, some of numbers and some of texts.

Signals of buses are stored so: a line for what was measured, and texts such as `not available`
for the values above it. The numbers are delivered; a sample with a text is a missing one.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[Any]
Converted = Callable[[Any, Numbers], NDArray[np.float64]]
BY_VALUE, BY_RANGE = 7, 8
"""Types of conversion."""
MOST_SCALES = 64


def scales_of(conversion: Any) -> dict[int, Any]:
    """Return the conversions to numbers in the table of ``conversion``, -1 that of the rest.

    Empty if it is no such table, or all is text.
    """
    if conversion.conversion_type not in (BY_VALUE, BY_RANGE):
        return {}
    listed = {k: conversion.referenced_blocks.get(f"text_{k}") for k in range(_count(conversion))}
    listed[-1] = conversion.referenced_blocks.get("default_addr")
    found = {k: ref for k, ref in listed.items() if ref is not None and not isinstance(ref, bytes)}
    return found if len(found) <= MOST_SCALES else {}


def numbers_of(conversion: Any, raw: Numbers, converted: Converted) -> NDArray[np.float64]:
    """Return ``raw`` by the table of ``conversion``, NaN where it gives a text.

    ``converted`` is what converts by the scales in the table.
    """
    place = _by_value(conversion, raw)
    found = np.full(raw.shape, np.nan)
    for k, scale in scales_of(conversion).items():
        here = place == k
        found[here] = converted(scale, raw[here])
    return found


def of_ranges(conversion: Any, raw: Numbers) -> NDArray[np.float64]:
    """Return ``raw`` by the table of ranges and numbers of ``conversion``.

    asammdf 8.8 finds no range for an integer unless it is the upper limit of one.
    """
    keys = range((int(conversion.val_param_nr) - 1) // 3)
    found = np.array([*(conversion[f"phys_{k}"] for k in keys), conversion.default], np.float64)
    return found[_entries(conversion, raw, "lower", "upper", len(keys))]


def _count(conversion: Any) -> int:
    values = int(conversion.val_param_nr)
    return values if conversion.conversion_type == BY_VALUE else values // 2


def _by_value(conversion: Any, raw: Numbers) -> NDArray[np.int64]:
    """Return which entry of the table each of ``raw`` is of, -1 for none."""
    names = ("val", "val") if conversion.conversion_type == BY_VALUE else ("lower", "upper")
    return _entries(conversion, raw, *names, _count(conversion))


def _entries(conversion: Any, raw: Numbers, low: str, high: str, count: int) -> NDArray[np.int64]:
    """Return which of ``count`` ranges each of ``raw`` is in, -1 for none.

    A range holds its upper limit if the values are integers, as the standard has it.
    """
    if not count:
        return np.full(raw.shape, -1)
    lower, upper = (np.array([conversion[f"{n}_{k}"] for k in range(count)]) for n in (low, high))
    order = np.argsort(lower, kind="stable")
    place = np.searchsorted(lower[order], raw, "right") - 1
    entry = order[np.maximum(place, 0)]
    closed = low == high or raw.dtype.kind != "f"
    inside = (raw <= upper[entry]) if closed else (raw < upper[entry])
    return np.where(inside & (place >= 0), entry, -1)


__all__ = ["numbers_of", "of_ranges", "scales_of"]
