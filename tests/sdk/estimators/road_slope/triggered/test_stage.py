"""Of triggered samples a stop on a hump is levelled, and its road is left out."""

from dataclasses import replace
from functools import cache
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.drawn_stops import (
    DISTANCE,
    LEVEL,
    STEP,
    G,
    short_brake,
    stop_on_hump,
)

from floatref.errors import InputError
from floatref.estimators.road_prior import RoadPrior
from floatref.estimators.road_prior.excitation import Excitation
from floatref.estimators.road_slope import LevelTriggered
from floatref.estimators.road_slope.triggered.expected_road import LevelledRoad
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws

FORCE, HEIGHT = (ChannelId(n, "left") for n in ("vertical_acceleration", "height"))
MISSING, ROAD = ChannelId("missing_share"), ChannelId("expected_road")
SIGMA = ChannelId("levelling_sigma")
ANGLES = st.floats(-0.05, 0.05)


def triggered(stop, lost=slice(0)):
    """Return header and block of the ``stop``, as `ToTime` has them: nothing at the standstill."""
    standing = np.gradient(stop.distance, STEP) < 0.05
    away: np.ndarray = standing * np.uint8(Flag.MISSING)
    distance = stop.distance.copy()
    distance[lost] = np.nan
    values, flags = {DISTANCE: distance, MISSING: 1.0 * standing}, {}
    for track in LEVEL:
        force, height = ChannelId("vertical_acceleration", track), ChannelId("height", track)
        values |= {force: (stop.force - G) * ~standing, height: stop.height.copy()}
        flags[height] = away
    return replace(stop.header, channels=frozenset(values)), Block(0, values, flags=flags)


def pass_through(stage, header, block):
    """Return what the stage makes of ``block``, the whole run."""
    stage.start(header)
    stage.survey(block)
    return stage.push(block)


@cache
def levelled_stop():
    stop, stage = stop_on_hump(), LevelTriggered(LEVEL)
    header, block = triggered(stop)
    return stop, stage, block, pass_through(stage, header, block)


def follow(stop):
    """Return acceleration along the road and the pitch response as the smoother has them."""
    c = RoadPrior()
    excitation = Excitation.of(STEP, c.pitch_hz, c.pitch_damping)
    excitation.add(stop.distance)
    excitation.end()
    return excitation.take()


def left_over(force, stop, where):
    """Return the height in m that ``force`` makes in 1.5 s, but for what the smoother knows.

    That is a bias, and what acceleration along the road makes of lean and pitch.
    """
    width, (along, response) = round(0.75 / STEP), follow(stop)
    box = np.full(width, 1.0 / width)
    rows = [
        np.convolve(np.convolve(x, box, "same"), box, "same")[where] * 0.75**2
        for x in (force, np.ones(force.size), along, along * response)
    ]
    known = np.stack(rows[1:], axis=1)
    return rows[0] - known @ np.linalg.lstsq(known, rows[0], rcond=None)[0]


def test_what_is_left_is_what_the_smoother_knows() -> None:
    """What the road makes of the pitch is gone but for a third, and the road is given apart."""
    stop, _, block, out = levelled_stop()
    moving = block[MISSING] == 0.0
    where = moving & (out[SIGMA] > 0.0) & (np.abs(np.gradient(stop.distance, STEP)) > 1.0)
    bent = np.gradient(np.gradient(out[ROAD], STEP), STEP)
    level = (stop.level - G) * moving
    before, after = block[FORCE] - level, out[FORCE] + bent * moving - level
    off = [np.std(left_over(x, stop, where)) for x in (before, after)]
    assert off[1] < 0.33 * off[0]


@given(pitch=ANGLES, lean=ANGLES, grade=ANGLES, gain=st.floats(0.0, 0.01), slope=ANGLES)
@settings(deadline=None, max_examples=8)
def test_what_acceleration_makes_of_the_pitch_is_left(pitch, lean, grade, gain, slope) -> None:
    """An axis at the pitch P = θ + λ reads g cos P - a sin P; of θ the part κ u is the smoother's.

    The lean is, too, and an even grade that is expected has the acceleration a s.
    """
    stop = short_brake()
    header, block = triggered(stop)
    full = np.ones(stop.force.size)
    found = LevelledRoad(*(each * full for each in (1.0, pitch, lean, grade, 0.01)), [])
    found.weight, found.gains_weighted, found.slopes_weighted = full, gain * full, slope * full
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(LevelledRoad, "over", lambda *_: found)
        out = pass_through(LevelTriggered(LEVEL), header, block)
    along, response = follow(stop)
    by_gravity = G * (np.cos(lean) - np.cos(pitch + lean))
    expected = along * (pitch - gain * response - grade - slope) + by_gravity
    inside = slice(40, -40)
    raised = (out[FORCE] - block[FORCE])[inside]
    np.testing.assert_allclose(raised, expected[inside], atol=1e-3)
    np.testing.assert_allclose(out[ROAD], slope * (stop.distance - stop.distance[0]), atol=1e-9)


def test_the_expected_road_is_the_hump() -> None:
    stop, _, _, out = levelled_stop()
    top = stop.distance[np.flatnonzero(np.diff(stop.distance) < 1e-9)[0]] + 4.3
    hump = 0.1 * np.exp(-np.square((stop.distance - top) / 8.0))
    near = np.abs(stop.distance - top) < 25.0
    x = stop.distance[near] - top
    # A fit does not know a bias from long waves: they are up to the smoother.
    off = out[ROAD][near] - hump[near]
    assert np.std(off - np.polyval(np.polyfit(x, off, 2), x)) < 0.15 * np.std(hump[near])


def test_a_height_away_from_triggers_says_nothing_of_the_acceleration_beside_it() -> None:
    _, _, block, out = levelled_stop()
    assert not out.flags[FORCE].any()
    np.testing.assert_array_equal(out.flags[HEIGHT], block.flags[HEIGHT])


def test_where_all_of_the_acceleration_is_missing_nothing_is_added() -> None:
    _, _, block, out = levelled_stop()
    gone = block[MISSING] == 1.0
    np.testing.assert_array_equal(out[FORCE][gone], block[FORCE][gone])


def test_it_learns_nothing_that_the_smoother_learns() -> None:
    assert levelled_stop()[1].list_learned() == {}


@pytest.mark.slow
@given(samples=st.integers(1, 700))
@settings(deadline=None, max_examples=8)
def test_a_run_without_brakes_is_left_bit_for_bit(samples) -> None:
    header, block = triggered(stop_on_hump())
    steady = block.part(0, samples)
    out = pass_through(LevelTriggered(LEVEL), header, steady)
    np.testing.assert_array_equal(out[FORCE], steady[FORCE])
    np.testing.assert_array_equal(out[HEIGHT], steady[HEIGHT])
    assert not out[ROAD].any()
    assert not out[SIGMA].any()


@pytest.mark.slow
@given(known=st.lists(st.booleans(), min_size=20, max_size=20), height=st.floats(-1.0, 1.0))
def test_one_reading_in_a_bin_is_enough(known, height) -> None:
    """Bins of ten samples at 1 kHz."""
    header, block = triggered(stop_on_hump())
    stage = LevelTriggered(LEVEL)
    stage.start(replace(header, step=STEP / 10))
    part = block.part(0, 20)
    values = {c: np.full(20, height) for c in part.values if c.name == "height"}
    flags = {c: np.where(known, 0, np.uint8(Flag.MISSING)).astype(np.uint8) for c in values}
    stage.survey(part.setting(values, flags))
    left, share = stage.whole_bins()[1], stage.memory["share"]
    expected = [height if any(known[k : k + 10]) else np.nan for k in (0, 10)]
    np.testing.assert_allclose(left, expected, atol=1e-12)
    np.testing.assert_array_equal(share, 0.0)


@pytest.mark.slow
def test_travel_that_the_encoder_lost_is_bridged() -> None:
    header, block = triggered(stop_on_hump(), lost=slice(300, 340))
    out = pass_through(LevelTriggered(LEVEL), header, block)
    assert np.isfinite(out[FORCE]).all()
    assert np.isfinite(out[ROAD]).all()


@pytest.mark.slow
class TestLevelTriggered(StageLaws):
    """In a brake: a lost sample is bridged, and moves the pitch of all wheel paths a little."""

    reads = ("vertical_acceleration", "height")
    shared = ("distance", "missing_share")
    ranges: ClassVar = {
        "vertical_acceleration": (-0.02, 0.02),
        "height": (0.299, 0.301),
        "missing_share": (0.0, 0.1),
    }
    tolerance = 2e-3
    reach = None

    def make(self) -> LevelTriggered:
        return LevelTriggered({"left": 0.05, "right": -0.02})

    def stream(self, seed: int = 0):
        stream = super().stream(seed)
        seconds = STEP * np.arange(stream.samples[DISTANCE].size)
        distance = 10.0 * seconds - 1.0 * seconds**2
        return stream.change(lambda c, x: distance if c.name == "distance" else x)


def test_it_works_in_time_only() -> None:
    header = Header(Axis.DISTANCE, 0.01, 0.0, None, frozenset((MISSING,)), ("left",))
    with pytest.raises(InputError, match="not on the time axis"):
        LevelTriggered({"left": 0.1}).start(header)
