"""A wheel path of two profiles that is filtered in pieces is that of the whole road.

Laws: however short the pieces are, agreement is that of both whole signals, to rounding; pieces
join without a gap, and begin at usable points.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import BANDS, agreement, on_common_grid
from floatref.measures.common_grid import CommonPath
from floatref.measures.locating import slopes
from floatref.measures.roughness import pieces_of_road
from floatref.measures.roughness.path_signals import path_agreement
from floatref.measures.roughness.pieces_of_road import cut_road
from floatref.values.profile import Profile, ProfileTrack

INTERVAL_M = 0.25
COUNT = 24_000
SPANS = st.lists(st.tuples(st.integers(1, COUNT - 2), st.integers(1, 3000)), max_size=4)


def road(seed: int, spans: list[tuple[int, int]], missing: bool) -> Profile:
    """Return 6 km over a hill of 20 m, which are not valid, or not measured, in ``spans``."""
    draw = np.random.default_rng(seed)
    z = np.cumsum(draw.normal(0.0, 1e-3, COUNT))
    z += 20.0 * np.sin(2.0 * np.pi * np.arange(COUNT) / COUNT)
    valid = np.ones(COUNT, dtype=np.bool_)
    for first, count in spans:
        valid[first : min(first + count, COUNT - 1)] = False
    wild = np.where(valid, z, np.nan if missing else z + draw.normal(0.0, 0.3, COUNT))
    return Profile(INTERVAL_M, (ProfileTrack.of("left", wild, valid),))


@pytest.mark.slow
@settings(max_examples=6, deadline=None)
@given(
    seed=st.integers(0, 99),
    spans=SPANS,
    band=st.sampled_from(BANDS),
    start_m=st.floats(-40.0, 40.0),
    missing=st.booleans(),
)
def test_pieces_of_a_road_agree_like_the_whole(seed, spans, band, start_m, missing) -> None:
    one = road(seed, spans, missing)
    rough = np.random.default_rng(seed + 100).normal(0.0, 4e-4, COUNT)
    other = ProfileTrack.of("left", one["left"].elevation + rough, one["left"].valid)
    other = replace(one, tracks=(other,), start_m=start_m)
    p, q = on_common_grid(one, other)
    expected = agreement(p["left"].elevation, q["left"].elevation, INTERVAL_M, band)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pieces_of_road, "PIECE", 1)
        found = path_agreement(one, other, "left", band)
    assert found.offset_m == expected.offset_m
    # Elevations of tens of metres round the slope of both ways by parts of 1e-13.
    assert found.correlation == pytest.approx(expected.correlation, abs=1e-10)
    assert found.amplitude_factor == pytest.approx(expected.amplitude_factor, rel=1e-10)


@pytest.mark.slow
@settings(max_examples=6, deadline=None)
@given(seed=st.integers(0, 99), spans=SPANS, start_m=st.floats(-40.0, 40.0))
def test_bridged_points_do_not_count_wherever_a_piece_ends(seed, spans, start_m) -> None:
    """What the invalid points hold changes nothing; a line over them is what is filtered."""
    one, start = road(seed, spans, missing=False), road(seed, spans, missing=True)
    kept = road(seed + 1, [], missing=False)
    pairs = [(each, replace(kept, start_m=start_m)) for each in (one, start)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pieces_of_road, "PIECE", 1)
        found = [path_agreement(*pair, "left", "medium", of_valid=True) for pair in pairs]
    assert found[0] == found[1]
    turned = path_agreement(*pairs[0], "left", "medium", 0.0, True, -1.0)
    upright = path_agreement(*pairs[0], "left", "medium", 0.0, True)
    assert turned.correlation == pytest.approx(-upright.correlation, abs=1e-12)


@given(seed=st.integers(0, 99), spans=SPANS, start_m=st.floats(-40.0, 40.0), valid=st.booleans())
@settings(max_examples=6, deadline=None)
def test_usable_points_are_those_of_the_common_grid(seed, spans, start_m, valid) -> None:
    one, other = road(seed, spans, True), replace(road(seed + 1, spans[:1], True), start_m=start_m)
    path = CommonPath.of(one, other, "left")
    p, q = (each["left"] for each in on_common_grid(one, other))
    expected = p.valid & q.valid if valid else np.isfinite(p.elevation) & np.isfinite(q.elevation)
    np.testing.assert_array_equal(path.usable(valid), expected)
    np.testing.assert_array_equal(path.expected(0, path.size).elevation, p.elevation)
    np.testing.assert_array_equal(path.found(0, path.size).elevation, q.elevation)
    middle = slice(path.size // 3, path.size // 2)
    part = path.found(middle.start, middle.stop)
    np.testing.assert_array_equal(part.elevation, q.elevation[middle])


@settings(max_examples=20, deadline=None)
@given(spans=SPANS, run_in_m=st.floats(1.0, 900.0))
def test_pieces_join_and_have_their_run_in(spans, run_in_m) -> None:
    usable = road(1, spans, missing=False)["left"].valid
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pieces_of_road, "PIECE", 500)
        pieces = list(cut_road(usable, run_in_m, INTERVAL_M))
    assert [p.begin for p in pieces] == [0, *(p.end for p in pieces[:-1])]
    assert pieces[-1].end == COUNT - 1
    run_in = round(run_in_m / INTERVAL_M)
    for piece in pieces:
        assert piece.first <= max(piece.begin - run_in, 0)
        assert piece.last - 1 >= min(piece.end + run_in, COUNT - 1)
        assert usable[[piece.first, piece.last - 1]].all()
        assert np.arange(piece.first, piece.last)[piece.inside()].tolist() == list(
            range(piece.begin, piece.end)
        )


@settings(max_examples=6, deadline=None)
@given(seed=st.integers(0, 99), spans=SPANS, start_m=st.floats(-9.0, 9.0))
def test_the_slope_of_a_road_in_pieces_is_that_of_the_whole(seed, spans, start_m) -> None:
    track = road(seed, spans, missing=True)["left"]
    whole = slopes.slope_of(track, start_m, INTERVAL_M)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pieces_of_road, "PIECE", 1)
        found = slopes.slope_of(track, start_m, INTERVAL_M)
    assert found.start_m == whole.start_m
    np.testing.assert_array_equal(found.measured, whole.measured)
    np.testing.assert_allclose(found.values, whole.values, rtol=0, atol=1e-12)
