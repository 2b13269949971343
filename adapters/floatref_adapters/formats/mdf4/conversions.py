"""Conversions of MDF 4 channels from stored numbers to values, by asammdf except in three cases.

By hand are formulas, since asammdf 8.8 leaves out one that it cannot compute; tables of ranges,
since it finds no range for an integer between two limits; and tables that give numbers and texts,
since it returns them as objects. Signals of buses are stored so: a line for what was measured, and
texts such as `not available` for the values above it. A sample with a text is a missing one.
"""

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref_adapters.shared.refusals import library

Numbers = NDArray[Any]
ALGEBRAIC, RANGES, BY_VALUE, BY_RANGE = 3, 6, 7, 8
"""Types of conversion: a formula, a table by ranges, and two tables that may give text."""
FIRST_TEXT = BY_VALUE
TEXT = "text by a table"
MOST_SCALES = 64


def find_conversion_fault(conversion: Any) -> str:
    """Return why ``conversion`` gives no numbers; "" if it does."""
    if conversion is None:
        return ""
    if conversion.conversion_type >= FIRST_TEXT:
        scales = scales_of(conversion).values()
        return next(filter(None, map(find_conversion_fault, scales)), "") if scales else TEXT
    try:
        convert(conversion, np.arange(2))
    except Exception:
        return "a conversion that cannot be computed"
    return ""


def convert(conversion: Any, raw: Numbers) -> NDArray[np.float64]:
    """Return ``raw`` converted by asammdf's ``conversion``, as float64."""
    if conversion is None:
        return raw.astype(np.float64)
    with np.errstate(all="ignore"):
        if scales_of(conversion):
            return _look_up_scale(conversion, raw)
        if conversion.conversion_type == ALGEBRAIC:
            return _evaluate(conversion.formula, raw.astype(np.float64))
        if conversion.conversion_type == RANGES:
            return _look_up_range(conversion, raw)
        return np.asarray(conversion.convert(raw.astype(np.float64)), np.float64)


def _evaluate(formula: str, raw: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return ``formula`` of X; asammdf would leave a bad one out without an error."""
    evaluate = library("numexpr", "an algebraic conversion").evaluate
    text = re.sub(r"\bX1?\b", "X", formula)
    found = evaluate(text, local_dict={"X": raw}, global_dict={}, sanitize=True)
    return np.broadcast_to(np.asarray(found, np.float64), raw.shape).copy()


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


def _look_up_scale(conversion: Any, raw: Numbers) -> NDArray[np.float64]:
    """Return ``raw`` by the table of ``conversion``, NaN where it gives a text."""
    place = _by_value(conversion, raw)
    found = np.full(raw.shape, np.nan)
    for k, scale in scales_of(conversion).items():
        here = place == k
        found[here] = convert(scale, raw[here])
    return found


def _look_up_range(conversion: Any, raw: Numbers) -> NDArray[np.float64]:
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
    """Return which entry of the table each of ``raw`` is of, -1 if it is not in the table."""
    names = ("val", "val") if conversion.conversion_type == BY_VALUE else ("lower", "upper")
    return _entries(conversion, raw, *names, _count(conversion))


def _entries(conversion: Any, raw: Numbers, low: str, high: str, count: int) -> NDArray[np.int64]:
    """Return which of ``count`` ranges each of ``raw`` is in, -1 if outside all of them.

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
