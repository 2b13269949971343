"""The modelled pitch is that of a body that really pitches, and the stage keeps the laws."""

from fractions import Fraction
from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import butter, sosfiltfilt

from floatref import AxleSetup, Setup, TrackSetup
from floatref.errors import InputError
from floatref.estimators.laser_place import HeightByModel
from floatref.estimators.laser_place.half_car import PITCH, STATES, Gains, HalfCar
from floatref.estimators.laser_place.pitching import Places, model_pitch
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref_conformance.testing import StageLaws

STEP, SPEED, AHEAD_M = 0.01, 20.0, 0.3
AXLES, AT_M = AxleSetup(3.4, 1.7), -2.9
NEAR_END = slice(400, -400)


class Drive:
    """A half car that rolls over a drawn road, integrated in steps of a tenth of a reading."""

    def __init__(self, seed: int, seconds: float = 40.0) -> None:
        rng, fine = np.random.default_rng(seed), STEP / 10
        n = round(seconds / fine)
        x = SPEED * fine * np.arange(n)
        road_at = np.arange(-20.0, x[-1] + 20.0, 0.05)
        road = np.cumsum(0.001 * rng.normal(size=road_at.size))
        under = [np.interp(x + axle, road_at, road) for axle in (1.7, -1.7)]
        car = HalfCar.usual(AXLES, AT_M)
        gains = Gains.of(car, fine)
        u = np.stack([*under, np.zeros(n)], axis=1)
        states = np.empty((n, STATES))
        states[0] = car.at_rest(u[0])
        for k in range(1, n):
            driven = gains.before @ u[k - 1] + gains.now @ u[k]
            states[k] = gains.transition @ states[k - 1] + driven
        force = states @ car.reading + u @ car.direct
        self.pitch = states[:, PITCH]
        above = states[:, 0] + AT_M * self.pitch + AHEAD_M * self.pitch
        height = above - np.interp(x + AT_M + AHEAD_M, road_at, road)
        means = (v.reshape(-1, 10).mean(axis=1) for v in (force, height, x, self.pitch))
        self.force, self.height, self.distance, self.pitch = means


def share_off(found: np.ndarray, pitch: np.ndarray) -> float:
    """Return the error of a pitch over the pitch, both from 1 to 6 Hz and away from the ends."""
    band = butter(3, [1.0, 6.0], "bandpass", fs=1.0 / STEP, output="sos")
    off, whole = (sosfiltfilt(band, x)[NEAR_END] for x in (found - pitch, pitch))
    return float(np.std(off) / np.std(whole))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_pitch_of_a_usual_vehicle_is_found(seed: int) -> None:
    """Its own vehicle, perfect sensors: within a sixth; twice as far off with other axles."""
    drive = Drive(seed)
    series = drive.force, drive.height, drive.distance
    found = model_pitch(*series, Places(AT_M, AT_M + AHEAD_M, AXLES, STEP))
    off = share_off(found, drive.pitch)
    assert off < 1 / 6
    misplaced = Places(AT_M, AT_M + AHEAD_M, AxleSetup(3.4, 4.0), STEP)
    assert share_off(model_pitch(*series, misplaced), drive.pitch) > 2 * off


@pytest.mark.slow
def test_windows_of_a_long_run_pass_into_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    drive = Drive(3, 120.0)
    places = Places(AT_M, AT_M + AHEAD_M, AXLES, STEP)
    series = drive.force, drive.height, drive.distance
    whole = model_pitch(*series, places)
    module = "floatref.estimators.laser_place.pitching"
    monkeypatch.setattr(f"{module}.WINDOW_S", 30.0)
    monkeypatch.setattr(f"{module}.SHARED_S", 15.0)
    parts = model_pitch(*series, places)
    step, scale = np.diff(parts - whole), np.std(np.diff(whole[NEAR_END]))
    assert np.std(step[NEAR_END]) < 0.2 * scale


@pytest.mark.slow
def test_a_bounce_test_has_no_pitch_that_could_be_known() -> None:
    """The body moves by 10 mm at 1.5 Hz over one point, an artificial encoder says 20 m/s."""
    t, omega = STEP * np.arange(3000), 2 * np.pi * 1.5
    rng = np.random.default_rng(0)
    moved = 0.01 * np.sin(omega * t)
    height = 0.3 + moved + 1e-5 * rng.normal(size=t.size)
    places = Places(AT_M, AT_M + AHEAD_M, AXLES, STEP)
    assert not model_pitch(-(omega**2) * moved, height, SPEED * t, places).any()


@pytest.mark.parametrize("lost", ["force", "height", "distance", "short"])
def test_without_a_sensor_there_is_no_pitch(lost: str) -> None:
    n = 20 if lost == "short" else 500
    rng = np.random.default_rng(0)
    series = {"force": rng.normal(size=n), "height": rng.normal(size=n), "distance": np.arange(n)}
    if lost != "short":
        series[lost] = np.full(n, np.nan)
    found = model_pitch(*series.values(), Places(0.0, 0.3, AXLES, STEP))
    assert not found.any()


class TestHeightByModel(StageLaws):
    """One sample is bridged in the pitch of all wheel paths, and moves other heights a little."""

    reads = ("vertical_specific_force", "height")
    shared = ("distance",)
    ranges: ClassVar = {"vertical_specific_force": (9.3, 10.3), "height": (0.29, 0.31)}
    tolerance = 2e-3
    reach = None

    def make(self) -> HeightByModel:
        return HeightByModel({"left": 0.05, "right": -0.02})

    def stream(self, seed: int = 0):  # type: ignore[no-untyped-def]  # As that of its base.
        stream = super().stream(seed)
        distance = np.cumsum(np.abs(stream.samples[ChannelId("distance")]))
        return stream.change(lambda c, x: distance if c.name == "distance" else x)


def test_every_wheel_path_has_its_own_lever_and_the_flags_of_its_accelerometer() -> None:
    drive, stage = Drive(4, 10.0), HeightByModel({"left": 0.3, "right": -0.6})
    names = ("vertical_specific_force", "height")
    force, height = ({t: ChannelId(n, t) for t in ("left", "right")} for n in names)
    values = dict.fromkeys(force.values(), drive.force + STANDARD_GRAVITY)
    values |= dict.fromkeys(height.values(), drive.height)
    values[ChannelId("distance")] = drive.distance
    marks = np.zeros(drive.force.size, np.uint8)
    marks[500] = Flag.MISSING
    place = TrackSetup((AT_M, 0.0, 0.0))
    setup = Setup(tracks={"left": place, "right": place}, axles=AXLES)
    channels = frozenset(values)
    tracks = ("left", "right")
    header = Header(Axis.TIME, STEP, 0.0, Fraction(100), channels, tracks, setup)
    block = Block(7, values, {}, {force["left"]: marks})
    assert stage.start(header).channels == channels
    stage.survey(block)
    out = stage.push(block)
    raised = {t: drive.height - out[height[t]] for t in ("left", "right")}
    np.testing.assert_allclose(raised["right"], -2.0 * raised["left"], atol=1e-12)
    assert np.std(raised["left"]) > 1e-5
    assert out.flags[height["left"]][500] == Flag.MISSING
    assert height["right"] not in out.flags


def heights_of(samples: int, speed: float) -> np.ndarray:
    """Return the heights carried by 1 m of a run at one speed on a rough road, in kHz."""
    rng = np.random.default_rng(1)
    t = np.arange(2000) / 1000.0
    swayed = 0.01 * np.sin(2 * np.pi * 2.0 * t)
    names = ("vertical_specific_force", "height")
    force, height = (ChannelId(name, "left") for name in names)
    values = {
        force: STANDARD_GRAVITY - (4 * np.pi) ** 2 * swayed,
        height: 0.3 + swayed + 1e-3 * rng.normal(size=t.size).cumsum() / 30,
        ChannelId("distance"): speed * t,
    }
    setup = Setup(tracks={"left": TrackSetup((AT_M, 0.0, 0.0))}, axles=AXLES)
    header = Header(Axis.TIME, 1e-3, 0.0, Fraction(1000), frozenset(values), ("left",), setup)
    block = Block(0, {channel: x[:samples].copy() for channel, x in values.items()})
    stage = HeightByModel({"left": 1.0})
    stage.start(header)
    stage.survey(block)
    found: np.ndarray = block[height] - stage.push(block)[height]
    return found


@settings(deadline=None, max_examples=5)
@given(more=st.integers(1, 9), speed=st.floats(5.0, 30.0))
def test_the_end_of_a_run_at_one_speed_is_no_brake(more: int, speed: float) -> None:
    """A bin that is cut short lies before its middle: nobody takes that for a brake."""
    whole, longer = heights_of(1500, speed), heights_of(1500 + more, speed)
    # The last bin is held beyond its middle.
    np.testing.assert_array_equal(longer[:1500], whole)
    np.testing.assert_array_equal(longer[1500:], whole[-1])
    assert np.std(whole) > 0.0


def test_a_run_shorter_than_a_bin_is_carried_nowhere() -> None:
    assert not heights_of(7, 20.0).any()


def test_it_works_in_time_only() -> None:
    header = Header(Axis.DISTANCE, STEP, 0.0, Fraction(100), frozenset(), ("left",))
    with pytest.raises(InputError, match="not on the time axis"):
        HeightByModel({"left": 0.1}).start(header)
