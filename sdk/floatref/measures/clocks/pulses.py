"""Pulses of a common signal, as each clock timed them: the times of their leading edges (4.4)."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.clock import UniformClock
from floatref.values.scanning import CHUNK, chunks

BINS = 4096
"""Bins between the lowest and the highest sample, to find the levels."""
CLEAR = 8.0
"""Standard deviations of the noise from the idle level up to which a sample may be noise."""
LEAST_SHARE = 0.02
"""Least distance of a pulse from the idle level, as a share of the range."""
HYSTERESIS = 0.15
"""Share of the pulse's height on either side of the middle that belongs to neither level."""
EVEN = 0.4
"""Share of the time from which on neither level is the rarer one: then the pulses rise."""
RINGING = 0.02
"""An edge that follows a pulse within this share of the usual interval is its ringing."""
USUAL = 0.1
"""Shorter intervals than the usual one last this share of the time: ringing lasts less."""
MOST_EDGES = 1_000_000
"""Most edges of a signal of pulses."""

_SOUGHT = "pulses that rise from one level to another, or fall if the signal is mostly high"


class PulseLevels(NamedTuple):
    """Level at rest and level of a pulse; the pulse is the rarer of the two."""

    idle: float
    pulse: float


def pulse_times(times_s: FloatArray, values: FloatArray) -> FloatArray:
    """Return the times in s of the leading edges in ``values``, taken at ``times_s``.

    Both of shape (n,), read a piece at a time, NaN = missing. An edge lies where the signal crosses
    the middle of its two levels, linear between samples. The level that the signal has for more of
    the time is that of rest, so that the pulses of an active-low signal fall. Ringing makes no
    further edge, and an edge inside a gap is not returned. Raises InputError without pulses.
    """
    times = np.asarray(times_s, dtype=np.float64)
    if times.shape != values.shape:
        raise InputError(f"{values.size} samples of pulses but {times.size} times; give one each")
    return pulse_times_by(values, lambda first, count: times[first : first + count])


def pulse_times_at_rate(values: FloatArray, rate_hz: float, start_s: float = 0.0) -> FloatArray:
    """Return the times in s of the leading edges in ``values``, sampled evenly from ``start_s``.

    As `pulse_times` otherwise.
    """
    clock = UniformClock.of(rate_hz, start_s)
    return pulse_times_by(values, lambda first, count: clock.times(count, first))


def pulse_times_by(values: FloatArray, times: Callable[[int, int], FloatArray]) -> FloatArray:
    """Return the times in s of the leading edges in ``values``, of shape (n,).

    ``times(first, count)`` returns the times of ``count`` samples from ``first`` on, in s; it is
    called at the edges alone. As `pulse_times` otherwise.
    """
    idle, pulse = pulse_levels(values)
    found, rest = [], []
    for first, before in _find_leading(values, idle, pulse):
        at = times(first, 2)
        stretch = (values[first : first + 2] - idle) / (pulse - idle)
        share = (0.5 - stretch[0]) / (stretch[1] - stretch[0])
        found.append(float(at[0] + share * (at[1] - at[0])))
        rest.append(found[-1] - float(times(before, 1)[0]) if before >= 0 else np.inf)
        if len(found) > MOST_EDGES:
            raise InputError(f"more than {MOST_EDGES} edges; looked for {_SOUGHT}")
    if not found:
        raise InputError(
            f"no edge from {idle:.6g} to {pulse:.6g} is complete; looked for {_SOUGHT}"
        )
    return _drop_ringing(np.array(found), np.array(rest))


def pulse_levels(values: FloatArray) -> PulseLevels:
    """Return the two levels of ``values``, shape (n,), NaN = missing; InputError if it has one."""
    lowest, highest, noise = _range(values)
    counts = np.zeros(BINS, np.int64)
    edges = np.linspace(lowest, highest, BINS + 1)
    for _, chunk in chunks(values):
        counts += np.histogram(chunk[~np.isnan(chunk)], edges)[0]
    level = (edges[1:] + edges[:-1]) / 2
    idle = _typical(level, counts, np.abs(level - level[counts.argmax()]) <= noise)
    clear = max(CLEAR * noise, LEAST_SHARE * (highest - lowest))
    above, below = level > idle + clear, level < idle - clear
    beyond = above if counts[above].sum() >= counts[below].sum() else below
    if not counts[beyond].any():
        raise InputError(
            f"all samples lie from {lowest:.6g} to {highest:.6g} around one level, {idle:.6g}; "
            f"looked for {_SOUGHT}"
        )
    rough = _typical(level, counts, beyond)
    # Not the samples on the way to it.
    there = beyond & (np.abs(level - idle) > 0.5 * abs(rough - idle))
    found = PulseLevels(idle, _typical(level, counts, there))
    even = counts[beyond].sum() >= EVEN * counts.sum()
    return PulseLevels(*sorted(found)) if even else found


def _typical(level: FloatArray, counts: IndexArray, where: np.ndarray) -> float:
    """Return the median of the samples ``where``."""
    below = np.cumsum(np.where(where, counts, 0))
    return float(level[np.searchsorted(below, below[-1] / 2)])


def _range(values: FloatArray) -> tuple[float, float, float]:
    """Return lowest and highest sample, and the standard deviation of the noise."""
    lowest, highest, counts = np.inf, -np.inf, np.zeros(1 << 16, np.int64)
    last = np.empty(0)
    for _, chunk in chunks(values):
        known = np.concatenate([last, chunk[np.isfinite(chunk)]])
        if known.size:
            lowest, highest = min(lowest, known.min()), max(highest, known.max())
        counts += _steps_by_size(known)
        last = known[-1:]
    if not highest > lowest:
        found = f"all samples are {lowest:g}" if highest == lowest else "all samples are missing"
        raise InputError(f"{found}; looked for {_SOUGHT}")
    # The median step of white noise is 0.954 of its standard deviation.
    return float(lowest), float(highest), _median_size(counts) / 0.954


def _steps_by_size(known: FloatArray) -> IndexArray:
    """Count the steps of ``known`` by the leading 16 bits of their size, shape (65536,).

    These are its sign, its power of two, and sixteenths of that. Counts of pieces add up, so that
    their median does not depend on where the pieces end.
    """
    with np.errstate(over="ignore"):
        sizes = np.abs(np.diff(known)).view(np.int64) >> 48
    return np.bincount(sizes, minlength=1 << 16)


def _median_size(counts: IndexArray) -> float:
    """Return the median of the steps so counted, to a thirty-second of it; 0 without any."""
    if not counts.any():
        return 0.0
    middle = int(np.searchsorted(np.cumsum(counts), (counts.sum() + 1) // 2))
    ends = np.array([middle, middle + 1], np.int64) << 48
    return float(ends.view(np.float64).mean()) if middle else 0.0


def _find_leading(values: FloatArray, idle: float, pulse: float) -> Iterator[tuple[int, int]]:
    """Yield the sample before every crossing of the middle on the way to a pulse.

    Also yield the last sample of the pulse before, -1 for the first pulse.
    """
    carried, before = np.empty(0), -1
    for first, chunk in chunks(values):
        shown = np.concatenate([carried, (chunk - idle) / (pulse - idle)])
        begin, side = first - carried.size, _sides(shown)
        marks, highs = np.flatnonzero(side), np.flatnonzero(side == 1)
        rises = np.flatnonzero((side[marks[:-1]] == -1) & (side[marks[1:]] == 1))
        for low, high in zip(marks[rises], marks[rises + 1], strict=True):
            above = shown[low : high + 1] > 0.5
            ended = int(np.searchsorted(highs, low))
            at = begin + low + np.flatnonzero(~above[:-1] & above[1:])[-1]
            yield int(at), int(begin + highs[ended - 1]) if ended else before
        before = int(begin + highs[-1]) if highs.size else before
        # What ends low may be the beginning of an edge that goes on in the next chunk.
        last = marks[-1] if marks.size and side[marks[-1]] == -1 else shown.size
        carried = shown[last:] if shown.size - last <= CHUNK else np.empty(0)


def _sides(shown: FloatArray) -> NDArray[np.int8]:
    """Return 1 for samples of a pulse, -1 at rest, 2 for missing ones, 0 between the levels."""
    side = np.zeros(shown.size, np.int8)
    side[shown < 0.5 - HYSTERESIS] = -1
    side[shown > 0.5 + HYSTERESIS] = 1
    side[np.isnan(shown)] = 2
    return side


def _drop_ringing(times_s: FloatArray, rest_s: FloatArray) -> FloatArray:
    """Return the edges but for those before which the signal rested for too short a time."""
    if times_s.size < 3:
        return times_s
    # Ringing may have many more edges than pulses.
    intervals = np.sort(np.diff(times_s))
    lasted = np.cumsum(intervals)
    usual = intervals[np.searchsorted(lasted, USUAL * lasted[-1])]
    return np.asarray(times_s[rest_s > RINGING * usual])
