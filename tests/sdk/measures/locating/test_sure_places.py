"""A road that shares nothing with the reference is not placed, and one that shares it all is.

Laws: of sixty drawn pairs of unlike roads at most one is placed by chance; a run over the
reference is placed wherever its axis begins, within 100 m, with noise of slope up to half of the
road's own: over 161 m with as much noise as road a line of lag by chance fits as well.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures.locating.lags import Line, common_score
from floatref.measures.locating.placing import SURE, place
from floatref.measures.locating.slopes import STEP_M, Slope
from floatref.values.profile import Profile, ProfileTrack

INTERVAL_M = 0.05
PAIRS, BY_CHANCE = 60, 1


def unlike_pair(seed: int, points: int) -> list[Profile]:
    """Return two roads of white slope, one wheel path each, drawn apart."""
    rises = np.random.default_rng(seed).normal(0.0, 4e-4, (2, points))
    return [Profile(INTERVAL_M, (ProfileTrack.of("left", np.cumsum(rise)),)) for rise in rises]


def slope(values: np.ndarray, start_m: float = 0.0) -> Slope:
    return Slope(start_m, values, np.isfinite(values))


@pytest.mark.slow
@pytest.mark.parametrize("length_m", [160.0, 400.0, 1000.0])
def test_of_unlike_roads_next_to_none_is_placed(length_m: float) -> None:
    first = int(np.random.default_rng().integers(1 << 30))
    points = round(length_m / INTERVAL_M)
    placed = [
        seed for seed in range(first, first + PAIRS) if place(*unlike_pair(seed, points)).found
    ]
    assert len(placed) <= BY_CHANCE, placed


@pytest.mark.slow
@settings(max_examples=25)
@given(
    start_m=st.floats(-100.0, 100.0),
    length_m=st.sampled_from([161.0, 400.0]),
    percent=st.floats(-2.0, 2.0),
    noise=st.floats(0.0, 0.5),
    seed=st.integers(0, 99),
)
def test_a_run_over_the_reference_is_placed(roads, start_m, length_m, percent, noise, seed) -> None:
    road = roads(seed)
    run = road.run(-20.0, length_m + 60.0, scale=1.0 + percent / 100.0, noise=noise, seed=seed)
    placement = place(road.reference(length_m=length_m), replace(run, start_m=start_m - 20.0))
    assert placement.found, placement.notes
    lags = [start_m + (20.0 + x) * percent / 100.0 for x in (0.0, length_m)]
    if min(lags) > 1.1 or max(lags) < -1.1:
        assert placement.offset_m == pytest.approx(lags[0], abs=0.1)
    else:
        assert placement.offset_m == 0.0 or abs(placement.offset_m - lags[0]) < 0.1


def test_an_encoder_that_leaps_leaves_the_road_what_it_is(road) -> None:
    """Along one line half of the section lies 3 m off: the other half is the road's own."""
    run = road.run(-20.0, 460.0)
    leap = round(3.0 / run.interval_m)
    middle = round(220.0 / run.interval_m)
    tracks = [
        ProfileTrack.of(t.name, np.delete(t.elevation, np.s_[middle : middle + leap]))
        for t in run.tracks
    ]
    assert place(road.reference(length_m=400.0), replace(run, tracks=tuple(tracks))).found


@given(seed=st.integers(0, 999), away=st.integers(-40, 40), count=st.integers(50, 400))
def test_the_score_is_the_correlation_of_what_both_have(seed, away, count) -> None:
    """Against numpy's own, on whole steps; a run upside down has the opposite sign."""
    draw = np.random.default_rng(seed)
    p, q = draw.normal(size=400), draw.normal(size=count)
    line = Line(0.0, -away * STEP_M, 1.0)
    at = np.arange(400)
    inside = (at >= away) & (at < away + count)
    a, b = p[inside], q[at[inside] - away]
    expected = float(np.dot(a, b) / np.sqrt(np.dot(a, a) * np.dot(b, b)))
    share = min(a.size * STEP_M / 60.0, 1.0)
    found = common_score(slope(p), slope(q), line, 60.0)
    assert found == pytest.approx(np.sqrt(share) * expected, abs=1e-12)
    assert common_score(slope(p), slope(-q), line, 60.0) == pytest.approx(-found, abs=1e-15)


def test_a_few_metres_that_are_alike_are_no_place(road) -> None:
    """Twenty metres of 160 reach a correlation of one, and a score of 0.35."""
    values = np.random.default_rng(1).normal(size=640)
    there = Line(0.0, 0.0, 1.0)
    short = common_score(slope(values), slope(values[:80].copy()), there, 160.0)
    assert short == pytest.approx(np.sqrt(80 / 640), rel=1e-12)
    assert short < SURE
