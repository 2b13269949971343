"""From triggers back to time: what triggers tell comes back, and what they cannot is told."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.stages.resampling import ToDistance
from floatref.stages.triggers import LONGEST_S, ToTime
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header, join_blocks
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws, Stream

UP, RANGE = ChannelId("vertical_acceleration", "left"), ChannelId("height", "left")
TIME, DISTANCE, SHARE = (ChannelId(name) for name in ("time", "distance", "missing_share"))
RATE, INTERVAL, ORIGIN = 1000, 0.05, 12.3
laws = settings(deadline=None, max_examples=25)
INTERVALS_S = st.lists(
    st.sampled_from([0.001, 0.002, 0.0073, 0.03, 0.4, 1.7, 30.0]), min_size=1, max_size=12
)


def header():
    channels = frozenset({UP, RANGE, TIME})
    return Header(Axis.DISTANCE, INTERVAL, ORIGIN, Fraction(RATE), channels, ("left",))


def triggers(intervals_s, seed=0):
    times = np.cumsum([0.25, *intervals_s])
    rng = np.random.default_rng(seed)
    return Block(0, {TIME: times, **{c: rng.standard_normal(times.size) for c in (UP, RANGE)}})


def through(stage, given_header, block):
    out_header = stage.start(given_header)
    out = [stage.push(block), *stage.finish()]
    return out_header, join_blocks([each for each in out if len(each)])


@laws
@given(intervals_s=INTERVALS_S, seed=st.integers(0, 99))
def test_the_triggers_come_back_as_they_were(intervals_s, seed):
    """Those at samples of the clock to the bit, where a trigger follows within milliseconds too."""
    block = triggers(np.round(intervals_s, 3), seed)
    in_time, samples = through(ToTime(), header(), block)
    assert in_time.axis is Axis.TIME
    _, again = through(ToDistance(INTERVAL, ORIGIN), in_time, samples)
    assert len(again) == len(block)
    for channel in (UP, RANGE):
        np.testing.assert_array_equal(again[channel], block[channel])
        assert not np.any(again.flags.get(channel, 0))


@laws
@given(interval_s=st.floats(0.01, 8.0), unknown_s=st.floats(0.2, 4.0))
def test_the_missing_share_is_that_of_the_interval(interval_s, unknown_s):
    """Density grows with the square of the interval, and what is left of a line by the rest."""
    block = triggers([interval_s])
    _, samples = through(ToTime(unknown_s), header(), block)
    expected = min((interval_s / unknown_s) ** 4, 1.0)
    inner = slice(1, int(interval_s * RATE))
    np.testing.assert_allclose(samples[SHARE][inner], expected, rtol=1e-9)
    line = np.interp(np.arange(len(samples)) / RATE, [0.0, interval_s], block[UP])
    np.testing.assert_allclose(
        samples[UP][inner], (1.0 - expected) * line[inner], rtol=1e-9, atol=1e-12
    )
    assert samples[UP][0] == block[UP][0]


@laws
@given(before_s=st.floats(0.01, 0.2), factor=st.floats(1.0, 20.0))
def test_a_jolt_makes_more_of_it_missing(before_s, factor):
    """At 2 mm·s nothing is left of a line."""
    interval_s = before_s * factor
    _, samples = through(ToTime(1.0), header(), triggers([before_s, interval_s]))
    lost = INTERVAL / before_s - INTERVAL / interval_s
    jolt = lost * (lost * before_s / INTERVAL) * interval_s**2 / 2e-3
    expected = min((interval_s**2 + jolt) ** 2, 1.0)
    np.testing.assert_allclose(samples[SHARE][-2], expected, rtol=1e-6)


@laws
@given(interval_s=st.floats(0.01, 5.0))
def test_heights_away_from_triggers_are_no_readings(interval_s):
    _, samples = through(ToTime(), header(), triggers([interval_s]))
    times = np.arange(len(samples)) / RATE
    apart = np.minimum(times, np.abs(interval_s - times))
    flagged = samples.flags[RANGE] != 0
    assert flagged[(apart > 1.01e-3) & (times < interval_s)].all()
    assert not flagged[apart < 0.99e-3].any()
    assert UP not in samples.flags


@laws
@given(stand_s=st.floats(LONGEST_S + 1.0, 3600.0))
def test_an_hour_at_a_standstill_is_no_hour_of_samples(stand_s):
    whole = round(stand_s, 3)
    _, samples = through(ToTime(), header(), triggers([0.01, whole, 0.01]))
    assert len(samples) == round((LONGEST_S + 0.02) * RATE) + 1
    np.testing.assert_allclose(samples[DISTANCE][[0, -1]], [ORIGIN, ORIGIN + 3 * INTERVAL])


def test_what_lasts_concerns_the_whole_interval_before_a_trigger():
    block = triggers([0.004, 0.004, 0.004])
    flags = {UP: np.array([0, Flag.DRIFT, Flag.MISSING, 0], np.uint8)}
    _, samples = through(ToTime(), header(), replace(block, flags=flags))
    marks = samples.flags[UP]
    np.testing.assert_array_equal(np.flatnonzero(marks & Flag.DRIFT), [1, 2, 3, 4])
    np.testing.assert_array_equal(np.flatnonzero(marks & Flag.MISSING), np.arange(5, 12))


def lost(block, where):
    """Return ``block`` with the triggers ``where`` flagged as behind travel that was lost."""
    marks = np.isin(np.arange(len(block)), where) * np.uint8(Flag.SLOW | Flag.MISSING)
    return replace(block, flags=dict.fromkeys((UP, RANGE, TIME), marks))


@laws
@given(interval_s=st.floats(0.002, 5.0), lasts_s=st.floats(0.001, 0.1))
def test_no_place_is_told_where_the_encoder_lost_travel(interval_s, lasts_s):
    block = triggers([lasts_s, lasts_s, interval_s, lasts_s, lasts_s])
    _, samples = through(ToTime(), header(), lost(block, [3]))
    places = (block[TIME] - block[TIME][0]) * RATE
    at = np.arange(len(samples))
    inside = (at > places[2] + 1.0 + 1e-6) & (at < places[3] - 1e-6)
    np.testing.assert_array_equal(np.isnan(samples[DISTANCE][inside]), True)
    known = (at < places[2] + 1.0 - 1e-6) | (at > places[3] + 1e-6)
    line = np.interp(at, places, ORIGIN + INTERVAL * np.arange(6))
    inner = known & (at <= places[-1])
    np.testing.assert_allclose(samples[DISTANCE][inner], line[inner], rtol=1e-9)


@laws
@given(intervals_s=INTERVALS_S, where=st.lists(st.integers(1, 12)), rounded=st.booleans())
def test_every_trigger_is_reached_whatever_the_encoder_lost(intervals_s, where, rounded):
    """Those that are not flagged are read as if nothing had been lost before or behind them."""
    whole = triggers(np.round(intervals_s, 3) if rounded else intervals_s)
    block = lost(whole, where)
    again, usual = (
        through(ToDistance(INTERVAL, ORIGIN), *through(ToTime(), header(), each))[1]
        for each in (block, whole)
    )
    assert len(again) == len(block)
    sound = block.flags[UP] == 0
    for channel in (UP, RANGE):
        np.testing.assert_array_equal(again[channel][sound], usual[channel][sound])
        np.testing.assert_array_equal(again.flags.get(channel, 0 * sound)[~sound] != 0, True)


@laws
@given(before=st.integers(2, 30), leapt=st.integers(1, 50), cut=st.integers(1, 80))
def test_a_leap_is_marked_at_the_sample_that_it_reaches(before, leapt, cut):
    """Many triggers lie between two samples: as many as the encoder has made up."""
    times = [0.004] * before + [0.0] * leapt + [0.004] * before
    whole = lost(triggers(times), np.arange(before + 1, before + leapt + 1))
    stage = ToTime()
    stage.start(header())
    blocks = [
        stage.push(whole.part(0, cut)),
        stage.push(whole.part(min(cut, len(whole)), len(whole))),
    ]
    samples = join_blocks([b for b in [*blocks, *stage.finish()] if len(b)])
    marked = np.flatnonzero(samples.flags[DISTANCE])
    leap = np.flatnonzero(np.diff(samples[DISTANCE]) > INTERVAL) + 1
    assert set(leap) <= set(marked)
    assert marked.size <= 5


@laws
@given(intervals_s=INTERVALS_S, where=st.lists(st.integers(1, 12)), cut=st.integers(0, 12))
def test_lost_travel_is_the_same_wherever_blocks_are_cut(intervals_s, where, cut):
    block, stage = lost(triggers(intervals_s), where), ToTime()
    _, whole = through(ToTime(), header(), block)
    stage.start(header())
    parts = [block.part(0, min(cut, len(block))), block.part(min(cut, len(block)), len(block))]
    cuts = join_blocks([b for b in [*map(stage.push, parts), *stage.finish()] if len(b)])
    np.testing.assert_array_equal(cuts[DISTANCE], whole[DISTANCE])


def test_a_stream_in_time_is_refused():
    with pytest.raises(InputError, match="the stream is not on the distance axis"):
        ToTime().start(replace(header(), axis=Axis.TIME))


@pytest.mark.parametrize("missing", [TIME, UP, RANGE])
def test_a_channel_that_is_not_there_is_named(missing):
    with pytest.raises(InputError, match=f"stage ToTime needs channel {missing}; add"):
        ToTime().start(header().without(missing.name))


class TestToTime(StageLaws):
    """Intervals from less than a step to some seconds."""

    reads = ("vertical_acceleration", "height")
    shared = ("time",)
    axis = Axis.DISTANCE
    keeps_index = False

    def make(self):
        return ToTime()

    def stream(self, seed: int = 0) -> Stream:
        drawn = super().stream(seed)
        rng = np.random.default_rng(seed)
        steps = rng.choice([0.004, 0.01, 0.03, 0.17, 2.0], drawn.samples[TIME].size)
        return drawn.change(lambda c, x: np.cumsum(steps) if c == TIME else x)
