"""The travel speed of a recording, against the stage and against the drive."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.travel import Travel
from floatref.stages.speed import WINDOW_S, TravelSpeed
from floatref.values.arrays import FloatArray
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

DISTANCE, SPEED = ChannelId("distance"), ChannelId("travel_speed")


def recorded(distance: FloatArray, rate_hz: float) -> Recording:
    return Recording((Channel.of("distance", distance, UniformClock.of(rate_hz)),))


def of_stage(distance: FloatArray) -> FloatArray:
    """Return what the stage makes of distances `WINDOW_S` apart, but for the first."""
    rate = 1 / Fraction(str(WINDOW_S))
    stage = TravelSpeed()
    stage.start(Header(Axis.TIME, WINDOW_S, 0.0, rate, frozenset({DISTANCE}), ("main",)))
    return stage.push(Block(0, {DISTANCE: distance}))[SPEED][1:]


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(2, 500))
def test_at_its_own_rate_it_is_the_speed_of_the_stage(seed: int, count: int) -> None:
    distance = np.cumsum(np.random.default_rng(seed).uniform(0.0, 1.6, count))
    travel = Travel.of(recorded(distance, 20.0))
    expected = of_stage(distance)[: travel.speed_mps.size]
    assert expected.size >= count - 2
    np.testing.assert_allclose(travel.speed_mps, expected, rtol=0, atol=1e-9)


@settings(deadline=None, max_examples=30)
@given(
    speed=st.floats(0.0, 35.0),
    rate_hz=st.sampled_from([20.0, 333.0, 4000.0]),
    missing=st.floats(0.0, 0.5),
)
def test_a_constant_speed_is_found_past_missing_samples(
    speed: float, rate_hz: float, missing: float
) -> None:
    times = np.arange(int(4.0 * rate_hz)) / rate_hz
    distance = 7.0 + speed * times
    distance[np.random.default_rng(0).random(times.size) < missing] = np.nan
    travel = Travel.of(recorded(distance, rate_hz))
    np.testing.assert_allclose(travel.speed_mps, speed, rtol=0, atol=1e-9)
    assert travel.fastest_mps == pytest.approx(speed, abs=1e-9)


def test_the_fastest_second_counts() -> None:
    speed = np.concatenate([np.full(60, 5.0), np.full(20, 12.0), np.full(60, 8.0)])
    travel = Travel.of(recorded(np.cumsum(speed) * WINDOW_S, 20.0))
    assert travel.fastest_mps == pytest.approx(12.0)


def test_a_run_without_a_step_has_no_speed() -> None:
    travel = Travel.of(recorded(np.zeros(1), 20.0))
    assert (travel.distance_m.size, travel.speed_mps.size, travel.fastest_mps) == (0, 0, 0.0)


@settings(deadline=None, max_examples=30)
@given(
    stops=st.lists(st.tuples(st.floats(3.0, 60.0), st.floats(1.0, 9.0)), max_size=4),
    count_m=st.sampled_from([0.0003, 0.00127, 0.01]),
    rate_hz=st.sampled_from([100.0, 1000.0]),
)
def test_stops_are_where_the_vehicle_is_stationary(
    stops: list[tuple[float, float]], count_m: float, rate_hz: float
) -> None:
    """It drives each length in m at 10 m/s, then stops for so many seconds, and drives on."""
    parts, at, places = [], 0.0, []
    for length, rest_s in stops:
        parts += [at + np.arange(0.0, length, 10.0 / rate_hz), np.full(round(rest_s * rate_hz), 0)]
        at += length
        parts[-1] = parts[-1] + at
        places.append(at)
    parts.append(at + np.arange(0.0, 30.0, 10.0 / rate_hz))
    counted = count_m * np.floor(np.concatenate(parts) / count_m)
    travel = Travel.of(recorded(counted, rate_hz))
    np.testing.assert_allclose(travel.stops_m(), places, rtol=0, atol=0.05)
    stretches = travel.slow_stretches_m(4.0)
    assert len(stretches) == len(places)
    for place, (begin, end) in zip(places, stretches, strict=True):
        assert begin - 0.1 <= place <= end + 0.1
        assert end - begin < 4.0


@settings(deadline=None, max_examples=30)
@given(speed=st.floats(0.1, 3.9), count_m=st.sampled_from([0.0003, 0.01]))
def test_creeping_is_slow_and_no_stop(speed: float, count_m: float) -> None:
    fast, slow = np.arange(0.0, 30.0, 0.1), np.arange(0.0, 8.0, speed / 100.0)
    distance = np.concatenate([fast, 30.0 + slow, 38.0 + fast])
    travel = Travel.of(recorded(count_m * np.floor(distance / count_m), 100.0))
    assert not travel.stops_m()
    ((begin, end),) = travel.slow_stretches_m(4.0)
    assert (begin, end) == pytest.approx((30.0, 38.0), abs=5.0)


def test_counts_that_are_lost_at_speed_are_no_stop() -> None:
    speed = np.concatenate([np.full(200, 25.0), np.zeros(200), np.full(200, 25.0)])
    travel = Travel.of(recorded(np.cumsum(speed) / 100.0, 100.0))
    assert travel.stops_m() == travel.slow_stretches_m(4.0) == ()
