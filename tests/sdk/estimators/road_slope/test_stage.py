"""A stop on a hump is levelled; a run without brakes, and a stretch not understood, are left."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.drawn_stops import (
    DISTANCE,
    GAIN,
    LEVEL,
    STEP,
    G,
    short_brake,
    stop_on_hump,
)

from floatref.errors import InputError
from floatref.estimators.laser_place import bins
from floatref.estimators.road_prior import RoadPrior
from floatref.estimators.road_slope import LevelByRoad, levelled
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws

FORCE, HEIGHT = (ChannelId(n, "left") for n in ("vertical_specific_force", "height"))
SHARE, SIGMA = ChannelId("levelled"), ChannelId("levelling_sigma")
ANGLES = st.floats(-0.05, 0.05)


def pass_through(stage, stop, block):
    """Return what the stage makes of ``block``, the whole run."""
    stage.start(stop.header)
    stage.survey(block)
    return stage.push(block)


@cache
def levelled_stop(seed):
    """Return a stop on a hump, the stage that has levelled it, and what it has made of it."""
    stop, stage = stop_on_hump(seed=seed), LevelByRoad(LEVEL)
    return stop, stage, pass_through(stage, stop, stop.block())


def straighten(force, stop, where):
    """Return the height in m that an error of acceleration makes in 1.5 s, but bias and grade."""
    width = round(0.75 / STEP)
    box = np.full(width, 1.0 / width)
    along = np.gradient(np.gradient(stop.distance, STEP), STEP)
    rows = [
        np.convolve(np.convolve(x, box, "same"), box, "same")[where] * 0.75**2
        for x in (force, np.ones(force.size), along)
    ]
    known = np.stack(rows[1:], axis=1)
    return rows[0] - known @ np.linalg.lstsq(known, rows[0], rcond=None)[0]


@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2))])
def test_a_stop_on_a_hump_reads_what_a_level_accelerometer_would(seed) -> None:
    """What gravity and braking on a pitched axis add is gone but for a fifth.

    A bias is left, and what a road on one even grade would add: a high-pass removes both.
    """
    stop, _, out = levelled_stop(seed)
    where = out[SHARE] > 0.99
    before, after = (straighten(f - stop.level, stop, where) for f in (stop.force, out[FORCE]))
    assert where.mean() > 0.5
    assert np.std(after) < 0.2 * np.std(before)
    assert 0.0 < out[SIGMA][where].min() <= out[SIGMA][where].max() < 0.02


def test_the_parts_of_a_run_change_no_bit(monkeypatch) -> None:
    stop, _, whole = levelled_stop(0)
    monkeypatch.setattr(bins, "PART", 97)
    found = pass_through(LevelByRoad(LEVEL), stop, stop.block())
    for channel in (FORCE, SHARE, SIGMA):
        np.testing.assert_array_equal(found[channel], whole[channel])


def test_it_learns_how_much_the_body_pitches() -> None:
    _, stage, _ = levelled_stop(0)
    learned = stage.list_learned()
    near = 2 * learned["tilt_sigma"] + 5e-4
    assert learned["tilt_expected"] == pytest.approx(-GAIN, abs=near)


@pytest.mark.slow
def test_heights_are_carried_by_the_pitch_that_was_found() -> None:
    stop, lever_m = stop_on_hump(), {"left": 0.3, "right": -0.6}
    block = stop.block()
    own = {ChannelId("height", track): lever for track, lever in lever_m.items()}
    values = {height: block[height] + x * np.sin(stop.pitch) for height, x in own.items()}
    out = pass_through(LevelByRoad(lever_m), stop, block.setting(values, {}))
    where = out[SHARE] > 0.99
    for height, lever in own.items():
        off = (out[height] - block[height])[where]
        assert np.std(off) < 5e-3 * abs(lever)


def test_a_run_without_brakes_is_left_bit_for_bit() -> None:
    stop = stop_on_hump()
    steady = Block(0, {c: v[:700] for c, v in stop.block().values.items()})
    out = pass_through(LevelByRoad(LEVEL), stop, steady)
    np.testing.assert_array_equal(out[FORCE], steady[FORCE])
    np.testing.assert_array_equal(out[HEIGHT], steady[HEIGHT])
    assert not out[SHARE].any()
    assert not out[SIGMA].any()
    # Blocks wait for minutes: what is left has no copy, and all zeros are one array.
    assert np.shares_memory(out[FORCE], steady[FORCE])
    assert np.shares_memory(out[HEIGHT], steady[HEIGHT])
    assert np.shares_memory(out[SHARE], out[SIGMA])


@pytest.mark.parametrize("samples", [1, 7, 24, 40])
def test_a_run_too_short_to_have_an_acceleration_is_left(samples) -> None:
    stop = stop_on_hump()
    short = Block(0, {c: v[:samples] for c, v in stop.block().values.items()})
    out = pass_through(LevelByRoad(LEVEL), stop, short)
    np.testing.assert_array_equal(out[FORCE], short[FORCE])
    assert not out[SHARE].any()


@given(pitch=ANGLES, lean=ANGLES, grade=ANGLES, expected=ANGLES)
@settings(deadline=None, max_examples=8)
def test_forces_are_those_of_a_level_accelerometer_but_for_what_is_left_to_others(
    pitch, lean, grade, expected
) -> None:
    """An axis at the pitch P = θ + λ reads g cos P - a sin P, and a level one g.

    The lean at rest is left to the bias, what a grade adds to the high-pass, and a third of the
    lean that is expected to the smoother.
    """
    stop, along = short_brake(), -3.0
    known = [np.full(stop.force.size, each) for each in (1.0, pitch, lean, grade, 0.01)]
    stage = LevelByRoad(LEVEL, RoadPrior(lean_expected_rad=-expected))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(levelled.Levelled, "of", lambda *_: levelled.Levelled(*known, []))
        out = pass_through(stage, stop, stop.block())
    read = G * np.cos(pitch + lean) - along * np.sin(pitch + lean)
    left = G * (1.0 - np.cos(lean)) + along * (grade + expected / 3.0)
    raised = (out[FORCE] - stop.force)[40:-40]
    # What is left is of the third order.
    np.testing.assert_allclose(raised, G - read - left, atol=1e-3)
    assert np.all(out[SHARE] == 1.0)
    assert np.all(out[SIGMA] == 0.01)


@pytest.mark.parametrize("samples", [1, 5, 7])
def test_a_last_bin_that_is_cut_short_is_no_brake(samples) -> None:
    """Of a run at one speed: the mean of some samples lies before the middle of their bin."""
    n, rate = 3000 + samples, 1000
    stop = stop_on_hump()
    values = {c: np.resize(v, n) for c, v in stop.block().values.items()}
    block = Block(0, values | {DISTANCE: 15.0 * np.arange(n) / rate})
    header = replace(stop.header, step=1 / rate, rate=Fraction(rate))
    stage = LevelByRoad(LEVEL)
    stage.start(header)
    stage.survey(block)
    out = stage.push(block)
    assert not out[SHARE].any()
    np.testing.assert_array_equal(out[FORCE], block[FORCE])


@pytest.mark.slow
@pytest.mark.parametrize("lost", ["vertical_specific_force", "height"])
def test_a_gap_while_braking_makes_it_less_sure_and_little_worse(lost) -> None:
    stop, _, whole = levelled_stop(0)
    gap = pass_through(LevelByRoad(LEVEL), stop, stop.block(lost, slice(1050, 1080)))
    where = (whole[SHARE] > 0.99) & (gap[SHARE] > 0.99)
    assert gap[SIGMA][where].mean() > whole[SIGMA][where].mean()
    known = where & ~np.isnan(gap[FORCE])
    moved, before = (np.abs(x)[known] for x in (gap[FORCE] - whole[FORCE], stop.force - stop.level))
    assert moved.max() < 0.2 * before.max()


@pytest.mark.slow
def test_a_stretch_that_does_not_settle_is_left_and_all_of_it_is_unsure(
    monkeypatch,
) -> None:
    monkeypatch.setattr(levelled, "UNSETTLED_RAD", 0.0)
    stop, stage = stop_on_hump(), LevelByRoad(LEVEL)
    block = stop.block()
    out = pass_through(stage, stop, block)
    np.testing.assert_array_equal(out[FORCE], block[FORCE])
    assert not out[SHARE].any()
    assert out[SIGMA].max() == levelled.UNKNOWN_M
    assert stage.list_learned() == {}


@pytest.mark.slow
def test_the_constants_are_those_of_the_smoother() -> None:
    """A vehicle that is known to pitch by a fifth more than it does is believed."""
    stop, known = stop_on_hump(), 1.2 * GAIN
    stage = LevelByRoad(LEVEL, RoadPrior(tilt_expected=-known, tilt_sigma=1e-6))
    pass_through(stage, stop, stop.block())
    assert stage.list_learned()["tilt_expected"] == pytest.approx(-known, rel=1e-3)


@pytest.mark.slow
class TestLevelByRoad(StageLaws):
    """In a brake: a lost sample is bridged, and moves the pitch of all wheel paths a little."""

    reads = ("vertical_specific_force", "height")
    shared = ("distance",)
    ranges: ClassVar = {"vertical_specific_force": (9.78, 9.83), "height": (0.299, 0.301)}
    tolerance = 2e-3
    reach = None

    def make(self) -> LevelByRoad:
        return LevelByRoad({"left": 0.05, "right": -0.02})

    def stream(self, seed: int = 0):
        stream = super().stream(seed)
        seconds = STEP * np.arange(stream.samples[DISTANCE].size)
        distance = 10.0 * seconds - 1.0 * seconds**2
        return stream.change(lambda c, x: distance if c.name == "distance" else x)


def test_it_works_in_time_only() -> None:
    header = Header(Axis.DISTANCE, 0.01, 0.0, None, frozenset(), ("left",))
    with pytest.raises(InputError, match="not on the time axis"):
        LevelByRoad({"left": 0.1}).start(header)
