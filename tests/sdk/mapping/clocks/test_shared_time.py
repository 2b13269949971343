"""Devices that were started and stopped each for itself give what all of them recorded."""

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.mapping.clocks.shared_time import cut_to_shared
from floatref.screening.plausibility import TRUNCATION_S, examine
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
LEVELS = {FORCE: 9.8, HEIGHT: 0.3}


def channel(name: str, begin: float, end: float, rate: float, stamped: bool = False) -> Channel:
    times = begin + np.arange(int((end - begin) * rate) + 1) / rate
    values = LEVELS[name] + 0.01 * np.sin(times) if name in LEVELS else 20.0 * times
    return Channel.of(
        name, values, StampedClock.of(times) if stamped else UniformClock.of(rate, begin)
    )


spans = st.tuples(st.floats(-40, 5), st.floats(35, 90))


@settings(deadline=None, max_examples=60)
@given(
    force=spans, height=spans, distance=spans, stamped=st.booleans(), rate=st.floats(50.0, 500.0)
)
def test_what_is_cut_can_be_processed_and_has_every_sample_of_the_shared_time(
    force: tuple[float, float],
    height: tuple[float, float],
    distance: tuple[float, float],
    stamped: bool,
    rate: float,
) -> None:
    whole = [
        channel(FORCE, *force, 500.0),
        channel(HEIGHT, *height, rate, stamped),
        channel(DISTANCE, *distance, 50.0, stamped),
    ]
    channels, warnings = cut_to_shared(whole, ["a", "b", "c"], 0)
    examine(Recording(channels))
    begins, ends = zip(*(c.span_s for c in whole), strict=True)
    begin, end = max(begins), min(ends)
    assert bool(warnings) is bool(max(begin - min(begins), max(ends) - end) > TRUNCATION_S)
    for cut, old in zip(channels, whole, strict=True):
        first = int(np.abs(old.times_s - cut.times_s[0]).argmin())
        rows = slice(first, first + cut.values.size)
        np.testing.assert_array_equal(cut.values, old.values[rows])
        np.testing.assert_allclose(cut.times_s, old.times_s[rows], rtol=0, atol=1e-9)
        assert cut.span_s[0] <= begin + 1e-9
        assert cut.span_s[1] >= end - 1e-9
        # One sample stays on either side, so that the ends lie between samples.
        beyond = (cut.times_s < begin - 1e-9) | (cut.times_s > end + 1e-9)
        assert not warnings or beyond.sum() <= 2


def cut(clocks: Sequence[str], *channels: Channel) -> tuple[tuple[Channel, ...], tuple[str, ...]]:
    return cut_to_shared(channels, clocks, 0)


def test_a_channel_that_was_lost_on_its_own_clock_stays_short() -> None:
    force, height = channel(FORCE, 0, 60, 500), channel(HEIGHT, 0, 20, 500)
    distance = channel(DISTANCE, -9, 99, 50)
    channels, (line,) = cut(["adc", "adc", "can"], force, height, distance)
    assert "cut to what all of them share, from 0 to 60 s" in line
    with pytest.raises(InputError, match="height: ends at 20 s"):
        examine(Recording(channels))


def test_one_clock_is_never_cut() -> None:
    channels = channel(FORCE, 0, 60, 500), channel(HEIGHT, 5, 20, 500)
    assert cut(["adc", "adc"], *channels) == (channels, ())


def test_gnss_keeps_what_it_has_before_and_behind() -> None:
    gnss = channel("gnss_height", -50, 100, 20)
    channels, _ = cut(
        ["adc", "gps", "can"], channel(FORCE, 0, 60, 500), gnss, channel(DISTANCE, -9, 99, 50)
    )
    assert channels[1] is gnss
    assert cut(["adc", "gps"], channel(FORCE, 0, 60, 500), gnss)[1] == ()


@pytest.mark.parametrize("name", [DISTANCE, "gnss_height"])
def test_a_channel_of_another_time_is_refused(name: str) -> None:
    force, other = channel(FORCE, 1.7e9, 1.7e9 + 60, 500), channel(name, 0, 60, 50)
    with pytest.raises(InputError, match=f"channel {name}: its samples, from 0 to 60 s, share no"):
        cut(["adc", "can"], force, other)


def test_clocks_that_meet_the_accelerometer_and_not_each_other_are_refused() -> None:
    force, height = channel(FORCE, 0, 60, 500), channel(HEIGHT, -10, 20, 500)
    with pytest.raises(InputError, match="share no time"):
        cut(["adc", "laser", "can"], force, height, channel(DISTANCE, 30, 90, 50))
