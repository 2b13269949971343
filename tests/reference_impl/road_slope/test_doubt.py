"""Where the road is known, how much the gain is in doubt, and what both do to the 1-σ."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope import doubt
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.gauss_newton import Answer, covariance
from floatref_reference.road_slope.held import held_by
from floatref_reference.road_slope.symbols import Places, Readings, Stretch
from floatref_reference.road_slope.unknowns import as_vector, by_name
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval_s=0.1, spacing_m=1.0)
AT = Places(-0.9, -3.6, 1.2)


def passing(brake: tuple[float, float], a: float = -2.0, length: int = 60) -> Stretch:
    """Return a stretch at 10 m/s with a node each metre, of which one part is a brake."""
    x = np.arange(1.0 + length)
    along, zero = np.where((x >= brake[0]) & (x <= brake[1]), a, 0.0), 0 * x
    return Stretch(Readings(zero, zero, x, zero + 10, along, zero, zero + 0.1), AT, C)


@settings(deadline=None, max_examples=25)
@given(first=st.integers(0, 60), last=st.integers(0, 60), a=st.sampled_from([-2.0, 0.6]))
def test_known_is_the_road_outside_of_a_brake(first: int, last: int, a: float) -> None:
    """Points are whole metres and four tenths, from 4.6 m before the first place on."""
    stretch = passing((first, last), a)
    points = road_points(stretch)
    x = points.first + np.arange(points.number)
    inside = (first - 2 < x) & (x < last + 2) & (first <= last)
    expected = [
        (j - 8, j, j + 8)
        for j in range(8, len(x) - 8)
        if not (inside[j - 8] or inside[j] or inside[j + 8])
    ]
    assert doubt.known_points(stretch) == expected


def test_slow_changes_of_speed_are_no_brake() -> None:
    stretch = passing((0, 60), 0.5)
    assert len(doubt.known_points(stretch)) == road_points(stretch).number - 16


@settings(deadline=None, max_examples=25)
@given(slope=st.floats(-0.1, 0.1), bend=st.floats(-0.01, 0.01))
def test_what_is_known_is_a_bend_over_8_m(slope: float, bend: float) -> None:
    stretch = passing((30, 40))
    x = np.arange(float(road_points(stretch).number))
    rows = doubt.known_rows(stretch, len(x) + 3)
    z = np.concatenate([0.3 + slope * x + bend * x**2, np.ones(3)])
    assert rows @ z == pytest.approx(np.full(len(rows), 128 * bend / 2e-3), abs=1e-9)
    assert len(rows) > 20


@settings(deadline=None, max_examples=25)
@given(turn=st.floats(-0.05, 0.05))
def test_a_road_that_turns_evenly_does_so_over_a_wheelbase(turn: float) -> None:
    """By 2.7 m; the brake has no node within a wheelbase of the first."""
    stretch = passing((10, 20))
    tau = doubt.turning(turn * stretch.readings.place, stretch)
    assert tau == pytest.approx(abs(turn) * 2.7)
    beta = turn * stretch.readings.place
    assert doubt.gain_doubt(beta, stretch) == pytest.approx(np.hypot(0.045, 2.7 * turn))


def test_before_the_first_node_the_road_is_as_there() -> None:
    stretch = passing((1, 1))
    assert doubt.turning(0.1 * stretch.readings.place, stretch) == pytest.approx(0.1)
    flat = stretch._replace(readings=stretch.readings._replace(along=np.zeros(61)))
    assert doubt.turning(np.arange(61.0), flat) == 0


def test_of_equal_places_the_first_counts() -> None:
    """Stand at 5 m, and brake 2.7 m ahead of it."""
    stretch = passing((3, 3), length=3)
    place = np.array([0, 5, 5, 7.7])
    stretch = stretch._replace(readings=stretch.readings._replace(place=place))
    tau = doubt.turning(np.array([0.0, 0.02, 0.5, 0.03]), stretch)
    assert tau == pytest.approx(0.01)


def test_a_weighted_sum_deviates_as_its_draws_do() -> None:
    """Of which two sums are off by more, and all that goes with them."""
    rng = np.random.default_rng(3)
    root, weights = rng.normal(size=(4, 4)), rng.normal(size=(3, 4))
    C = root @ root.T
    draws = root @ rng.normal(size=(4, 40_000))
    doubted, doubts = np.array([[0, 0, 1, 0], [0.5, 0.5, 0, 0]]), np.array([2.5, 1.5])
    for e, off in zip(doubted, doubts, strict=True):
        draws += np.outer(C @ e / (e @ C @ e), off * rng.normal(size=40_000))
    expected = np.std(weights @ draws, axis=1)
    found = doubt.deviation(weights, C, doubted, doubts)
    assert found == pytest.approx(expected, rel=0.03)


def test_it_is_that_of_the_answer(drawn: Any, stopping: Any) -> None:
    """Where all of the road is within a brake, of the rows of the fit; else it is more sure."""
    stretch, truth = drawn(stopping(C, K=8, speed=12.0), 1)
    vector = as_vector(truth)
    held = held_by(vector, stretch, np.full(len(truth.slope) - 1, C.bends))
    cov = covariance(vector, stretch, held)
    answer = Answer(truth, held, cov, 7, 0.0)
    where = by_name(np.arange(len(vector)), len(truth.slope), 8)
    weights = np.zeros((2, len(vector)))
    weights[0, where.elevation[[0, 5, 10]]] = 1, -2, 1
    weights[1, where.gain] = 1
    found = doubt.elevation_sigma(weights, answer, stretch)
    doubted = np.zeros((2, len(vector)))
    doubted[0, where.gain], doubted[1, where.slope] = 1, 1 / len(truth.slope)
    doubts = np.array([doubt.gain_doubt(held.beta, stretch) * truth.gain, 0.016])
    assert found == pytest.approx(doubt.deviation(weights, cov, doubted, doubts))
    assert found[1] > np.hypot(np.sqrt(cov[where.gain, where.gain]), doubts[0])


def test_what_is_known_makes_the_road_more_sure(drawn: Any, stopping: Any) -> None:
    stretch, truth = drawn(stopping(C, K=12, speed=20.0), 1)
    along = np.where(np.arange(12) < 11, 0.0, -2.0)
    stretch = stretch._replace(readings=stretch.readings._replace(along=along))
    vector = as_vector(truth)
    held = held_by(vector, stretch, np.full(len(truth.slope) - 1, 1e-3))
    wide, sure = covariance(vector, stretch, held), doubt.known_covariance(vector, stretch, held)
    rows = doubt.known_rows(stretch, len(vector))
    assert len(rows) > 0
    expected = np.linalg.inv(np.linalg.inv(rows @ wide @ rows.T) + np.eye(len(rows)))
    assert rows @ sure @ rows.T == pytest.approx(expected, rel=1e-4, abs=1e-6)
    assert np.linalg.eigvalsh(rows @ wide @ rows.T).max() > 2
