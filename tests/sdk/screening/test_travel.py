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
