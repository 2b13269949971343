"""In a notebook, too, what is not valid has a mark: figures, pictures and tables."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib import pyplot
from tests.sdk.cli.invalid_profiles import SPANS, Span, drawn

SEEDS = st.integers(0, 2**32 - 1)


@settings(deadline=None, max_examples=5)
@given(SEEDS, SPANS, SPANS)
def test_the_iri_is_that_of_the_right_road_with_its_share(
    seed: int, left: list[Span], right: list[Span]
) -> None:
    with drawn(seed, left, right) as made:
        good, bad = made.good.iri(), made.bad.iri()
        for track in made.bad.tracks:
            one, other = good[track.name], bad[track.name]
            np.testing.assert_equal(one.valid_m_per_km, other.valid_m_per_km)
            assert one.counted_share == other.counted_share
            assert (other.counted_share < 1.0) == (not track.valid.all())


@pytest.mark.parametrize("lost", [[], [(150, 60)]])
def test_the_picture_is_shaded_where_points_are_not_valid(lost: list[Span]) -> None:
    with drawn(1, lost, []) as made:
        figure = made.bad.plot()
    assert [bool(ax.collections) for ax in figure.axes] == [bool(lost)] * len(figure.axes)
    pyplot.close(figure)


@settings(deadline=None, max_examples=5)
@given(SEEDS, SPANS, SPANS)
def test_a_table_has_the_flags_of_the_points(
    seed: int, left: list[Span], right: list[Span]
) -> None:
    pytest.importorskip("pandas", reason="it comes with floatref[adapters]")
    with drawn(seed, left, right) as made:
        frame = made.bad.to_pandas()
        for track in made.bad.tracks:
            np.testing.assert_array_equal(frame[f"{track.name}_valid"], track.valid)
