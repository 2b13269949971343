"""Misfits are 0 for motions that are known exactly, and have the 1-σ that the page says."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope import rows
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.held import Held, held_by
from floatref_reference.road_slope.springs import half_car
from floatref_reference.road_slope.symbols import Places, Readings, Stretch
from floatref_reference.road_slope.unknowns import Unknowns, as_vector, by_name, start
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval_s=0.1, spacing_m=1.0)
G, K = C.gravity, 20
T = 0.1 * np.arange(K)
AT = Places(-0.9, -3.6, 1.2)
Stopping = Callable[..., Stretch]
CONSTANTS = st.fixed_dictionaries(
    {
        "gain": st.floats(0.0005, 0.02),
        "lean": st.floats(-0.03, 0.03),
        "centre": st.floats(-0.1, 1.1),
        "log_front": st.floats(2, 5),
        "log_rear": st.floats(2, 5),
    }
)


def driving(a: float) -> Stretch:
    """Return a stretch at an even acceleration; nothing is read."""
    zero, place = np.zeros(K), 5 * T + a / 2 * T**2
    run = Readings(zero, zero, place, 5 + a * T, zero + a, zero, np.full(K, 0.1))
    return Stretch(run, AT, C)


def braking_evenly(stretch: Stretch, slope: float, a: float, fixed: dict[str, Any]) -> Unknowns:
    """Return a body that its springs hold on a grade, with a bias of 0.02 m/s²."""
    points, L = road_points(stretch), AT.front - AT.rear
    x = by_name(start(stretch), points.number, K)._replace(**fixed)
    car = half_car(x, AT)
    force = x.gain * L * (a + G * slope) / (1 / car.front + 1 / car.rear)
    front = (car.to_rear / L * slope * a - force) / car.front
    rear = (car.to_front / L * slope * a + force) / car.rear
    theta = slope - (front - rear) / L
    z = 0.3 + slope * (points.first + np.arange(points.number))
    r = 0.3 + slope * (stretch.readings.place + AT.front) - front - (AT.lever + AT.front) * theta
    slopes, pitch = np.full(points.number, slope), np.full(K, theta)
    return x._replace(elevation=z, slope=slopes, height=r, pitch=pitch, bias=np.full(K, 0.02))


@settings(deadline=None, max_examples=15)
@given(fixed=CONSTANTS, slope=st.floats(-0.1, 0.1), a=st.floats(-1.5, 3))
def test_braking_evenly_on_a_grade_has_no_misfit_but_to_what_was_known_before(
    fixed: dict[str, Any], slope: float, a: float
) -> None:
    """By its own force, (z'' + g) cos P - a sin P to second order, and its own height."""
    stretch = driving(a)
    x = braking_evenly(stretch, slope, a, fixed)
    P = x.pitch + x.lean
    force = slope * a - a * P - G * P**2 / 2 + 0.02
    # The spot is 0.5 m times the pitch ahead of where it is at rest.
    spot = 0.3 + slope * (stretch.readings.place + 0.5 * x.pitch)
    height = x.height + AT.lever * x.pitch - spot
    read = stretch.readings._replace(force=force, height=height)
    stretch = stretch._replace(readings=read)
    held = held_by(as_vector(x), stretch, np.full(len(x.slope) - 1, C.bends))
    kinds = rows.rows_by_kind(x, stretch, held)
    prior = [*kinds.pop("prior")]
    assert prior[0] == pytest.approx(x.elevation[0])
    assert kinds["bias"][0] == pytest.approx(0.02 / 0.03)
    kinds["bias"][0] = 0.0
    assert kinds["road"][: len(x.slope)] == pytest.approx(x.slope / (0.06 * np.sqrt(60)))
    kinds["road"][: len(x.slope)] = []
    for misfits in kinds.values():
        assert misfits == pytest.approx(np.zeros(len(misfits)), abs=1e-6)


def test_heights_have_their_deviation(stopping: Stopping) -> None:
    """Lift one point of the road, and what the node passes over of it is off."""
    stretch = stopping(C)
    points, run = road_points(stretch), stretch.readings
    x = by_name(start(stretch), points.number, 30)
    third = run.speed * 0.1 / 3
    near = [np.abs(run.place + i * third - (points.first + 5)) for i in (-1, 0, 1)]
    laser = np.mean(np.maximum(0, 1 - np.array(near)), axis=0)
    lifted = rows.height_rows(x._replace(elevation=np.eye(points.number)[5]), stretch)
    sigma = np.sqrt(1e-4**2 + 4e-6 / 3 * np.minimum(run.speed * 0.1, 1))
    assert lifted == pytest.approx(laser / sigma)


def test_a_pitch_moves_the_spot_along_the_road_that_is_there(stopping: Stopping) -> None:
    """Of two readings that differ by the slope of the road, one is of a level body."""
    stretch, pitch = stopping(C), np.full(30, 0.02)
    x = by_name(start(stretch), road_points(stretch).number, 30)._replace(pitch=pitch)
    sloping = x._replace(slope=x.slope + 0.05)
    sigma = np.sqrt(1e-4**2 + 4e-6 / 3 * np.minimum(stretch.readings.speed * 0.1, 1))
    moved = np.subtract(rows.height_rows(sloping, stretch), rows.height_rows(x, stretch))
    assert moved * sigma == pytest.approx(np.full(30, 0.5 * 0.02 * 0.05))


@settings(deadline=None, max_examples=25)
@given(force=st.floats(-5, 5))
def test_accelerations_have_their_deviation(stopping: Stopping, force: float) -> None:
    stretch = stopping(C)
    read = stretch.readings._replace(force=np.full(30, force))
    stretch = stretch._replace(readings=read)
    x = by_name(start(stretch), road_points(stretch).number, 30)
    biased = rows.acceleration_rows(x._replace(bias=np.eye(30)[1]), stretch)
    off = np.subtract(biased, rows.acceleration_rows(x, stretch))
    sigma = np.hypot(1.5e-4 / np.sqrt(0.1), 0.003 * force)
    assert off[:3] == pytest.approx(np.array([10, 1, 0]) / 12 / sigma, abs=1e-9)


def test_the_road_has_its_deviations() -> None:
    c = Constants(spacing_m=0.25)
    g = np.array([1e-6, 2e-6, 4e-6])
    flat = by_name(np.zeros(8 + 7 + 8), 4, 1)
    bent = rows.road_rows(flat._replace(slope=np.array([0, 0, 1.0, 0])), c, g)
    assert bent[:4] == pytest.approx(np.array([0, 0, 1, 0]) / (0.06 * np.sqrt(240)))
    assert bent[5::2] == pytest.approx([0, 1 / np.sqrt(5e-7), -1 / 1e-3])
    assert bent[4::2] == pytest.approx([0, 0, -0.25 / 1e-3])
    lifted = rows.road_rows(flat._replace(elevation=np.array([0.0, 1, 1, 1])), c, g)
    assert lifted[4::2] == pytest.approx([1 / 1e-3, 0, 0])


def test_a_height_that_is_missing_has_no_row(stopping: Stopping) -> None:
    stretch = stopping(C)
    stretch.readings.height[[3, 9]] = np.nan
    x = by_name(start(stretch), road_points(stretch).number, 30)
    assert len(rows.height_rows(x, stretch)) == 28


@settings(deadline=None, max_examples=25)
@given(k=st.integers(3, 20), share=st.floats(0, 1))
def test_a_sample_that_is_missing_loosens_the_rows_that_it_is_in(
    stopping: Stopping, k: int, share: float
) -> None:
    stretch = stopping(C)
    missing = share * np.eye(30)[k]
    stretch = stretch._replace(readings=stretch.readings._replace(missing=missing))
    sigma = np.array([rows.acceleration_sigma(stretch, i) for i in range(1, 29)])
    loose = np.sqrt(((1 - share) * 1.5e-4**2 + share * 0.3**2) / 0.1)
    expected = np.full(28, 1.5e-4 / np.sqrt(0.1))
    expected[k - 2 : k + 1] = loose
    assert sigma == pytest.approx(expected)


def test_a_pass_loosens_bounce_and_pitch_alone(drawn: Any, stopping: Stopping) -> None:
    stretch, x = drawn(stopping(C), 2)
    held = Held(np.full(len(x.slope) - 1, C.bends), np.zeros(30), np.zeros(29), loose=15.0)
    loose = rows.rows_by_kind(x, stretch, held)
    sure = rows.rows_by_kind(x, stretch, held._replace(loose=1.0))
    for kind in loose:
        factor = 15 if kind in ("bounce", "pitch") else 1
        assert np.multiply(loose[kind], factor) == pytest.approx(sure[kind], rel=1e-12)


def test_many_vectors_at_once_are_each_as_alone(drawn: Any, stopping: Stopping) -> None:
    stretch, truth = drawn(stopping(C), 1)
    one = as_vector(truth)
    held = held_by(one, stretch, np.full(len(truth.slope) - 1, C.bends))
    many = np.stack([one, 2 * one, one / 3], axis=1)
    together = rows.misfits(many, stretch, held)
    for i in range(3):
        alone = rows.misfits(many[:, i], stretch, held)
        assert together[:, i] == pytest.approx(alone, rel=1e-9, abs=1e-6)
