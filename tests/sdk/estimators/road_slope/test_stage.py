"""A stop on a hump is levelled; a run without brakes, and a stretch not understood, are left."""

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import StateSpace, lsim

from floatref import AxleSetup, Setup, TrackSetup
from floatref.errors import InputError
from floatref.estimators.road_prior import RoadPrior
from floatref.estimators.road_slope import LevelByRoad, levelled
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref_conformance.testing import StageLaws

FORCE, HEIGHT = (ChannelId(n, "left") for n in ("vertical_specific_force", "height"))
SHARE, SIGMA = ChannelId("levelled"), ChannelId("levelling_sigma")
DISTANCE = ChannelId("distance")
LEVEL = {"left": 0.0, "right": 0.0}
STEP, G = 0.01, STANDARD_GRAVITY
FRONT_M, BASE_M, LASER_M = 1.7, 3.4, -2.6
HZ, DAMPING, GAIN, GYRATION = 1.5, 0.3, 0.006, 0.9
ANGLES = st.floats(-0.05, 0.05)


@dataclass(frozen=True, eq=False)
class Stop:
    """What moves and what is read, each of shape (n,), 100 times a second; see `stop_on_hump`."""

    distance: np.ndarray
    pitch: np.ndarray
    level: np.ndarray
    force: np.ndarray
    height: np.ndarray

    @property
    def header(self):
        """The sensors of two wheel paths in time, and an encoder."""
        names = ("vertical_specific_force", "height")
        channels = {ChannelId(name, track) for name in names for track in LEVEL}
        place = TrackSetup((LASER_M, 0.0, 0.0))
        setup = Setup(tracks=dict.fromkeys(LEVEL, place), axles=AxleSetup(BASE_M, FRONT_M))
        rate, channels = Fraction(round(1 / STEP)), frozenset({*channels, DISTANCE})
        return Header(Axis.TIME, STEP, 0.0, rate, channels, tuple(LEVEL), setup)

    def block(self, lost="", where=slice(0)):
        """Return all of it; the channel ``lost`` has no reading at the samples ``where``."""
        series = {"vertical_specific_force": self.force, "height": self.height}
        values = {DISTANCE: self.distance}
        for name, read in series.items():
            kept = read.copy()
            kept[where if name == lost else slice(0)] = np.nan
            values |= {ChannelId(name, track): kept.copy() for track in LEVEL}
        return Block(0, values)


def stop_on_hump(height_m=0.1, seed=0):
    """Return a stop from 15 m/s with the front axle on top of a hump that is 30 m long."""
    speed = _speeds()
    distance, along = np.cumsum(speed) * STEP, np.gradient(speed, STEP)
    front_m = FRONT_M - LASER_M
    top = distance[np.flatnonzero(speed == 0)[0]] + front_m
    under = distance + front_m, distance + front_m - BASE_M, distance
    front, rear, laser = (height_m * np.exp(-np.square((x - top) / 8.0)) for x in under)
    slope = (front - rear) / BASE_M
    pitch = _follow(slope, HZ, DAMPING, GAIN * (along + G * slope))
    # Even springs carry the body as far apart as GYRATION of half the wheelbase would.
    bounce = _follow(0.5 * (front + rear), GYRATION * HZ, GYRATION * DAMPING)
    # The sensors are LASER_M from the middle between the axles.
    body = bounce + LASER_M * pitch + 0.3
    level = np.gradient(np.gradient(body, STEP), STEP) + G
    rng = np.random.default_rng(seed)
    noise, texture = rng.normal(size=(2, speed.size)) * [[2e-3], [1e-4]]
    force = level * np.cos(pitch) - along * np.sin(pitch) + noise
    return Stop(distance, pitch, level, force, body - laser + texture)


def short_brake():
    """Return 2 s of a brake by 3 m/s² on the level, with a body that does not move."""
    t, full = STEP * np.arange(200), np.ones(200)
    return Stop(20.0 * t - 1.5 * t**2, 0 * t, G * full, G * full, 0.3 * full)


def _speeds():
    """Return speeds in m/s: 8 s of travel, a stop of 6 s, and 8 s of travel."""
    fast = 15.0
    corners = np.cumsum([0.0, 8.0, fast / 3.0, 6.0, fast / 2.0, 8.0])
    return np.interp(np.arange(0.0, corners[-1], STEP), corners, [fast, fast, 0, 0, fast, fast])


def _follow(road, hz, damping, more=0.0):
    """Return how a mass on springs and dampers follows the ``road``; ``more`` is at rest."""
    w = 2 * np.pi * hz
    drive = road + 2 * damping / w * np.gradient(road, STEP) + more
    body = StateSpace([[0, 1], [-w * w, -2 * damping * w]], [[0], [w * w]], [[1, 0]], [[0]])
    start = [drive[0], 0.0]
    return lsim(body, drive, STEP * np.arange(road.size), start)[1]


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


@given(pitch=ANGLES, lean=ANGLES, grade=ANGLES, share=st.floats(0.0, 1.0), expected=ANGLES)
@settings(deadline=None, max_examples=8)
def test_forces_are_those_of_a_level_accelerometer_but_for_what_is_left_to_others(
    pitch, lean, grade, share, expected
) -> None:
    """Of what an axis at the pitch P = θ + λ reads less than level, to the second order.

    A grade is left to the high-pass, a lean at rest to the bias, and its third to the smoother.
    """
    stop = short_brake()
    known = [np.full(stop.force.size, each) for each in (share, pitch, lean, grade, 0.01)]
    stage = LevelByRoad(LEVEL, RoadPrior(lean_expected_rad=-expected))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(levelled.Levelled, "of", lambda *_: levelled.Levelled(*known, []))
        out = pass_through(stage, stop, stop.block())
    along, tilt = -3.0, pitch + lean
    read = G * np.cos(tilt) - along * np.sin(tilt)
    raised = (out[FORCE] - stop.force)[40:-40]
    weighed = G * np.cos(lean) - along * share * np.sin(grade + expected / 3)
    whole = G - read - (G - weighed) + along * (share - 1.0) * np.sin(tilt)
    if share > 0.0:
        np.testing.assert_allclose(raised, whole, atol=2e-3)
    np.testing.assert_array_equal(out[SHARE], share)
    np.testing.assert_array_equal(out[SIGMA], 0.01)


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
    """A vehicle that is known to pitch by half more than it does is believed."""
    stop, known = stop_on_hump(), 1.5 * GAIN
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
