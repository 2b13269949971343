"""Where a height sensor dropped out, in time and along the road."""

from collections.abc import Iterator

import numpy as np

from floatref.intake.aligned import BRIDGE_S, GAP, bridge
from floatref.screening.damage.damaged_samples import merge
from floatref.stages.signals import DISTANCE, HEIGHT
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import median_step


def height_gaps(recording: Recording, track: str, gone: IndexArray) -> FloatArray:
    """Return where along the encoder's distance the height of ``track`` is missing, shape (k, 2).

    Begin and end in m, in order: the last valid sample before the gap and the first one after. Gaps
    are missing samples, damaged samples ``gone`` (first index and the one behind, shape (d, 2)) and
    holes between time stamps. Gaps of up to `BRIDGE_S`, which a line bridges well, do not count. A
    gap at an end of the channel ends at infinity.
    """
    height = recording.channel(HEIGHT, track)
    distance = recording.channel(DISTANCE, track)
    spans = merge(np.concatenate([*_missing(height), gone]))
    times = np.array([_around(height, *span) for span in spans] + _holes(height))
    times = times.reshape(-1, 2)
    long = times[times[:, 1] - times[:, 0] > BRIDGE_S + 2.0 / height.mean_rate_hz]
    return _at(distance, long[np.argsort(long[:, 0])])


def _missing(channel: Channel) -> Iterator[IndexArray]:
    """Yield first index and the one behind of stretches of NaN, split where its scan is."""
    scan = channel.scan
    for first, chunk in scan.parts(channel.values, scan.missing > 0):
        edges = np.flatnonzero(np.diff(np.isnan(chunk), prepend=False, append=False))
        yield edges.reshape(-1, 2) + first


def _around(channel: Channel, first: int, behind: int) -> tuple[float, float]:
    """Return the times of the sound samples on either side; infinite if there is no such sample."""
    begin = -np.inf if first == 0 else _time(channel, first - 1)
    return begin, np.inf if behind >= channel.values.size else _time(channel, behind)


def _holes(channel: Channel) -> list[tuple[float, float]]:
    if not isinstance(channel.clock, StampedClock):
        return []
    times = channel.clock.times_s
    wide = np.flatnonzero(np.diff(times) > GAP * median_step(times))
    return [(float(times[k]), float(times[k + 1])) for k in wide]


def _time(channel: Channel, index: int) -> float:
    return float(channel.clock.times(1, index)[0])


def _at(distance: Channel, times: FloatArray) -> FloatArray:
    """Return the encoder's distance at ``times``, shape (k, 2), infinite where the times are."""
    return np.array([[_place(distance, t) for t in pair] for pair in times.tolist()]).reshape(-1, 2)


def _place(distance: Channel, time_s: float) -> float:
    """Return the distance at one time, linear between the known samples around it."""
    if not np.isfinite(time_s):
        return time_s
    clock, size = distance.clock, distance.values.size
    if isinstance(clock, StampedClock):
        before = int(np.searchsorted(clock.times_s, time_s, "right")) - 1
    else:
        before = int(np.floor((time_s - clock.start_s) * float(clock.rate)))
    low = min(max(before, 0), max(size - 2, 0))
    part, *_ = bridge(lambda begin, end: distance.values[begin:end], size, low, low + 2)
    return float(np.interp(time_s, clock.times(part.size, low), part))
