"""Areas beyond a limit, and which values rest on valid points only."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from floatref.errors import InputError
from floatref.measures import localized_roughness
from floatref.measures.roughness.areas import list_areas, share, valid_points, valid_throughout

masks = arrays(bool, st.integers(1, 40))


@given(mask=masks)
def test_areas_are_the_runs_of_what_is_above(mask: np.ndarray) -> None:
    covered = np.zeros(mask.size, dtype=bool)
    for area in list_areas(mask.astype(float), 0.5):
        assert not covered[max(area.first - 1, 0)]
        covered[area.first : area.end] = True
    assert (covered == mask).all()


def test_the_peak_is_the_first_of_the_highest_and_nan_is_above_nothing() -> None:
    (one, two) = list_areas(np.array([1.0, 3.0, 3.0, np.nan, 2.0, 0.0]), 0.5)
    assert (one.first, one.end, one.peak) == (0, 3, 1)
    assert (two.first, two.end, two.peak) == (4, 5, 4)


@given(valid=masks, before=st.integers(0, 50), after=st.integers(0, 50))
def test_valid_throughout_by_its_definition(valid: np.ndarray, before: int, after: int) -> None:
    expected = [valid[max(k - before, 0) : k + after + 1].all() for k in range(valid.size)]
    assert valid_throughout(valid, before, after).tolist() == expected


def test_a_point_without_elevation_is_never_valid() -> None:
    z = np.array([0.0, np.nan, 1.0])
    assert valid_points(None, z).tolist() == [True, False, True]
    assert valid_points([True, True, False], z).tolist() == [True, False, False]
    with pytest.raises(InputError, match="valid has 2 values for 3 points"):
        valid_points([True, True], z)


def test_the_share_of_nothing_is_not_a_number() -> None:
    assert np.isnan(share(np.zeros(0, dtype=bool)))
    assert share(np.array([True, False])) == 0.5


def test_localized_roughness_marks_what_rests_on_invalid_points() -> None:
    interval = 0.05
    x = interval * np.arange(2400)
    z, valid = np.zeros(x.size), np.ones(x.size, dtype=bool)
    for place in (40.0, 90.0):
        z[(x > place) & (x < place + 1.0)] = 0.01
    valid[(x > 95.0) & (x < 96.0)] = False
    clean, marked = localized_roughness(z, interval, 3.0, valid=valid)
    assert clean.valid_share == 1.0
    assert 0.0 < marked.valid_share < 1.0
