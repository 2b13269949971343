"""The laws of the stage protocol, for the stages of the response architecture."""

from dataclasses import replace
from fractions import Fraction
from functools import partial
from types import MappingProxyType

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.arrays import Flag, FloatArray
from floatref.values.block import Axis
from floatref.values.channels import ChannelId
from floatref.vehicle_response import Kind, QuarterCar, Reading
from floatref.vehicle_response.estimators.estimate import Estimate
from floatref.vehicle_response.estimators.gains import default_gains
from floatref.vehicle_response.estimators.observer import UnknownInputObserver
from floatref.vehicle_response.stages import (
    Abeam,
    Denoise,
    EstimateRoad,
    Group,
    JoinTyres,
    ShiftAlong,
    ToRate,
    WithPlaces,
)
from floatref.vehicle_response.stages.estimation import drift_sigma
from floatref_conformance.testing import StageLaws
from floatref_conformance.testing.streams import Stream

TRACKS = "left", "right"
UNDER, SIGMA = "elevation_under_tyre_0", "sigma_under_tyre_0"
REAR, REAR_SIGMA = "elevation_under_tyre_1", "sigma_under_tyre_1"
SHIFTS = {
    ChannelId(name, track): shift
    for name in (UNDER, SIGMA)
    for track, shift in (("left", 0.037), ("right", -0.104))
}
MODEL = QuarterCar(700.0, 75.0, 45000.0, 3300.0, 320000.0).model()
STEP_S = 0.01


def group(track: str) -> Group:
    measured = [Reading(Kind.DISPLACEMENT, name, 1e-3) for name in ("body", "wheel")]
    gains = default_gains(MODEL, measured, 20.0, 3.0)
    observer = UnknownInputObserver.of(MODEL, STEP_S, gains, measured, 0.03)
    inputs = [ChannelId(f"{name}_displacement", track) for name in ("sprung", "unsprung")]
    inputs.append(ChannelId("unsprung_acceleration", track))
    return Group(
        MODEL,
        WithPlaces(observer, (0, 1), (2,)),
        tuple((channel, 1.0) for channel in inputs),
        (track,),
        (1e-3,),
    )


class TestToRate(StageLaws):
    reads = "unsprung_acceleration", "sprung_displacement"
    shared = "distance", "high_pass_cutoff"
    keeps_index = False
    reach = 30

    def make(self) -> ToRate:
        return ToRate(Fraction(83, 2))


class TestShiftAlong(StageLaws):
    reads = UNDER, SIGMA
    axis = Axis.DISTANCE

    def make(self) -> ShiftAlong:
        return ShiftAlong(SHIFTS)


class TestAbeam(StageLaws):
    """Wheel paths on the axis of one laser: elevations and their 1-σ move together."""

    reads = "elevation", "elevation_sigma"
    axis = Axis.DISTANCE

    def make(self) -> Abeam:
        return Abeam({"left": 0.0, "right": 0.0325})


class TestDenoise(StageLaws):
    reads = ("unsprung_acceleration",)
    reach = None
    tolerance = 1e-6

    def make(self) -> Denoise:
        return Denoise(("unsprung_acceleration",), 3, 0.2)


class TestJoinTyres(StageLaws):
    reads = UNDER, SIGMA, REAR, REAR_SIGMA
    ranges = MappingProxyType({SIGMA: (1e-4, 1e-2), REAR_SIGMA: (1e-4, 1e-2)})
    axis = Axis.DISTANCE

    def make(self) -> JoinTyres:
        return JoinTyres(dict.fromkeys(TRACKS, (0, 1)))


@pytest.mark.slow
class TestEstimateRoad(StageLaws):
    reads = "sprung_displacement", "unsprung_displacement", "unsprung_acceleration"
    shared = ("high_pass_cutoff",)
    ranges = MappingProxyType({"high_pass_cutoff": (0.05, 0.5)})
    reach = None

    def make(self) -> EstimateRoad:
        return EstimateRoad([group(track) for track in TRACKS])


def test_the_rate_of_the_stream_leaves_all_as_it_was() -> None:
    class Case(TestToRate):
        def make(self) -> ToRate:
            return ToRate(Fraction(100))

    stream = Case().stream(3)
    out = stream.run([50, 60])
    for channel, values in stream.samples.items():
        np.testing.assert_array_equal(out[channel], values)


@pytest.mark.parametrize("rate", [17, 40, 61])
def test_slow_signals_keep_their_times(rate: int) -> None:
    at = np.arange(2000) / 100.0
    channel = ChannelId("unsprung_acceleration", "left")
    line = ChannelId("distance")
    samples = {channel: np.cos(2.0 * np.pi * 1.3 * at), line: 7.0 + 3.0 * at}
    stream = Stream(lambda: ToRate(Fraction(rate)), samples, ("left",))
    out = stream.run([777])
    there = np.arange(len(out)) / rate
    assert there[-2] < at[-1] <= there[-1]
    expected = 7.0 + 3.0 * np.minimum(there, at[-1])
    np.testing.assert_allclose(out[line], expected, atol=1e-9)
    inner = slice(2 * rate, -2 * rate)
    np.testing.assert_allclose(
        out[channel][inner], np.cos(2.0 * np.pi * 1.3 * there[inner]), atol=2e-3
    )


@pytest.mark.parametrize("points", [-7, 0, 12])
def test_a_shift_by_whole_points_moves_them(points: int) -> None:
    channel = ChannelId(UNDER, "left")
    x = np.random.default_rng(0).standard_normal(100)
    make = partial(ShiftAlong, {channel: points * STEP_S})
    out = Stream(make, {channel: x}, ("left",), Axis.DISTANCE).run([30, 31])
    assert len(out) == 100
    moved = np.full(100, np.nan)
    moved[max(0, points) : 100 + min(0, points)] = x[max(0, -points) : 100 - max(0, points)]
    np.testing.assert_array_equal(out[channel], moved)
    flags = out.flags.get(channel, np.zeros(100, np.uint8))
    np.testing.assert_array_equal((flags & Flag.MISSING) != 0, np.isnan(moved))


def test_a_shift_by_part_of_a_point_is_linear() -> None:
    channel = ChannelId(UNDER, "left")
    x = 2.0 * np.arange(50.0)
    stream = Stream(lambda: ShiftAlong({channel: 0.0125}), {channel: x}, ("left",), Axis.DISTANCE)
    np.testing.assert_allclose(stream.run()[channel][2:], (x - 2.5)[2:], atol=1e-9)


def test_the_better_tyre_counts_more_and_a_lost_one_not_at_all() -> None:
    names = UNDER, SIGMA, REAR, REAR_SIGMA
    rows = np.array([[1.0, 1e-3, 4.0, 2e-3], [1.0, np.nan, 4.0, 2e-3], [1.0, np.nan, 4.0, np.nan]])
    values = {ChannelId(name, "left"): rows[:, k] for k, name in enumerate(names)}
    marks = {ChannelId(UNDER, "left"): np.array([0, 1, 1], np.uint8)}
    stream = Stream(lambda: JoinTyres({"left": (0, 1)}), values, ("left",), Axis.DISTANCE, 0, marks)
    out = stream.run()
    np.testing.assert_allclose(out[ChannelId("elevation", "left")], [1.6, 4.0, np.nan])
    np.testing.assert_allclose(out[ChannelId("elevation_sigma", "left")], [1e-3, 2e-3, np.nan])
    flags = out.flags[ChannelId("elevation", "left")]
    assert [bool(flag) for flag in flags] == [False, True, True]


def test_components_beyond_the_window_are_refused() -> None:
    stream = TestDenoise().stream()
    with pytest.raises(InputError, match="21 components of a window of 20 samples; give fewer"):
        Denoise(("unsprung_acceleration",), 21, 0.2).start(stream.header)


def test_stages_name_the_axis_they_need() -> None:
    time, distance = TestToRate().stream().header, TestShiftAlong().stream().header
    for stage in (ToRate(Fraction(10)), Denoise((UNDER,), 1, 0.1), EstimateRoad([group("left")])):
        with pytest.raises(InputError, match="is not on the time axis"):
            stage.start(distance)
    with pytest.raises(InputError, match="is not on the distance axis"):
        ShiftAlong(SHIFTS).start(time)


def test_the_last_distance_is_that_which_the_encoder_told_last() -> None:
    channel, line = ChannelId("unsprung_acceleration", "left"), ChannelId("distance")
    samples = {channel: np.zeros(200), line: 0.02 * np.arange(200)}
    for end_m in (3.5, 4.0):
        stream = Stream(partial(ToRate, Fraction(33), end_m), samples, ("left",))
        out = stream.run([77])
        assert out[line][-1] == max(end_m, samples[line][-1])
        assert (np.diff(out[line]) >= 0).all()


class Steady:
    """An estimator that knows the road 3 mm above the wheel, within 1 mm."""

    def begin(self) -> None:
        """Keep nothing."""

    def advance(self, memory: None, samples: FloatArray) -> Estimate:
        size, rest = len(samples), np.zeros((len(samples), 4))
        road = np.full((size, 1), 3e-3)
        return Estimate(road, np.full((size, 1), 1e-3), rest, rest)


def test_the_sigma_is_made_of_noise_drift_and_parameters() -> None:
    class Case(TestEstimateRoad):
        def make(self) -> EstimateRoad:
            return EstimateRoad([replace(group("left"), estimator=Steady())], parameter_sigma=0.5)

    stream = Case().stream(3)
    sigma = stream.run([50, 60])[ChannelId(SIGMA, "left")]
    drift = drift_sigma(1e-3, stream.samples[ChannelId("high_pass_cutoff")])
    assert drift.min() > 1e-5
    np.testing.assert_allclose(sigma, np.sqrt(1e-6 + drift**2 + (0.5 * 3e-3) ** 2), rtol=1e-9)


@pytest.mark.parametrize("points", [-7, 0, 12])
def test_a_flag_covers_the_way_that_a_value_is_shifted(points: int) -> None:
    """An encoder that leaps there misplaces all that was or will be shifted across."""
    channel = ChannelId(UNDER, "left")
    marks = np.zeros(100, np.uint8)
    marks[50:53] = Flag.SLOW
    stream = Stream(
        lambda: ShiftAlong({channel: points * STEP_S}),
        {channel: np.zeros(100)},
        ("left",),
        Axis.DISTANCE,
        flags={channel: marks},
    )
    found = np.flatnonzero(stream.run([30, 51, 60]).flags[channel] & Flag.SLOW)
    np.testing.assert_array_equal(found, np.arange(50 + min(points, 0), 53 + max(points, 0)))
