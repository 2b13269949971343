"""The clocks of a TDMS group: waveform properties, or a channel that holds the time."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Epoch, InputError, NativeClock
from floatref_adapters.shared.simplest_ratio import simplest

UNKNOWN = NativeClock(rate=Fraction(1), name="unknown")
"""Of values that the file gives no time for: value k has the tick k."""
UNIX_S = 2_082_844_800
"""Seconds from the zero of TDMS, 1904-01-01 UTC, to 1970-01-01 UTC."""
LAST_S = 9_000_000_000
"""Most seconds from 1970 whose ns are an int64."""
NS = Fraction(1, 10**9)


@dataclass(frozen=True)
class Waveform:
    """The time properties of a channel: step and offset in s, start in ns since 1970, if known."""

    step_s: float
    offset_s: float = 0.0
    start_ns: int | None = None

    def clock(self) -> NativeClock:
        """Return the clock with the rate that the step was rounded from."""
        offset = simplest(self.offset_s)
        epoch = Epoch.LOCAL if self.start_ns is None else Epoch.UTC
        return NativeClock(
            1 / simplest(self.step_s),
            Fraction(1, offset.denominator),
            offset.numerator,
            epoch,
            self.start_ns or 0,
        )


def waveform_of(properties: Mapping[str, Any]) -> Waveform | None:
    """Return the time properties among ``properties``; None if its steps are not of time."""
    step = _number(properties.get("wf_increment"))
    offset = _number(properties.get("wf_start_offset", 0.0))
    unit = str(properties.get("wf_xunit_string", "")).strip().lower()
    if not (step > 0 and math.isfinite(offset) and unit in ("", "s")):
        return None
    start = properties.get("wf_start_time")
    # LabVIEW writes the zero of its clock where no start is known.
    known = getattr(start, "seconds", 0) != 0
    return Waveform(step, offset, _unix_ns(start) if known else None)


def _number(value: object) -> float:
    """Return ``value`` as a float; NaN if it is not a finite number."""
    if not isinstance(value, (int, float, np.number)) or not math.isfinite(value):
        return math.nan
    return float(value)


def _unix_ns(stamp: Any) -> int:
    fraction_ns = (int(stamp.second_fractions) * 10**9 + (1 << 63)) >> 64
    return (int(stamp.seconds) - UNIX_S) * 10**9 + fraction_ns


def ns_of(stamps: NDArray[Any]) -> NDArray[np.int64]:
    """Return time stamps, `seconds` and `second_fractions` as in the file, in ns since 1970."""
    seconds = stamps["seconds"].astype(np.int64) - UNIX_S
    if seconds.size and np.abs(seconds).max() > LAST_S:
        raise InputError("a time stamp is more than 285 years from 1970; correct it")
    # 2^-64 s as 2^-32 s: the rest is a quarter of a ns.
    parts = stamps["second_fractions"].astype(np.uint64) >> np.uint64(32)
    rounded = (parts * np.uint64(10**9) + np.uint64(1 << 31)) >> np.uint64(32)
    return seconds * 10**9 + rounded.astype(np.int64)
