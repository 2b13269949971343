"""Holes in an accelerometer's time stamps are told, and channels that miss much of the run."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.intake.blocks import Source, extend_to_cover
from floatref.intake.steady_rate import report_holes
from floatref.screening.findings import Screening
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

FORCE = "vertical_specific_force"
laws = settings(
    deadline=None, max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def stamped(channel, kept):
    clock = StampedClock.of(channel.times_s[kept])
    return Channel.of(channel.id.name, channel.values[kept], clock, channel.id.track)


@laws
@given(
    begins=st.lists(st.integers(1, 18), min_size=1, max_size=4, unique=True),
    count=st.integers(5, 60),
)
def test_holes_are_told_with_their_number_and_length(begins, count, steady):
    recording = steady()
    channel = recording.channel(FORCE)
    kept = np.ones(channel.values.size, bool)
    for begin in begins:
        kept[100 * begin : 100 * begin + count] = False
    (line,) = report_holes(stamped(channel, kept))
    lost_s = len(begins) * (count + 1) * float(np.diff(channel.times_s).mean())
    assert f"no samples for {lost_s:.4g} s in {len(begins)} places" in line
    holed = Recording(tuple(stamped(c, kept) for c in recording.channels))
    assert line in Source(Screening.of(holed)).warnings


def test_where_no_sample_is_missing_nothing_is_told(steady):
    channel = steady().channel(FORCE)
    assert report_holes(channel) == ()
    assert report_holes(stamped(channel, slice(None))) == ()


@given(begin_s=st.floats(0.0, 100.0), missing=st.floats(0.01, 0.99), late=st.booleans())
def test_a_channel_that_misses_more_than_half_of_the_run_is_refused(begin_s, missing, late):
    """It has samples over 100 s, and begins later or ends sooner than the run."""
    clock = UniformClock.of(100, start_s=begin_s)
    channel = Channel.of("height", np.zeros(10_001), clock)
    lost_s = 100.0 * missing / (1.0 - missing)
    run = (begin_s - lost_s, begin_s + 100.0) if late else (begin_s, begin_s + 100.0 + lost_s)
    if missing > 0.501:
        with pytest.raises(InputError, match=r"channel height: samples from .* give all channels"):
            extend_to_cover(channel, *run)
    elif missing < 0.499:
        first, last = extend_to_cover(channel, *run).span_s
        assert first <= run[0] + 0.02
        assert last >= run[1] - 0.02
