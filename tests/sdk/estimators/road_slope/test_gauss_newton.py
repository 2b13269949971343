"""The answer of a stretch: least squares, near the truth, and as sure as its covariance says."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.short_runs import (
    MODEL,
    RUNS,
    Case,
    Run,
    draw,
    drawn_fit,
    held,
    over_hump,
)

from floatref.estimators.road_slope.gauss_newton import (
    FEWEST,
    PASSES,
    RANGES,
    SETTLED_RAD,
    Fit,
    _go,
    fit,
)
from floatref.estimators.road_slope.rows import Rows, Stretch, Weights
from floatref.values.arrays import FloatArray

few, dense = (settings(deadline=None, max_examples=n) for n in (4, 2))
SEEDS = st.integers(0, 2**32 - 1)
SETTLED = [
    Run(k, 12 + k % 5, k % 2 == 0, 0.1 * (k % 3), 0.1 * (k % 4), k > 4, 1.0) for k in (4, 9, 11, 13)
]
"""So short that some of their neighbours do not settle: a constant is at an end of its range."""
ONE_BEND = replace(MODEL, bends=6e-6, first_bend=1.0, most_bend=1.0)
"""The intensity is that with which roads are drawn, and is not sought."""


def moved(stretch: Stretch, **changed: Any) -> Stretch:
    return Stretch(replace(stretch.readings, **changed), stretch.places, stretch.model)


@cache
def found_of(run: Run) -> tuple[Case, Fit]:
    """Return a run whose intensity of bends is known, and its fit."""
    case = draw(run, ONE_BEND)
    return case, fit(case.ours)


def deviations(found: Fit) -> FloatArray:
    covariance = found.covariance(np.eye(found.stretch.layout.size))
    return np.asarray(np.sqrt(np.diag(covariance)))


@pytest.mark.parametrize("run", SETTLED)
def test_a_run_drawn_from_the_equations_is_recovered_within_its_sigma(run: Run) -> None:
    case, found = found_of(run)
    assert found.changed_rad < SETTLED_RAD
    off = (found.unknowns - case.truth) / deviations(found)
    assert np.abs(off).max() < 6
    assert np.abs(off[case.ours.layout.pitch]).max() < 4
    assert 0.3 < np.sqrt(np.mean(np.square(off))) < 2.2


@pytest.mark.slow
def test_the_sigma_is_neither_too_small_nor_too_large() -> None:
    """Over many runs; a fit of so few nodes may be far off by a constant, so of the median."""
    names = ("gain", "lean", "centre", "log_front", "log_rear", "log_gyration")
    squares = []
    for seed in range(100, 140):
        case = draw(Run(seed, 16, bend=1.0), ONE_BEND)
        found, lay = fit(case.ours), case.ours.layout
        if found.changed_rad < SETTLED_RAD:
            off = np.square((found.unknowns - case.truth) / deviations(found))
            constants = off[[lay.place(name) for name in names]]
            squares.append([off[lay.pitch].mean(), off[lay.elevation].mean(), constants.mean()])
    assert len(squares) > 25
    typical = np.median(squares, axis=0)
    # That of χ² with one degree of freedom is 0.45, with many 1.
    assert np.all((typical > 0.3) & (typical < 1.6))


@pytest.mark.parametrize("run", SETTLED[1:3])
def test_where_it_has_settled_the_next_step_is_as_small(run: Run) -> None:
    """By least squares of the derivatives, with the springs as sure as they are."""
    _, found = found_of(run)
    rows = found.rows()
    J = rows.derivative.toarray()
    size = np.linalg.norm(J, axis=0)
    step = np.linalg.lstsq(J / size, rows.misfit, rcond=1e-13)[0] / size
    assert np.abs(step[found.stretch.layout.pitch]).max() < 2 * SETTLED_RAD


@pytest.mark.slow
@few
@given(run=RUNS)
def test_constants_stay_in_their_ranges(run: Run) -> None:
    wild = replace(MODEL, gain=0.03, hz=4.0, damping=0.02, centre=1.5, gyration=0.3)
    found = fit(draw(run._replace(nodes=12), wild).ours)
    for name, (low, high) in RANGES.items():
        assert low <= found.of(name) <= high
    assert FEWEST <= found.passes <= PASSES
    assert found.bends.min() >= MODEL.bends
    assert found.bends.max() <= MODEL.most_bend * MODEL.bends


@pytest.mark.parametrize("seed", [5, 11])
def test_springs_are_loose_at_first_and_as_sure_as_they_are_in_the_end(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    """By 30, and half as much in each pass."""
    loose, rows = [], Stretch.rows

    def record(self: Stretch, y: FloatArray, held: Weights) -> Rows:
        loose.append(held.loose)
        return rows(self, y, held)

    monkeypatch.setattr(Stretch, "rows", record)
    found = fit(draw(Run(seed, 12, bend=1.0)).ours)
    by_pass = list(dict.fromkeys(loose))
    assert by_pass == [30.0, 15.0, 7.5, 3.75, 1.875, 1.0]
    assert loose.index(1.0) < len(loose) - 1
    assert found.passes > by_pass.index(1.0)


@few
@given(run=RUNS, seed=SEEDS, power=st.floats(-1.0, 4.0))
def test_a_step_is_halved_until_the_sum_of_squares_allows_it(
    run: Run, seed: int, power: float
) -> None:
    """Four times at most; a thousandth and 1 more are allowed."""
    case, rng = draw(run), np.random.default_rng(seed)
    y, g = case.truth, held(case)
    way = 10.0**power * 1e-3 * rng.normal(size=y.size)
    before = case.ours.misfit(y, g)
    after = _go(case.ours, y, way, before, g)
    free = np.setdiff1d(np.arange(y.size), [case.ours.layout.place(name) for name in RANGES])
    share = float(np.median((after - y)[free] / way[free]))
    assert np.isclose(share, [1, 1 / 2, 1 / 4, 1 / 8, 1 / 16]).any()
    np.testing.assert_allclose((after - y)[free], share * way[free], rtol=1e-6, atol=1e-12)
    enough = 1.001 * before + 1.0
    assert case.ours.misfit(after, g) <= enough or np.isclose(share, 1 / 16)
    if share < 0.9:
        twice = y + 2 * share * way
        for name, ends in RANGES.items():
            place = case.ours.layout.place(name)
            twice[place] = np.clip(twice[place], *ends)
        assert case.ours.misfit(twice, g) > enough


@pytest.mark.parametrize("by_m", [-256.0, 512.0])
def test_where_distance_counts_from_changes_nothing(by_m: float) -> None:
    """Points are laid from the first place that is needed."""
    case, found = found_of(SETTLED[2])
    shifted = fit(moved(case.ours, place=case.ours.readings.place + by_m))
    assert shifted.stretch.layout == found.stretch.layout
    off = (shifted.unknowns - found.unknowns) / deviations(found)
    assert np.abs(off).max() < 1e-3


@pytest.mark.parametrize("by_m", [-0.02, 0.01])
def test_a_sensor_mounted_higher_is_a_body_higher_at_rest(by_m: float) -> None:
    """The pitch stays, but for what the first knowledge of the height at rest has of it."""
    case = draw(SETTLED[2], ONE_BEND)
    wide = replace(ONE_BEND, offset_m=1.0)
    ours = Stretch(case.ours.readings, case.ours.places, wide)
    found, higher = fit(ours), fit(moved(ours, height=ours.readings.height + by_m))
    sigma, lay = deviations(found), ours.layout
    rise = (higher.unknowns - found.unknowns) / sigma
    assert np.abs(rise[lay.pitch]).max() < 0.05
    off = (higher.unknowns - found.unknowns - by_m)[lay.in_time("offset")]
    assert np.abs(off / sigma[lay.in_time("offset")]).max() < 0.05


@dense
@given(run=RUNS)
def test_the_covariance_is_the_inverse_of_the_normal_matrix(run: Run) -> None:
    """By the singular values of the derivatives, over their sizes."""
    found = drawn_fit(run._replace(nodes=12))
    J = found.rows().derivative.toarray()
    size = np.linalg.norm(J, axis=0)
    root = np.linalg.pinv(J / size, rcond=1e-14) / size[:, np.newaxis]
    expected = root @ root.T
    sigma = np.sqrt(np.diag(expected))
    got = found.covariance(np.diag(1 / sigma))
    np.testing.assert_allclose(got, expected / np.outer(sigma, sigma), atol=2e-3)


@dense
@given(
    run=RUNS,
    factor=st.floats(1.5, 4.0),
    name=st.sampled_from(["reading_m", "swing", "bounce", "acceleration", "gain_sigma", "heave_m"]),
)
def test_what_is_less_sure_leaves_all_less_sure(run: Run, factor: float, name: str) -> None:
    found = drawn_fit(run)
    model = replace(MODEL, **{name: factor * getattr(MODEL, name)})
    worse = Stretch(found.stretch.readings, found.stretch.places, model)
    before, after = deviations(found), deviations(found._replace(stretch=worse))
    assert np.all(after > before * (1 - 1e-3))
    assert np.any(after > before * (1 + 1e-6))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1, 5))
def test_the_pitch_of_a_stop_on_a_hump_is_found_with_the_usual_constants(seed: int) -> None:
    """To a fifth of what it does, but for a constant, which is the lean's."""
    case = over_hump(seed)
    found = fit(case.ours)
    pitch = case.ours.layout.pitch
    off = (found.unknowns - case.truth)[pitch]
    assert np.abs(off / deviations(found)[pitch]).max() < 6
    assert np.std(off) < 0.2 * np.std(case.truth[pitch])
