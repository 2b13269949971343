"""Intensities of the slope: within bounds, of the bends of 10 m, and no lower for larger ones."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.estimators.road_slope.bends import first_bends, renew_bends
from floatref.estimators.road_slope.constants import SlopeModel
from floatref.values.arrays import FloatArray

MODELS = st.builds(
    SlopeModel,
    spacing_m=st.sampled_from([0.25, 0.7, 3.0]),
    bend_weight=st.floats(0.2, 5.0),
    most_bend=st.floats(10.0, 1e4),
    segment_m=st.sampled_from([3.5, 10.0]),
)
SEEDS = st.integers(0, 2**32 - 1)
POINTS, SIZES = st.integers(2, 90), st.floats(-6.0, 0.0)


def bent(seed: int, points: int, size: float) -> FloatArray:
    steps = 10.0**size * np.random.default_rng(seed).standard_cauchy(points)
    return np.asarray(np.cumsum(steps))


@given(model=MODELS, points=POINTS, size=SIZES)
def test_one_bend_is_that_of_a_mean_of_what_was_known_and_its_square(
    model: SlopeModel, points: int, size: float
) -> None:
    """In its segment; what was known has the weight ν, one bend that of 1."""
    bend = 10.0**size
    slope = bend * (np.arange(points) > 0)
    found = renew_bends(slope, model)
    mean = model.bend_weight * model.bends + bend**2 / model.spacing_m
    mean /= model.bend_weight + 1.0
    expected = min(max(mean, model.bends), model.most_bend * model.bends)
    np.testing.assert_allclose(found[0], expected, rtol=1e-9)
    same = np.arange(points - 1) < round(model.segment_m / model.spacing_m)
    assert np.all(found[same] == found[0])
    assert np.all(found[~same] == model.bends)


@given(model=MODELS, points=POINTS)
def test_at_first_they_are_the_same_for_the_whole_road_and_above_the_plain_roads(
    model: SlopeModel, points: int
) -> None:
    found = first_bends(points, model)
    assert found.shape == (points - 1,)
    assert np.all(found == found[0])
    assert abs(found[0] / model.bends / model.first_bend - 1) < 1e-12


@given(model=MODELS, seed=SEEDS, points=POINTS, size=SIZES)
def test_they_are_within_their_bounds(
    model: SlopeModel, seed: int, points: int, size: float
) -> None:
    found = renew_bends(bent(seed, points, size), model)
    assert found.shape == (points - 1,)
    assert found.min() >= model.bends
    assert found.max() <= model.most_bend * model.bends


@given(model=MODELS, seed=SEEDS, points=POINTS, size=SIZES, factor=st.floats(1.0, 50.0))
def test_a_road_that_bends_more_has_no_lower_ones(
    model: SlopeModel, seed: int, points: int, size: float, factor: float
) -> None:
    slope = bent(seed, points, size)
    less, more = (renew_bends(each, model) for each in (slope, factor * slope))
    assert np.all(more >= less * (1 - 1e-12))


@given(model=MODELS, points=POINTS, slope=st.floats(-0.2, 0.2))
def test_a_straight_road_has_the_least(model: SlopeModel, points: int, slope: float) -> None:
    assert np.all(renew_bends(np.full(points, slope), model) == model.bends)


@given(seed=SEEDS, at=st.integers(0, 88))
def test_a_bend_is_seen_within_its_own_segment_only(seed: int, at: int) -> None:
    """Of 10 m, forty points."""
    model, gentle = SlopeModel(), bent(seed, 90, -6.0)
    sharp = gentle + 0.05 * (np.arange(90) > at)
    changed = np.flatnonzero(renew_bends(sharp, model) > 2 * renew_bends(gentle, model))
    same = [j for j in range(89) if j // 40 == at // 40]
    assert set(changed.tolist()) <= set(same)
