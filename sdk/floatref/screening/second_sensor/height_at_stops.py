"""Height against force where the vehicle stands and swings: sign, scale and lag without a road.

After a stop the body swings on its springs over a road that does not move, so that the laser and
the accelerometer beside it measure one motion. This needs no other sensor.
"""

from collections.abc import Iterator

import numpy as np

from floatref.measures.clocks.sensor_gain import sensor_gain
from floatref.measures.clocks.sensor_skew import sensor_skew
from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.recording import Channel, Recording, TrackSetup

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
SCALE_OFF, UNUSABLE = 0.07, 0.3
"""Deviation of the gain from 1 that makes a profile wrong by more than 5 %, with the tolerances of
both sensors; and one that is no tolerance but a wrong unit."""
PITCHES_ABOUT_M = 1.5
"""Shortest distance in m from the sensors to the point that a body pitches about, half a wheelbase:
a laser ahead of its accelerometer by a part of it moves by as much more or less."""
LATE_S, CERTAIN = 0.005, 3.0
"""Lag in s beyond the latency of a laser, up to 3 ms, and in standard deviations of it."""


def stop_doubts(recording: Recording) -> Iterator[Doubt]:
    """Yield the doubts about the height of every wheel path that stops of the vehicle show."""
    for track in recording.tracks:
        found = [recording.find(name, track) for name in (FORCE, HEIGHT, DISTANCE)]
        if all(channel is not None for channel in found):
            force, height, distance = (c for c in found if c is not None)
            ahead_m = recording.setup.tracks.get(track, TrackSetup()).laser_offset_m[0]
            yield from _scale(force, height, distance, abs(ahead_m) / PITCHES_ABOUT_M)
            yield from _lag(force, height, distance)


def _scale(force: Channel, height: Channel, distance: Channel, lever: float) -> Iterator[Doubt]:
    gain = sensor_gain(force, height, distance)
    if not abs(gain - 1.0) > SCALE_OFF + lever:
        return
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


def _lag(force: Channel, height: Channel, distance: Channel) -> Iterator[Doubt]:
    skew = sensor_skew(force, height, distance)
    size = np.nan_to_num(abs(skew.skew_s))
    if not (skew.known and size > LATE_S and size > CERTAIN * skew.sigma_s):
        return
    late, other = (height, force) if skew.skew_s > 0 else (force, height)
    yield Doubt(
        (late.id,),
        f"channel {late.id}: {1e3 * size:.1f} ms later than {other.id}, by {skew.seconds:.3g} s in "
        "which the body alone moves; correct its start_s, or its delay_s in the channel map",
    )
