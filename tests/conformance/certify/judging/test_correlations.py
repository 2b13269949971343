"""The few runs that spoil the pairs of all others are found, and never more than there are."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.certify.judging.correlations import outliers


def pairs_of(count, bad, good=0.99, poor=0.3):
    """Pairs of ``count`` runs; those with a run of ``bad`` agree less, the more the later."""
    pairs = np.full((count, count), np.nan)
    for i, j in combinations(range(count), 2):
        pairs[i, j] = good if not {i, j} & bad else poor - 0.01 * max({i, j} & bad)
    return pairs


@settings(deadline=None)
@given(st.data(), st.integers(3, 14))
def test_they_are_found_whoever_they_are(data, count):
    most = (count - 1) // 2
    bad = data.draw(st.sets(st.integers(0, count - 1), min_size=1, max_size=most))
    found, rest = outliers(pairs_of(count, bad), 0.985)
    assert set(found) == bad
    assert rest == pytest.approx(0.99)


def test_the_worst_comes_first():
    assert outliers(pairs_of(10, {2, 7}), 0.985)[0] == [7, 2]


@pytest.mark.parametrize("bad", [set(), set(range(5)), set(range(10))])
def test_nobody_is_blamed_where_all_agree_or_half_does_not(bad):
    found, rest = outliers(pairs_of(10, bad), 0.985)
    assert found == []
    assert np.isnan(rest)


def test_runs_without_pairs_are_not_counted():
    pairs = pairs_of(10, {1, 9})
    pairs[4, :] = pairs[:, 4] = np.nan
    assert set(outliers(pairs, 0.985)[0]) == {1, 9}
    assert outliers(np.full((3, 3), np.nan), 0.9) == ([], pytest.approx(np.nan, nan_ok=True))
    assert outliers(np.zeros((0, 0)), 0.9)[0] == []
