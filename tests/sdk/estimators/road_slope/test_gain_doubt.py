"""Gain and grade in doubt, the gain more on a road that turns: what they are of the 1-σ."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.plain_equations import road_places
from tests.sdk.estimators.road_slope.short_runs import (
    RUNS,
    Run,
    as_if,
    braked,
    drawn_fit,
    marks_of,
    replaced,
)

from floatref.estimators.road_slope import elevation_sigma as module
from floatref.estimators.road_slope.elevation_sigma import _delivered, elevation_sigma, turn
from floatref.estimators.road_slope.gauss_newton import Fit

few, dense = (settings(deadline=None, max_examples=n) for n in (3, 2))


def over_bend(bent: float, first: int) -> Fit:
    """Return a fit of a road that bends evenly, by ``bent`` in 1/m."""
    stretch = replaced(braked(first=first, last=first + 8), 0.1)
    y, x = stretch.start(), road_places(stretch)
    y[stretch.layout.elevation] = 0.5 * bent * np.square(x - x.mean())
    return as_if(stretch, y)


@few
@given(run=RUNS, doubt=st.floats(0.05, 0.5))
def test_it_grows_with_the_doubt_of_the_gain(run: Run, doubt: float) -> None:
    """Its square by that of the doubt."""
    found, squares = drawn_fit(run), []
    marks = marks_of(found.stretch, 0.3, 0.6)
    for each in (0.0, doubt, 2 * doubt):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(module, "GAIN_DOUBT", each)
            patch.setattr(module, "TURN_DOUBT", 0.0)
            squares.append(np.square(elevation_sigma(found, marks, 12.0)))
    rise, more = squares[1] - squares[0], squares[2] - squares[0]
    assert np.all(rise >= 0.0)
    np.testing.assert_allclose(more, 4 * rise, rtol=1e-6, atol=1e-15)


@dense
@given(run=RUNS)
def test_a_doubt_of_the_gain_is_worth_what_another_gain_does_to_the_road(run: Run) -> None:
    """By least squares of all rows with one more, of a gain that is known to be another.

    The road is too short for rows of what the smoother knows.
    """
    found = drawn_fit(run._replace(nodes=12))
    marks, gain = marks_of(found.stretch, 0.3, 0.7), found.stretch.layout.place("gain")
    squares = []
    for doubt in (0.0, 1.0):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(module, "GAIN_DOUBT", doubt)
            patch.setattr(module, "TURN_DOUBT", 0.0)
            squares.append(np.square(elevation_sigma(found, marks, 12.0)))
    J = found.rows().derivative.toarray()
    size = np.linalg.norm(J, axis=0)
    others = np.delete(np.arange(size.size), gain)
    wanted = -J[:, gain] * found.of("gain")
    moved = np.zeros(size.size)
    moved[others] = np.linalg.lstsq((J / size)[:, others], wanted, rcond=1e-14)[0] / size[others]
    expected = np.square(_delivered(found.stretch, marks, 12.0) @ moved)
    largest = squares[1].max()
    np.testing.assert_allclose(squares[1] - squares[0], expected, rtol=0.02, atol=1e-4 * largest)


@dense
@given(run=RUNS)
def test_a_doubt_of_the_grade_is_worth_what_another_grade_does_to_the_road(run: Run) -> None:
    """By least squares of all rows, with the mean slope held at another value."""
    found = drawn_fit(run._replace(nodes=12))
    lay, marks = found.stretch.layout, marks_of(found.stretch, 0.3, 0.7)
    squares = []
    for doubt in (0.0, 0.1):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(module, "GRADE_DOUBT", doubt)
            patch.setattr(module, "TOGETHER", 1e9)
            squares.append(np.square(elevation_sigma(found, marks, 12.0)))
    J = found.rows().derivative.toarray()
    size = np.linalg.norm(J, axis=0)
    mean = np.zeros((1, lay.size))
    mean[0, lay.slope] = 1e6 / lay.points
    held = np.concatenate((J / size, mean / size))
    wanted = np.append(np.zeros(J.shape[0]), 1e6 * 0.1)
    moved = np.linalg.lstsq(held, wanted, rcond=1e-14)[0] / size
    expected = np.square(_delivered(found.stretch, marks, 12.0) @ moved)
    largest = squares[1].max()
    np.testing.assert_allclose(squares[1] - squares[0], expected, rtol=0.02, atol=1e-4 * largest)


@few
@given(bent=st.floats(-0.02, 0.02), first=st.integers(5, 50))
def test_a_turn_is_what_the_slope_changes_by_in_a_wheelbase(bent: float, first: int) -> None:
    """On a road that bends evenly, wherever it brakes."""
    assert turn(over_bend(bent, first)) == pytest.approx(2.7 * abs(bent), rel=1e-2, abs=1e-9)


def test_without_a_brake_or_at_its_begin_there_is_no_turn() -> None:
    """What was under the vehicle before the first node is as at it."""
    stretch = braked(first=100)
    x = road_places(stretch)
    y = stretch.start()
    y[stretch.layout.elevation] = np.square(x - x.mean())
    assert turn(as_if(stretch, y)) == 0.0
    begin = over_bend(0.02, 0)
    seen = begin.stretch.readings
    expected = 0.02 * np.minimum(2.7, seen.place[:9] - seen.place[0])
    assert turn(begin) == pytest.approx(np.sqrt(np.mean(np.square(expected))), rel=1e-2)


@few
@given(run=RUNS, bent=st.floats(0.02, 0.2))
def test_a_gain_is_less_sure_on_a_road_that_turns(run: Run, bent: float) -> None:
    """As if the doubt were 2 for each rad in a wheelbase, and not at all on a straight road."""
    found, lay = drawn_fit(run), drawn_fit(run).stretch.layout
    x, y = road_places(found.stretch), found.unknowns.copy()
    y[lay.elevation] = 0.5 * bent * np.square(x - x.mean())
    marks, sigmas = marks_of(found.stretch, 0.4), []
    turned = found._replace(unknowns=y)
    for gain, by_turn in ((0.0, 2.0), (2.0 * turn(turned), 0.0), (0.0, 0.0)):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(module, "GAIN_DOUBT", gain)
            patch.setattr(module, "TURN_DOUBT", by_turn)
            sigmas.append(float(elevation_sigma(turned, marks, 12.0)[0]))
    assert sigmas[0] == pytest.approx(sigmas[1], rel=1e-9)
    assert sigmas[0] > sigmas[2]
