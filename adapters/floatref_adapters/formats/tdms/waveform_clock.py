"""The clocks of a TDMS group: waveforms one after the other, or a channel that holds the time.

A recorder states each waveform as it begins.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Epoch, InputError, NativeClock
from floatref_adapters.formats.tdms.tdms_objects import TIMING, History
from floatref_adapters.shared.simplest_ratio import find_simplest

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
        offset = find_simplest(self.offset_s)
        epoch = Epoch.LOCAL if self.start_ns is None else Epoch.UTC
        return NativeClock(
            1 / find_simplest(self.step_s),
            Fraction(1, offset.denominator),
            offset.numerator,
            epoch,
            self.start_ns or 0,
        )


def find_waveform(properties: Mapping[str, Any]) -> Waveform | None:
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


def to_unix_ns(stamps: NDArray[Any]) -> NDArray[np.int64]:
    """Return time stamps, `seconds` and `second_fractions` as in the file, in ns since 1970."""
    seconds = stamps["seconds"].astype(np.int64) - UNIX_S
    if seconds.size and np.abs(seconds).max() > LAST_S:
        raise InputError("a time stamp is more than 285 years from 1970; correct it")
    # 2^-64 s as 2^-32 s: the rest is a quarter of a ns.
    parts = stamps["second_fractions"].astype(np.uint64) >> np.uint64(32)
    rounded = (parts * np.uint64(10**9) + np.uint64(1 << 31)) >> np.uint64(32)
    return seconds * 10**9 + rounded.astype(np.int64)


@dataclass(frozen=True)
class Waveforms:
    """Each with the number of its first value; one that goes on as the last is no new one."""

    parts: tuple[tuple[int, Waveform], ...]

    def clock(self) -> NativeClock:
        """Return the clock: of a rate, or with ticks in ns where there are several waveforms."""
        first = self.parts[0][1].clock()
        if len(self.parts) == 1:
            return first
        return NativeClock(tick_s=NS, epoch=first.epoch, origin_ns=first.origin_ns)

    def ticks(self, first: int, last: int) -> NDArray[np.int64] | None:
        """Return the ticks of values ``first`` up to, without, ``last``; None if it has a rate."""
        if len(self.parts) == 1:
            return None
        zero = replace(self.parts[0][1], offset_s=0.0)
        starts = np.array([start for start, _ in self.parts])
        bases = np.array([round(_between_s(zero, wave) * 1e9) for _, wave in self.parts])
        steps = np.array([wave.step_s * 1e9 for _, wave in self.parts])
        rows = np.arange(first, last)
        part = np.searchsorted(starts, rows, "right") - 1
        ticks: NDArray[np.int64] = bases[part] + np.rint(
            (rows - starts[part]) * steps[part]
        ).astype(np.int64)
        return ticks


def find_waveforms(
    properties: Mapping[str, Any], changes: Mapping[str, History]
) -> Waveforms | None:
    """Return the waveforms of a channel; None if its values have no time, or some have not.

    ``properties`` are the last ones, ``changes`` what those that changed were before.
    """
    stated = dict(_find_stated(properties, changes))
    waves = [(row, wave) for row, wave in stated.items() if wave is not None]
    if len(waves) < len(stated) or len({wave.start_ns is None for _, wave in waves}) > 1:
        return None
    parts = waves[:1]
    for (_, before), (row, wave) in pairwise(waves):
        start, last = parts[-1]
        offset = last.offset_s + (row - start) * last.step_s
        end = replace(last, step_s=wave.step_s, offset_s=offset)
        # A step that changes alone leaves open when; it can but go on from there.
        moved = (before.start_ns, before.offset_s) != (wave.start_ns, wave.offset_s)
        new = wave if moved and abs(_between_s(end, wave)) > wave.step_s / 2 else end
        if new is wave or wave.step_s != last.step_s:
            parts.append((row, new))
    return Waveforms(tuple(parts))


def _between_s(one: Waveform, other: Waveform) -> float:
    """Return how much later ``other`` begins than ``one``."""
    return ((other.start_ns or 0) - (one.start_ns or 0)) / 1e9 + other.offset_s - one.offset_s


def _find_stated(
    properties: Mapping[str, Any], changes: Mapping[str, History]
) -> Iterator[tuple[int, Waveform | None]]:
    """Yield the time properties with the number of the first value that they were stated for."""
    events = [(row, name, value) for name in TIMING for row, value in changes.get(name, ())]
    current = dict(properties)
    for row, name, value in sorted([(0, "", None), *events], key=lambda event: event[0]):
        current[name] = value
        yield row, find_waveform(current)
