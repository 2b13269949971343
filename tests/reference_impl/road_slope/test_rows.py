"""Misfits are 0 for motions that are known exactly, and have the 1-σ that the page says."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope import rows
from floatref_reference.road_slope.symbols import Constants, Places, Readings, Stretch
from floatref_reference.road_slope.unknowns import Unknowns, as_vector, by_name, start
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval=0.1, spacing=1.0)
G, K = C.g, 30
T = 0.1 * np.arange(K)
EXACT = pytest.approx(0, abs=1e-7)
CONSTANTS = st.fixed_dictionaries(
    {
        "gain": st.floats(0.0005, 0.02),
        "lean": st.floats(-0.03, 0.03),
        "centre": st.floats(-0.1, 1.1),
        "offset": st.floats(-1, 1),
        "log_hz": st.floats(-0.3, 1),
        "log_damping": st.floats(-3, -0.3),
    }
)


def unread(x: np.ndarray, along: Any, at: Places) -> Stretch:
    """Return a stretch at the places x, with nothing read."""
    zero = np.zeros(K)
    pause, speed = np.full(K, 0.1), np.gradient(x, 0.1)
    return Stretch(Readings(zero, zero, x, speed, zero + along, zero, pause), at, C)


def moved(stretch: Stretch, road: Any, theta: Any, constants: dict[str, Any]) -> Unknowns:
    """Return the body at a pitch over a road, held by its springs, with a bias of 0.02 m/s²."""
    points, at = road_points(stretch), stretch.places
    x = points.first + C.spacing * np.arange(points.number)
    z, place = road(x), stretch.readings.place
    front, rear, L = road(place + at.front), road(place + at.rear), at.front - at.rear
    beta = (front - rear) / L
    line = rear + beta * (-at.lever - at.rear)
    ahead = -at.lever - (at.front - constants["centre"] * L)
    r = line + ahead * (theta - beta) + constants["offset"]
    slope = np.append(np.diff(z) / C.spacing, (z[-1] - z[-2]) / C.spacing)
    return Unknowns(z, slope, r, theta, np.full(K, 0.02), **constants)


def swung(beta: Any, rate: Any, along: Any, jerk: float, constants: dict[str, Any]) -> Any:
    """Return θ over a slope that changes evenly: it rolls with β, and follows the rest late."""
    late = 2 * np.exp(constants["log_damping"]) / (2 * np.pi * np.exp(constants["log_hz"]))
    force, force_rate = along + G * beta, jerk + G * rate
    return beta + constants["gain"] * (force - late * force_rate)


@settings(deadline=None, max_examples=25)
@given(constants=CONSTANTS, slope=st.floats(-0.1, 0.1), a=st.floats(-3, 3), jerk=st.floats(-1, 1))
def test_a_body_that_brakes_ever_harder_on_a_grade_swings_exactly(
    constants: dict[str, Any], slope: float, a: float, jerk: float
) -> None:
    stretch = unread(2 * T, a + jerk * T, Places(-0.9, -3.6, 1.2))
    theta = swung(slope, 0.0, a + jerk * T, jerk, constants)
    x = moved(stretch, lambda x: 0.3 + slope * x, theta, constants)
    assert rows.swing_rows(x, stretch) == [EXACT] * (K - 2)
    assert rows.even_rows(x, stretch) == [EXACT] * K


@settings(deadline=None, max_examples=25)
@given(constants=CONSTANTS, first=st.floats(-0.1, 0.1), bend=st.floats(-0.1, 0.1))
def test_a_body_over_a_kink_between_its_axles_swings_exactly(
    constants: dict[str, Any], first: float, bend: float
) -> None:
    """At 0.9 m/s for 2.6 m: the front axle starts on the kink, which is a point of the road."""
    at = Places(-0.5, -3.5, 0.8)
    x = 0.9 * T
    stretch = unread(x, 0.0, at)
    kink = at.front
    rate = bend * 0.9 / 3.0
    theta = swung(first + rate * T, rate, 0.0, 0.0, constants)
    body = moved(stretch, lambda x: first * x + bend * np.maximum(x - kink, 0), theta, constants)
    assert (kink - road_points(stretch).first) % 1 == 0
    assert rows.swing_rows(body, stretch) == [EXACT] * (K - 2)
    assert rows.even_rows(body, stretch) == [EXACT] * K


@settings(deadline=None, max_examples=25)
@given(constants=CONSTANTS, slope=st.floats(-0.1, 0.1), a=st.floats(-1.5, 3))
def test_braking_evenly_on_a_grade_has_no_misfit_but_to_what_was_known_before(
    constants: dict[str, Any], slope: float, a: float
) -> None:
    """By its own force, (z'' + g) cos P - a sin P to second order, and its own height."""
    at = Places(-0.9, -3.6, 1.2)
    place = 5 * T + a / 2 * T**2
    stretch = unread(place, a, at)
    theta = np.full(K, swung(slope, 0.0, a, 0.0, constants))
    x = moved(stretch, lambda x: 0.3 + slope * x, theta, constants)
    P = theta + constants["lean"]
    force = slope * a - a * P - G * P**2 / 2 + 0.02
    height = x.height + at.lever * theta - (0.3 + slope * place)
    read = stretch.readings._replace(force=force, height=height)
    stretch = stretch._replace(readings=read)
    N = road_points(stretch).number
    misfits = rows.misfits(as_vector(x), stretch, np.full(N - 1, C.bend))
    other = 2 + N + 7
    assert np.sum(np.abs(misfits) > 1e-6) <= other
    assert misfits[: 4 * K - 4] == pytest.approx(np.zeros(4 * K - 4), abs=1e-7)
    assert rows.bias_rows(x, stretch)[1:] == [EXACT] * (K - 1)
    assert rows.bias_rows(x, stretch)[0] == pytest.approx(0.02 / 0.03)


def test_every_row_has_its_deviation(stopping: Callable[..., Stretch]) -> None:
    """Raise what each kind of row holds by one 1-σ; V is 4.8 m/s at node 1."""
    stretch = stopping(C)
    x, V = by_name(start(stretch), road_points(stretch).number, 40), 4.8
    at_0, at_1 = np.eye(40)[:2]
    points = road_points(stretch)
    laser = np.maximum(0, 1 - np.abs(stretch.readings.place - (points.first + 5)))
    lifted = x._replace(elevation=np.eye(points.number)[5])
    height = -laser / np.sqrt(2e-4**2 + 4e-6 / 3 * np.minimum(stretch.readings.speed * 0.1, 1))
    assert rows.height_rows(lifted, stretch) == pytest.approx(-height)
    force = rows.acceleration_rows(x._replace(bias=at_1), stretch)
    assert force[:3] == pytest.approx(np.array([4, 1, 0]) / 6 / (1.5e-4 / np.sqrt(0.1)))
    swing = rows.swing_rows(x._replace(pitch=at_0), stretch)[0] - rows.swing_rows(x, stretch)[0]
    decay = np.exp(-2 * 0.3 * 2 * np.pi * 1.6 * 0.1)
    assert swing == pytest.approx(decay / ((5e-4 + 1e-3 * V) * 0.1**1.5))
    even = rows.even_rows(x._replace(height=at_1), stretch)[1]
    assert even == pytest.approx(1 / ((2e-4 + 3e-4 * V) * np.sqrt(3)))
    bias = rows.bias_rows(x._replace(bias=at_1), stretch)
    assert bias[:3] == pytest.approx(np.array([0, 1, -1]) / (1e-4 * np.sqrt(0.1)))


def test_the_road_and_the_constants_have_their_deviations() -> None:
    c = Constants(spacing=0.25)
    g = np.array([1e-6, 2e-6, 4e-6])
    vector = np.zeros(8 + 3 + 6)
    flat = by_name(vector, 4, 1)._replace(log_hz=np.log(1.6), log_damping=np.log(0.3))
    bent = rows.road_rows(flat._replace(slope=np.array([0, 0, 1.0, 0])), c, g)
    assert bent[:4] == pytest.approx(np.array([0, 0, 1, 0]) / (c.slope * np.sqrt(240)))
    assert bent[5::2] == pytest.approx([0, 1 / np.sqrt(5e-7), -1 / 1e-3])
    assert bent[4::2] == pytest.approx([0, 0, -0.25 / 1e-3])
    lifted = rows.road_rows(flat._replace(elevation=np.array([0.0, 1, 1, 1])), c, g)
    assert lifted[4::2] == pytest.approx([1 / 1e-3, 0, 0])
    moved = flat._replace(
        elevation=np.ones(4), gain=0.013, lean=0.04, centre=0.1, offset=3.0, log_hz=np.log(3.2)
    )
    expected = [1, 2, 2, -2, 3, np.log(2) / 0.3, 0]
    assert rows.prior_rows(moved, c) == pytest.approx(expected)


def test_a_height_that_is_missing_has_no_row(stopping: Callable[..., Stretch]) -> None:
    stretch = stopping(C)
    stretch.readings.height[[3, 9]] = np.nan
    x = by_name(start(stretch), road_points(stretch).number, 40)
    assert len(rows.height_rows(x, stretch)) == 38


@given(k=st.integers(3, 20), share=st.floats(0, 1))
def test_a_sample_that_is_missing_loosens_the_rows_that_it_is_in(
    stopping: Callable[..., Stretch], k: int, share: float
) -> None:
    stretch = stopping(C)
    missing = share * np.eye(40)[k]
    stretch = stretch._replace(readings=stretch.readings._replace(missing=missing))
    sigma = np.array([rows.acceleration_sigma(stretch, i) for i in range(1, 39)])
    loose = np.sqrt(((1 - share) * 1.5e-4**2 + share * 0.3**2) / 0.1)
    expected = np.full(38, 1.5e-4 / np.sqrt(0.1))
    expected[k - 2 : k + 1] = loose
    assert sigma == pytest.approx(expected)


def test_a_cut_leaves_out_rows_and_frees_the_bias(stopping: Callable[..., Stretch]) -> None:
    stretch = stopping(C, cut=30)
    x = by_name(start(stretch), road_points(stretch).number, 40)
    assert len(rows.acceleration_rows(x, stretch)) == len(rows.swing_rows(x, stretch)) == 36
    walked = rows.bias_rows(x._replace(bias=1.0 * (np.arange(40) >= 30)), stretch)
    assert walked[30] == pytest.approx(1 / (1e-4 * np.sqrt(30.1)))


def test_many_vectors_at_once_are_each_as_alone(drawn: Any, stopping: Any) -> None:
    stretch, truth = drawn(stopping(C), 1)
    one, g = as_vector(truth), np.full(len(truth.slope) - 1, C.bend)
    many = np.stack([one, 2 * one, one / 3], axis=1)
    together = rows.misfits(many, stretch, g)
    for i in range(3):
        assert together[:, i] == pytest.approx(rows.misfits(many[:, i], stretch, g), rel=1e-12)
