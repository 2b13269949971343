"""Where the road under wheel and laser can be compared: in motion, on a road, without a tilt."""

import numpy as np
import pytest

from floatref.screening.second_sensor.fast_series import STEP_S
from floatref.screening.second_sensor.road_twice import (
    EDGE_S,
    HARDEST,
    LEAST_ROAD,
    SLOWEST_MPS,
    TwoRoads,
    is_moving,
)
from floatref.values.arrays import FloatArray

TIMES = STEP_S * np.arange(round(30.0 / STEP_S))
BEGIN_S = 15.0


def braked(deceleration: float, mps: float = 20.0, length_s: float = 2.0) -> FloatArray:
    """Return the distance in m of a vehicle that brakes from 15 s on, for 2 s."""
    braking = np.clip(TIMES - BEGIN_S, 0.0, length_s)
    return mps * TIMES - deceleration * braking * (TIMES - BEGIN_S - braking / 2)


@pytest.mark.parametrize("share", [0.0, 0.5, 0.9])
def test_a_vehicle_that_brakes_gently_is_compared_all_the_time(share: float) -> None:
    found, edge = is_moving(braked(share * HARDEST)), round(EDGE_S / STEP_S)
    assert found[edge:-edge].all()
    assert not found[:edge].any()
    assert not found[-edge:].any()


def test_around_a_hard_brake_the_tilt_is_no_road() -> None:
    found = is_moving(braked(1.3 * HARDEST))
    around = (TIMES > BEGIN_S - 1.0) & (TIMES < BEGIN_S + 3.0)
    assert not found[around].any()
    assert found[(TIMES > 2.0) & (TIMES < BEGIN_S - 3.0)].all()
    assert found[(TIMES > BEGIN_S + 5.0) & (TIMES < 28.0)].all()


def test_slow_travel_is_not_compared() -> None:
    assert not is_moving(0.9 * SLOWEST_MPS * TIMES).any()
    assert is_moving(1.1 * SLOWEST_MPS * TIMES)[TIMES.size // 2]


@pytest.mark.parametrize(
    ("lift", "height", "moves"),
    [(0.9, 0.9, True), (1.1, 1.1, False), (1.1, 0.9, True), (0.9, 9.0, True)],
)
def test_a_body_that_swings_more_than_a_road_makes_it_is_not_compared(
    lift: float, height: float, moves: bool
) -> None:
    wave = np.sin(TIMES)
    known = np.ones(TIMES.size, np.bool_)
    roads = TwoRoads(lift * wave, height * wave, LEAST_ROAD * wave, known)
    assert roads.moves_the_body is moves
    assert not TwoRoads(wave, wave, wave, ~known).moves_the_body
