"""Height against force where the vehicle stands and swings: sign, scale and lag without a road.

After a stop the body swings on its springs over a road that does not move, so that the laser and
the accelerometer beside it measure one motion. This needs no other sensor.
"""

from collections.abc import Collection, Iterator
from dataclasses import replace
from itertools import islice

import numpy as np

from floatref.measures.clocks.sensor_gain import sensor_gain
from floatref.measures.clocks.sensor_skew import sensor_skew
from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import FloatArray
from floatref.values.clock import Clock, StampedClock, UniformClock
from floatref.values.recording import Channel, Recording, TrackSetup
from floatref.values.scanning import every

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
SCALE_OFF, UNUSABLE = 0.25, 0.3
"""Deviation of the gain from 1 that tolerances and the few swings of a stop do not make, as in
`sensor_gain`; and one that is no tolerance but a wrong unit."""
PITCHES_ABOUT_M = 1.5
"""Shortest distance in m from the sensors to the point that a body pitches about, half a wheelbase:
a laser ahead of its accelerometer by a part of it moves by as much more or less."""
LATE_S, CERTAIN = 0.005, 3.0
"""Lag in s beyond the latency of a laser, up to 3 ms, and in standard deviations of it."""
LOOK_S, STANDS_S, STANDS_M = 0.05, 0.7, 0.002
"""The encoder is read this often, in s; a vehicle stands that travels less than the last in m
during the second in s."""
BEFORE_S, SWINGS_S = 1.0, 6.0
"""What is compared of a stop: from before it, until the swing has decayed, in s."""
MOST_STOPS = 8
"""Number of stops that are compared: more say nothing new."""


def stop_doubts(recording: Recording, tracks: Collection[str]) -> Iterator[Doubt]:
    """Yield the doubts about the height of each of ``tracks`` that stops of the vehicle show."""
    encoder = recording.channel(DISTANCE, recording.tracks[0])
    stops = list(islice(stops_of(encoder), MOST_STOPS)) if tracks else []
    for track in tracks if stops else ():
        force, height = recording.find(FORCE, track), recording.find(HEIGHT, track)
        if force is not None and height is not None:
            ahead_m = recording.setup.tracks.get(track, TrackSetup()).laser_offset_m[0]
            parts = [[cut(c, *stop) for c in (force, height, encoder)] for stop in stops]
            known = [[c for c in part if c is not None] for part in parts]
            whole = [(part[0], part[1], part[2]) for part in known if len(part) == 3]
            yield from _scale(whole, abs(ahead_m) / PITCHES_ABOUT_M)
            yield from _lag(whole)


Part = tuple[Channel, Channel, Channel]
"""Accelerometer, laser and encoder around a stop."""


def stops_of(encoder: Channel) -> Iterator[tuple[float, float]]:
    """Yield begin and end in s of what is compared of every stop, in order."""
    places, apart_s = _places(encoder)
    ahead = max(1, round(STANDS_S / apart_s))
    if places.size <= ahead:
        return
    stands = np.abs(places[ahead:] - places[:-ahead]) < STANDS_M
    begins = np.flatnonzero(stands & ~np.append(False, stands[:-1]))
    for begin in begins.tolist():
        at_s = encoder.span_s[0] + begin * apart_s
        yield at_s - BEFORE_S, at_s + SWINGS_S


def _places(encoder: Channel) -> tuple[FloatArray, float]:
    """Return the distance about every `LOOK_S`, and the time in s between two of them."""
    if isinstance(encoder.clock, StampedClock):
        times = np.arange(*encoder.span_s, LOOK_S)
        return np.interp(times, encoder.clock.times_s, encoder.values), LOOK_S
    stride = max(1, round(LOOK_S * encoder.mean_rate_hz))
    return every(stride, encoder.values), stride / encoder.mean_rate_hz


def cut(channel: Channel, begin_s: float, end_s: float) -> Channel | None:
    """Return ``channel`` between two times, None where it has no sample."""
    clock = channel.clock
    if isinstance(clock, StampedClock):
        low, high = np.searchsorted(clock.times_s, [begin_s, end_s]).tolist()
    else:
        ends = np.ceil((np.array([begin_s, end_s]) - clock.start_s) * float(clock.rate))
        low, high = np.clip(ends, 0, channel.values.size).astype(int).tolist()
    if high <= low + 1:
        return None
    return replace(channel, values=channel.values[low:high], clock=_cut(clock, low, high))


def _cut(clock: Clock, low: int, high: int) -> Clock:
    """Return the clock of samples ``low`` to ``high - 1``."""
    if isinstance(clock, StampedClock):
        return StampedClock.of(clock.times_s[low:high])
    return UniformClock(clock.rate, clock.start_s + low / float(clock.rate))


def _scale(parts: list[Part], lever: float) -> Iterator[Doubt]:
    gains = [gain for part in parts if np.isfinite(gain := sensor_gain(*part))]
    gain = float(np.median(gains)) if gains else 1.0
    if abs(gain - 1.0) <= SCALE_OFF + lever:
        return
    force, height, _ = parts[0]
    what = (
        "its sign, or that of the accelerometer, is inverted; multiply its changes by -1"
        if gain < 0
        else "its unit or scale, or the accelerometer's, is wrong; correct it"
    )
    yield Doubt(
        (height.id,),
        f"channel {height.id}: moves {gain:.3g} times as far as {force.id}, where the stationary "
        f"vehicle swings; {what}",
        fatal=abs(gain - 1.0) > UNUSABLE + lever,
    )


def _lag(parts: list[Part]) -> Iterator[Doubt]:
    known = [each for each in (sensor_skew(*part) for part in parts) if each.known]
    if not known:
        return
    skew = min(known, key=lambda each: each.sigma_s)
    size = abs(skew.skew_s)
    if size <= max(LATE_S, CERTAIN * skew.sigma_s):
        return
    force, height, _ = parts[0]
    late, other = (height, force) if skew.skew_s > 0 else (force, height)
    yield Doubt(
        (late.id,),
        f"channel {late.id}: {1e3 * size:.1f} ms later than {other.id}, by {skew.seconds:.3g} s in "
        "which the body alone moves; correct its start_s, or its delay_s in the channel map",
    )
