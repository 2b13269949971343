"""What is streamed: the changed run is the same up to the moment, a repeated one goes on."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.judge.stream_runs import change_after, repeat

RATE_HZ = 50.0


def recording(count=500, gap=False):
    clock = UniformClock.of(RATE_HZ)
    heights = 0.3 + 0.01 * np.sin(np.arange(count))
    if gap:
        heights[::7] = np.nan
    channels = (
        Channel.of("height", heights, clock, "left"),
        Channel.of("distance", 0.2 * np.arange(count), clock),
    )
    return Recording(channels, Setup())


@given(moment_s=st.floats(0.0, 9.9), gap=st.booleans())
def test_up_to_the_moment_nothing_changes_and_every_height_after_it_does(moment_s, gap):
    ours = recording(gap=gap)
    other = change_after(ours, moment_s)
    before, after = (r.channel("height", "left") for r in (ours, other))
    same = before.times_s <= moment_s + 1e-9
    np.testing.assert_array_equal(before.values[same], after.values[same])
    later = ~same & np.isfinite(before.values)
    assert np.mean(before.values[later] != after.values[later]) > 0.9 or not later.any()
    np.testing.assert_array_equal(ours.channel("distance").values, other.channel("distance").values)


@given(count=st.integers(1, 5))
def test_a_repeated_drive_goes_on_where_it_ended(count):
    ours = recording()
    long = repeat(ours, count)
    steps = np.diff(long.channel("distance").values)
    np.testing.assert_allclose(steps, 0.2, atol=1e-9)
    heights = ours.channel("height", "left").values[:-1]
    np.testing.assert_array_equal(
        long.channel("height", "left").values.reshape(count, -1), np.tile(heights, (count, 1))
    )
