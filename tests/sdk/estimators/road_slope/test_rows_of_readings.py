"""What each reading does to the rows, and what a body in steady motion would read."""

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.plain_equations import road_places
from tests.sdk.estimators.road_slope.short_runs import (
    MODEL,
    RUNS,
    STEP,
    Run,
    at_speed,
    draw,
    groups,
    held,
)

from floatref.estimators.road_slope.rows import Stretch

SEEDS, K = st.integers(0, 2**32 - 1), 30
few = settings(deadline=None, max_examples=4)
SURE = replace(MODEL, force_share=0.0)
"""All of a force is sure, so that it changes no 1-σ."""


def reread(stretch: Stretch, **changed: Any) -> Stretch:
    """Return the stretch with other readings."""
    return Stretch(replace(stretch.readings, **changed), stretch.places, stretch.model)


@few
@given(run=RUNS, k=st.integers(0, 11))
def test_a_height_and_a_force_change_the_rows_that_they_are_in(run: Run, k: int) -> None:
    """By as many 1-σ; the force of a node that lacks a side is in no row."""
    case = draw(run._replace(unread=0.0, missing=0.0), SURE)
    y, g, seen, model = case.truth, held(case), case.ours.readings, case.ours.model
    at_k, misfit = 1e-3 * (np.arange(run.nodes) == k), case.ours.rows(y, g).misfit
    higher = reread(case.ours, height=seen.height + at_k).rows(y, g).misfit - misfit
    between = model.road * min(seen.speed[k] * seen.interval_s, model.spacing_m) / 3
    expected = 1e-3 / np.sqrt(model.reading_m**2 + between)
    np.testing.assert_allclose(np.sort(higher)[[-1, 0, -2]], [expected, 0, 0], atol=1e-9)
    forced = reread(case.ours, force=seen.force + at_k).rows(y, g).misfit - misfit
    expected = 1e-3 / (model.acceleration / np.sqrt(seen.interval_s)) if k in seen.middles else 0.0
    np.testing.assert_allclose(np.sort(forced)[[-1, 0, -2]], [expected, 0, 0], atol=1e-7)


@few
@given(run=RUNS, lost=st.sets(st.integers(0, 11), min_size=1))
def test_a_height_that_is_not_read_has_no_row(run: Run, lost: set[int]) -> None:
    case = draw(run._replace(unread=0.0))
    y, g, height = case.truth, held(case), case.ours.readings.height.copy()
    before, begin = case.ours.rows(y, g).misfit, groups(case.ours)["height"].start
    height[list(lost)] = np.nan
    after = reread(case.ours, height=height).rows(y, g).misfit
    kept = np.setdiff1d(np.arange(before.size), [begin + k for k in lost])
    np.testing.assert_array_equal(after, before[kept])


@few
@given(run=RUNS, k=st.integers(1, 10), share=st.floats(0.1, 1.0))
def test_missing_samples_loosen_the_accelerations_that_have_them(
    run: Run, k: int, share: float
) -> None:
    case = draw(run._replace(missing=0.0), SURE)
    y, g, model = case.truth, held(case), case.ours.model
    before, begin = case.ours.rows(y, g).misfit, groups(case.ours)["acceleration"].start
    after = reread(case.ours, missing=share * (np.arange(run.nodes) == k)).rows(y, g).misfit
    rows = begin + np.flatnonzero(np.abs(case.ours.readings.middles - k) <= 1)
    variance = (1 - share) * model.acceleration**2 + share * model.missing_acceleration**2
    expected = before.copy()
    expected[rows] *= model.acceleration / np.sqrt(variance)
    np.testing.assert_allclose(after, expected, rtol=1e-12)


@few
@given(run=RUNS, share=st.floats(0.001, 0.1))
def test_a_part_of_the_force_is_not_sure(run: Run, share: float) -> None:
    case = draw(run._replace(missing=0.0), SURE)
    y, g, model, seen = case.truth, held(case), case.ours.model, case.ours.readings
    unsure = Stretch(seen, case.ours.places, replace(model, force_share=share))
    expected, where = case.ours.rows(y, g).misfit, groups(case.ours)["acceleration"]
    sigma = model.acceleration / np.sqrt(seen.interval_s)
    expected[where] *= sigma / np.hypot(sigma, share * seen.force[seen.middles])
    np.testing.assert_allclose(unsure.rows(y, g).misfit, expected, rtol=1e-12)


@few
@given(seed=SEEDS, level=st.floats(-5, 5), rise=st.floats(-0.3, 0.3))
def test_the_mean_of_a_linear_road_that_is_passed_over_is_its_value(
    seed: int, level: float, rise: float
) -> None:
    stretch = at_speed(np.random.default_rng(seed).uniform(0.0, 30.0, 12))
    road = level + rise * road_places(stretch)
    at = stretch.readings.place
    np.testing.assert_allclose(stretch.under_laser @ road, level + rise * at, atol=1e-9)
    for wheels, ahead_m in zip(stretch.car.wheels, (-0.8, -3.5), strict=True):
        np.testing.assert_allclose(wheels @ road, level + rise * (at + ahead_m), atol=1e-9)
    np.testing.assert_allclose(stretch.slope @ road, rise, atol=1e-9)


@few
@given(speed=st.floats(1.0, 30.0))
def test_the_mean_of_a_bent_road_is_that_of_three_places_a_third_of_the_travel_apart(
    speed: float,
) -> None:
    """Of a parabola two thirds of the square of that more, within what lines leave of it."""
    stretch = at_speed(np.full(12, speed))
    middle = stretch.readings.place.mean()
    found = stretch.under_laser @ np.square(road_places(stretch) - middle)
    more = found - np.square(stretch.readings.place - middle)
    expected = 2 / 3 * (speed * STEP / 3) ** 2
    line = stretch.model.spacing_m**2 / 4
    assert np.all((more >= expected - 1e-9) & (more <= expected + line + 1e-9))


@few
@given(pitch=st.floats(-0.1, 0.1), rise=st.floats(-0.1, 0.1), lever=st.floats(-1.5, 1.5))
def test_a_laser_reads_the_body_over_the_road_and_its_spot_moves_where_the_body_pitches(
    pitch: float, rise: float, lever: float
) -> None:
    """By what half a metre of height moves it forward on the slope of the road."""
    speed = np.full(12, 6.0)
    x = np.cumsum(speed) * STEP
    height = 0.3 + lever * pitch - rise * (x + 0.5 * pitch)
    stretch = at_speed(speed, 0.0, lever, height=height)
    y, lay = stretch.start(), stretch.layout
    y[lay.elevation], y[lay.slope] = rise * road_places(stretch), rise
    y[lay.height], y[lay.pitch] = 0.3, pitch
    where = groups(stretch)["height"]
    misfit = stretch.rows(y, stretch.weights(y, np.full(lay.points - 1, 1e-7))).misfit[where]
    np.testing.assert_allclose(misfit, 0.0, atol=1e-9)


@settings(deadline=None, max_examples=15)
@given(
    slope=st.floats(-0.1, 0.1),
    along=st.floats(-3.0, 3.0),
    gain=st.floats(0.001, 0.02),
    lean=st.floats(-0.03, 0.03),
    centre=st.floats(-0.1, 1.1),
    lever=st.floats(-1.5, 1.5),
)
def test_a_steady_brake_on_a_straight_slope_leaves_nothing(
    slope: float, along: float, gain: float, lean: float, centre: float, lever: float
) -> None:
    """Its springs push with what raises the body along the slope, and against the force along it.

    They are even, as the usual ones, so that their softness is 2 over that of one.
    """
    t, g = STEP * np.arange(float(K)), 9.80665
    x = 7.0 * t + along / 2 * t**2
    raised, base = slope * along, 2.7
    stiff = (2 * np.pi * 1.6) ** 2 * 0.9**2 / 2
    turned = gain * base * (along + g * slope) * stiff / 2
    pressed = ((1 - centre) * raised - turned) / stiff, (centre * raised + turned) / stiff
    pitch = slope - (pressed[0] - pressed[1]) / base
    ahead = lever - 0.8
    r = slope * (x - 0.8) - ahead * pitch - pressed[0] + 0.2
    leaning = pitch + lean
    force = raised - along * leaning - g / 2 * leaning**2 + 0.01
    height = r + lever * pitch - slope * (x + 0.5 * pitch)
    force = np.full(K, force)
    stretch = at_speed(7.0 + along * t, along, lever, height=height, force=force, place=x)
    y, lay = stretch.start(), stretch.layout
    y[lay.elevation], y[lay.slope] = slope * road_places(stretch), slope
    y[lay.height], y[lay.pitch], y[lay.bias] = r, pitch, 0.01
    y[lay.in_time("offset")] = 0.2
    y[[lay.place(name) for name in ("gain", "lean", "centre")]] = gain, lean, centre
    misfit = stretch.rows(y, stretch.weights(y, np.full(lay.points - 1, 1e-7))).misfit
    np.testing.assert_allclose(misfit[stretch.fixed_sigma.size :], 0.0, atol=1e-6)
    # Priors of bias, offset, level, gain, lean and centre.
    assert np.sum(np.abs(misfit) > 1e-6) <= 6 + lay.points
