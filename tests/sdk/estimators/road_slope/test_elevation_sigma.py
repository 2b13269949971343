"""The 1-σ of the high-passed road: that of the weights of a high-pass and a covariance."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.plain_equations import road_places
from tests.sdk.estimators.road_slope.short_runs import (
    MODEL,
    RUNS,
    Run,
    as_if,
    braked,
    draw,
    drawn_fit,
    marks_of,
    replaced,
)

from floatref.estimators.road_slope import elevation_sigma as module
from floatref.estimators.road_slope.elevation_sigma import _delivered, elevation_sigma, turn
from floatref.estimators.road_slope.gauss_newton import Fit
from floatref.estimators.road_slope.rows import Stretch
from floatref.values.arrays import FloatArray

few, dense = (settings(deadline=None, max_examples=n) for n in (4, 2))


def low_pass(places: FloatArray, at: float, wavelength_m: float) -> FloatArray:
    """Return weights, of sum 1, of the response of the gain 1/(1 + (λ_c ν)⁶), cut at 1.5 λ_c."""
    a = 2 * np.pi / wavelength_m * np.abs(places - at)
    b = np.sqrt(3) / 2 * a
    kernel = np.exp(-a) + np.exp(-a / 2) * (np.cos(b) + np.sqrt(3) * np.sin(b))
    kernel[np.abs(places - at) > 1.5 * wavelength_m] = 0.0
    return np.asarray(kernel / kernel.sum())


def plainly(found: Fit, mark_m: float, wavelength_m: float) -> FloatArray:
    """Return the weights of all unknowns in the high-passed elevation at ``mark_m``.

    Beyond the stretch the road goes on in lines.
    """
    lay, d = found.stretch.layout, found.stretch.model.spacing_m
    beyond = round(2 * wavelength_m / d)
    known = np.clip(np.arange(-beyond, lay.points + beyond), 0, lay.points - 1)
    places = d * np.arange(-beyond, lay.points + beyond, dtype=np.float64)
    eye = np.eye(lay.size)
    road = eye[known] + (places - d * known)[:, np.newaxis] * eye[lay.points + known]
    at = mark_m - found.stretch.first_m
    return np.asarray((np.isclose(places, at) - low_pass(places, at, wavelength_m)) @ road)


def known_road(found: Fit) -> FloatArray:
    """Return the rows of second differences over 8 m, 2 m away from the brake, over 2 mm."""
    stretch, lay = found.stretch, found.stretch.layout
    m, x = round(8.0 / stretch.model.spacing_m), road_places(stretch)
    braking = stretch.readings.place[np.abs(stretch.readings.along) > 0.5]
    rows = []
    for j in range(m, lay.points - m):
        three = x[[j - m, j, j + m]]
        if not braking.size or three.max() < braking[0] - 2 or three.min() > braking[-1] + 2:
            rows.append(np.zeros(lay.size))
            rows[-1][[j - m, j, j + m]] = np.array([1.0, -2.0, 1.0]) / 2e-3
    return np.array(rows).reshape(-1, lay.size)


def assert_plain(
    found: Fit, shares: tuple[float, ...], wavelength_m: float, tolerance: float
) -> None:
    """Compare with dense matrices, with rows of the road that the smoother knows."""
    J = np.vstack([found.rows().derivative.toarray(), known_road(found)])
    size = np.linalg.norm(J, axis=0)
    covariance = np.linalg.inv((J / size).T @ (J / size)) / np.outer(size, size)
    lay = found.stretch.layout
    gain, grade = np.zeros((2, lay.size))
    gain[lay.place("gain")], grade[lay.slope] = 1.0, 1.0 / lay.points
    moved = [covariance @ e / (e @ covariance @ e) for e in (gain, grade)]
    doubt = np.hypot(module.GAIN_DOUBT, module.TURN_DOUBT * turn(found)) * found.of("gain")
    own = float(np.sqrt(grade @ covariance @ grade))
    doubts = doubt, min(module.TOGETHER * own, module.GRADE_DOUBT)
    marks = marks_of(found.stretch, *shares)
    sigma = elevation_sigma(found, marks, wavelength_m)
    for mark, each in zip(marks, sigma, strict=True):
        w = plainly(found, mark, wavelength_m)
        more = [(off * (w @ by)) ** 2 for off, by in zip(doubts, moved, strict=True)]
        expected = np.sqrt(w @ covariance @ w + sum(more))
        assert each == pytest.approx(expected, rel=tolerance)


@dense
@given(run=RUNS, share=st.floats(0.0, 1.0))
def test_it_is_that_of_the_weights_and_of_gain_and_grade_in_doubt(run: Run, share: float) -> None:
    """The doubts are so large that they matter."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "GAIN_DOUBT", 1.0)
        patch.setattr(module, "TURN_DOUBT", 50.0)
        patch.setattr(module, "GRADE_DOUBT", 0.5)
        assert_plain(drawn_fit(run._replace(nodes=12)), (share,), 12.0, 1e-2)


@pytest.mark.slow
def test_outside_of_the_brake_the_road_is_known_as_the_smoother_knows_it() -> None:
    """By second differences; normal matrices of so many nodes keep few digits."""
    found = as_if(braked(), braked().start())
    known = known_road(found).shape[0]
    assert 0 < known < found.stretch.layout.points - 16
    assert_plain(found, (0.2, 0.5, 0.8), 30.0, 2e-2)


@few
@given(run=RUNS, level=st.floats(-5, 5), rise=st.floats(-0.1, 0.1), share=st.floats(0, 1))
def test_level_and_grade_of_a_straight_road_do_not_pass(
    run: Run, level: float, rise: float, share: float
) -> None:
    stretch = draw(run).ours
    y = np.zeros(stretch.layout.size)
    y[stretch.layout.elevation] = level + rise * (road_places(stretch) - stretch.first_m)
    y[stretch.layout.slope] = rise
    weights = _delivered(stretch, marks_of(stretch, share), 12.0)
    np.testing.assert_allclose(weights @ y, 0.0, atol=1e-9)


@few
@given(part=st.floats(0.4, 3.0), phase=st.floats(0.0, 6.0))
def test_a_wave_passes_by_the_gain_of_the_high_pass(part: float, phase: float) -> None:
    """1 - 1/(1 + (ν λ_c)⁶); at the cut-off wavelength a half."""
    stretch, cut_off = replaced(braked(), 0.25), 10.0
    (mark,) = marks_of(stretch, 0.5)
    y = np.zeros(stretch.layout.size)
    wave = 2 * np.pi / (part * cut_off) * (road_places(stretch) - mark) + phase
    y[stretch.layout.elevation] = np.cos(wave)
    (found,) = _delivered(stretch, np.array([mark]), cut_off) @ y
    assert found == pytest.approx((1 - 1 / (1 + part**-6.0)) * np.cos(phase), abs=0.02)


@few
@given(run=RUNS, level_m=st.sampled_from([0.2, 1.0, 5.0]), share=st.floats(0.0, 1.0))
def test_how_well_the_level_is_known_changes_nothing(
    run: Run, level_m: float, share: float
) -> None:
    """The weights of the high-pass have the sum 0, in the stretch and on the lines beyond."""
    found = drawn_fit(run)
    looser = Stretch(found.stretch.readings, found.stretch.places, replace(MODEL, start_m=level_m))
    marks = marks_of(found.stretch, 0.0, share, 1.0)
    before = elevation_sigma(found, marks, 12.0)
    after = elevation_sigma(found._replace(stretch=looser), marks, 12.0)
    np.testing.assert_allclose(after, before, rtol=1e-2)


@few
@given(run=RUNS)
def test_a_short_wave_is_known_better_than_a_long_one(run: Run) -> None:
    found = drawn_fit(run)
    marks = marks_of(found.stretch, 0.5)
    short, long = (float(elevation_sigma(found, marks, each)[0]) for each in (3.0, 60.0))
    assert 0.0 < short < long


def test_what_the_smoother_knows_makes_the_road_surer_outside_of_the_brake(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stretch = braked(100, 50, 58)
    found = as_if(stretch, stretch.start(), 1e-3)
    marks = marks_of(stretch, 0.2, 0.35, 0.5, 0.55)
    known = elevation_sigma(found, marks, 30.0)
    monkeypatch.setattr(module, "BESIDE_M", 1e6)
    unknown = elevation_sigma(found, marks, 30.0)
    assert np.all(known <= unknown * (1 + 1e-9))
    ratio = known / unknown
    assert max(ratio[:2]) < 0.7 * min(ratio[2:])
