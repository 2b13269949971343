"""The clock of an MDF 4 group, from its master channel and the start time of the file."""

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Epoch, InputError, NativeClock
from floatref_adapters.formats.mdf4.conversions import convert
from floatref_adapters.formats.mdf4.record_fields import FLOATS, Field, Numbers
from floatref_adapters.shared.simplest_ratio import find_simplest

Ticks = NDArray[np.int64] | NDArray[np.float64]
UNKNOWN = NativeClock(rate=Fraction(1), name="unknown")
"""Of rows that the file gives no time for: row k has the tick k."""
TIME = 1
"""Masters of other kinds are angles, distances and indices."""
LOCAL_TIME = 1
"""Flag of a start time in an unknown time zone."""
MASTERS = (2, 3)


@dataclass(frozen=True, eq=False)
class Timing:
    """The clock of a group, and the field that the ticks are in, None if it needs no field.

    ``whole`` tells whether the ticks are the integers of the file.
    """

    clock: NativeClock
    field: Field | None = None
    whole: bool = False

    def to_ticks(self, field: Field, raw: Numbers) -> Ticks:
        """Return the ticks of the stored numbers ``raw`` of ``field``."""
        if not self.whole:
            return convert(field.origin.conversion, raw)
        if raw.dtype == np.uint64 and raw.size and raw.max() > np.iinfo(np.int64).max:
            raise InputError(f"{field.origin.name}: tick {raw.max()}; the file is damaged")
        return raw.astype(np.int64)


def start_of(header: Any) -> tuple[NativeClock, str]:
    """Return a clock that begins at the start time in ``header``, and a warning or ""."""
    if not header.abs_time:
        return NativeClock(), ""
    if header.time_flags & LOCAL_TIME:
        return NativeClock(), "the start of the recording is in local time of an unknown zone"
    return NativeClock(epoch=Epoch.UTC, origin_ns=int(header.abs_time)), ""


def is_clock(channel: Any) -> bool:
    """Tell whether ``channel`` of asammdf is a master in time."""
    return channel.channel_type in MASTERS and channel.sync_type == TIME


def find_timing(start: NativeClock, field: Field | None) -> Timing:
    """Return when the records were taken by the master ``field``, from ``start`` on.

    A record's number and integers keep to whole ticks, as a float64 cannot.
    """
    if field is None:
        return Timing(UNKNOWN)
    line = _line(field.origin.conversion)
    if line is None or (field.origin.data_type in FLOATS and not field.virtual):
        return Timing(start, field)
    step, offset = line
    if field.virtual:
        tick_s = Fraction(1, offset.denominator)
        clock = replace(start, rate=1 / step, tick_s=tick_s, first_tick=offset.numerator)
        return Timing(clock)
    offset_ns = offset * 10**9
    if offset_ns.denominator > 1:
        return Timing(start, field)
    origin_ns = start.origin_ns + offset_ns.numerator
    return Timing(replace(start, tick_s=step, origin_ns=origin_ns), field, whole=True)


def _line(conversion: Any) -> tuple[Fraction, Fraction] | None:
    """Return the step and the offset in s of a linear ``conversion``; None for any other."""
    if conversion is None or conversion.conversion_type == 0:
        return Fraction(1), Fraction(0)
    if conversion.conversion_type != 1:
        return None
    step, offset = float(conversion.a), float(conversion.b)
    if not (0 < step < np.inf and np.isfinite(offset)):
        return None
    return find_simplest(step), find_simplest(offset)
