"""Lasers against the road under the wheel: scale, sign, lag, exchange, and stretches."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.fast_series import STEP_S, FastGrid, band
from floatref.screening.second_sensor.laser_faults import laser_doubts
from floatref.screening.second_sensor.road_twice import BAND_HZ, TwoRoads, fit_laser, wheel_road
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId

COUNT = 5000
GRID = FastGrid(0.0, COUNT)
LEFT = ChannelId("height", "left")
WHEEL_LATE = 3
"""Lag of the wheel in steps of the grid."""


def path(seed: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return lift of the body, range and road by the wheel, in the band, in m."""
    source = np.random.default_rng(seed)
    lift, road = (0.01 * band(row, *BAND_HZ) for row in source.standard_normal((2, COUNT)))
    noise = 1e-4 * source.standard_normal(COUNT)
    return lift, lift - road, np.roll(road, WHEEL_LATE) + noise


def roads(height: FloatArray | None = None, seed: int = 0) -> dict[str, TwoRoads]:
    """Return two healthy wheel paths, with ``height`` in place of the left one's range."""
    known = np.ones(COUNT, np.bool_)
    known[:300] = known[-300:] = False
    found = {}
    for k, track in enumerate(("left", "right")):
        lift, own, wheel = path(seed + k)
        measured = height if height is not None and track == "left" else own
        found[track] = TwoRoads(lift, measured, wheel, known)
    return found


def doubts(height: FloatArray, seed: int = 0) -> list[Doubt]:
    return list(laser_doubts(roads(height, seed), GRID))


@pytest.mark.slow
@given(seed=st.integers(0, 1000))
@settings(max_examples=15, deadline=None)
def test_healthy_lasers_raise_no_doubt(seed: int) -> None:
    assert not list(laser_doubts(roads(seed=seed), GRID))


@pytest.mark.slow
@given(scale=st.floats(0.3, 3.0).filter(lambda k: abs(np.log(k)) > 0.1), seed=st.integers(0, 99))
@settings(max_examples=15, deadline=None)
def test_the_ratio_of_the_weights_is_the_scale(scale: float, seed: int) -> None:
    found = fit_laser(roads(scale * path(seed)[1], seed)["left"])
    assert found is not None
    assert found.gain == pytest.approx(scale, rel=0.02)
    (doubt,) = doubts(scale * path(seed)[1], seed)
    assert doubt.suspects == (LEFT,)
    if abs(scale - 1.0) > 0.32:
        assert doubt.fatal


def test_an_inverted_laser_is_fatal_and_named_so() -> None:
    (doubt,) = doubts(-path(0)[1])
    assert doubt.fatal
    assert "sign inverted" in doubt.line


@pytest.mark.parametrize("steps", [-4, 4, 10, 40])
def test_a_late_laser_is_found_at_its_lag(steps: int) -> None:
    late = np.roll(path(0)[1], steps)
    found = fit_laser(roads(late)["left"])
    assert found is not None
    assert found.late_s == pytest.approx(steps * STEP_S, abs=0.003)
    (doubt,) = doubts(late)
    assert not doubt.fatal
    assert ("later" if steps > 0 else "earlier") in doubt.line


def test_exchanged_lasers_are_fatal_for_both() -> None:
    healthy = roads()
    left, right = healthy["left"], healthy["right"]
    crossed = {
        "left": TwoRoads(left.lift, right.height, left.wheel, left.known),
        "right": TwoRoads(right.lift, left.height, right.wheel, right.known),
    }
    (doubt,) = laser_doubts(crossed, GRID)
    assert doubt.fatal
    assert doubt.suspects == (LEFT, ChannelId("height", "right"))
    assert "exchanged" in doubt.line


def test_a_stretch_is_flagged_where_it_is() -> None:
    height = np.array(path(0)[1])
    begin, end = 2000, 2500
    height[begin:end] = 0.0
    (doubt,) = doubts(height)
    ((first, last),) = doubt.spans
    assert doubt.replaced
    assert begin * STEP_S - 1.1 <= first <= begin * STEP_S
    assert end * STEP_S <= last <= end * STEP_S + 1.1


@pytest.mark.slow
def test_noise_is_fatal() -> None:
    (doubt,) = doubts(0.01 * band(np.random.default_rng(9).standard_normal(COUNT), *BAND_HZ))
    assert doubt.fatal


def test_a_wheel_ahead_meets_the_road_earlier() -> None:
    # At 20 m/s a wheel 4 m ahead of the laser rolls over the same road 0.2 s before it.
    source = np.random.default_rng(3)
    acceleration = source.standard_normal(COUNT)
    distance = 20.0 * GRID.times
    moved = wheel_road(acceleration, distance, 4.0, GRID)
    plain = band(acceleration, *BAND_HZ, integrals=2)
    assert moved[500:-500] == pytest.approx(plain[460:-540], abs=1e-9)
