"""A uniform clock that a file states as metadata: `rate_hz` and `start_s`, or other words."""

import re
from collections.abc import Mapping
from fractions import Fraction
from math import isfinite
from typing import Any

from floatref import InputError, NativeClock

_RATES = (
    "rate_hz fs_hz rate fs sampling_rate sample_rate samplerate samplingrate sampling_frequency "
    "sample_frequency samplingfrequency"
)
_STEPS = "dt dt_s sampling_interval sample_interval sampling_period sample_period time_step"
RATES, STEPS = frozenset(_RATES.split()), frozenset(_STEPS.split())
STARTS = frozenset(("start_s", "t0", "t0_s", "start_time_s"))
"""What rates in Hz, steps in s, and times of the first sample in s are called."""
_NUMBER = re.compile(r"[+-]?\d{1,25}(\.\d{0,40})?([eE][+-]?\d{1,3})?|\d{1,20}/\d{1,20}")
HIGHEST_HZ, LONGEST_S, LATEST_S = 10**9, 10**6, 10**15
SIMPLEST = 1_000_000
"""Largest denominator of a rate that a float64 is taken for."""


def read_stated_clock(attributes: Mapping[str, Any], where: str) -> NativeClock | None:
    """Return the clock that ``attributes`` state, or None; InputError naming ``where``.

    A rate as text is exact ("48000/7"); as a float64 it is the simplest fraction that rounds
    to it.
    """
    named = {name.lower(): name for name in attributes}
    rate = _first(named, RATES, attributes, where)
    if rate is None:
        step = _first(named, STEPS, attributes, where)
        if step is None:
            return None
        _check(0 < step <= LONGEST_S, where, "step", step)
        rate = 1 / step
    _check(0 < rate <= HIGHEST_HZ, where, "rate in Hz", rate)
    start = _first(named, STARTS, attributes, where) or Fraction(0)
    _check(abs(start) <= LATEST_S, where, "start in s", start)
    return NativeClock(rate, Fraction(1, start.denominator), start.numerator)


def _first(
    named: Mapping[str, str], words: frozenset[str], attributes: Mapping[str, Any], where: str
) -> Fraction | None:
    for word, name in named.items():
        if word in words:
            found = number(attributes[name])
            if found is None:
                raise InputError(
                    f"{where}: {name} is {str(attributes[name])[:40]!r}; give a number"
                )
            return found
    return None


def _check(usable: bool, where: str, what: str, value: Fraction) -> None:
    if not usable:
        raise InputError(f"{where}: {what} is {float(value):g}; correct it")


def number(value: Any) -> Fraction | None:
    """Return the number that a value of metadata is, as exact as it is given, or None."""
    value = getattr(value, "tolist", lambda: value)()
    while isinstance(value, list) and len(value) == 1:
        value = value[0]
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    if isinstance(value, str):
        return _of_text(value.strip())
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        return None
    if isinstance(value, int):
        return Fraction(value)
    simple = Fraction(value).limit_denominator(SIMPLEST)
    return simple if float(simple) == value else Fraction(repr(value))


def _of_text(text: str) -> Fraction | None:
    if not _NUMBER.fullmatch(text):
        return None
    try:
        return Fraction(text)
    except ZeroDivisionError:
        return None
