"""Waveforms of a TDMS channel one after the other: a recorder states each as it begins."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import NativeClock
from floatref_adapters.formats.tdms.property_changes import TIMING, History
from floatref_adapters.formats.tdms.waveform_clock import NS, Waveform, waveform_of


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


def waveforms_of(properties: Mapping[str, Any], changes: Mapping[str, History]) -> Waveforms | None:
    """Return the waveforms of a channel; None if its values have no time, or some have not.

    ``properties`` are the last ones, ``changes`` what those that changed were before.
    """
    stated = dict(_stated(properties, changes))
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


def _stated(
    properties: Mapping[str, Any], changes: Mapping[str, History]
) -> Iterator[tuple[int, Waveform | None]]:
    """Yield the time properties with the number of the first value that they were stated for."""
    events = [(row, name, value) for name in TIMING for row, value in changes.get(name, ())]
    current = dict(properties)
    for row, name, value in sorted([(0, "", None), *events], key=lambda event: event[0]):
        current[name] = value
        yield row, waveform_of(current)
