"""Sums of normalized innovations: the same however a run is split, in bounded memory."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.values.innovations import BIN, EDGES, NEAR, ROOM, Innovations

laws = settings(deadline=None, max_examples=25)


def drawn(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return np.arange(count) * 0.01, 3.0 * rng.standard_normal(count)


def kept(times_s: np.ndarray, z: np.ndarray, cuts: list[int]) -> Innovations:
    found = Innovations()
    for part in zip(np.split(times_s, cuts), np.split(z, cuts), strict=True):
        found.add(*part)
    return found


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(0, 5 * ROOM),
    cuts=st.lists(st.integers(0, 5 * ROOM), max_size=6),
)
@example(seed=0, count=3 * ROOM, cuts=[2 * ROOM + 1, 2 * ROOM + 4])
def test_no_split_changes_anything(seed: int, count: int, cuts: list[int]) -> None:
    times_s, z = drawn(seed, count)
    whole, parts = kept(times_s, z, []), kept(times_s, z, sorted(min(c, count) for c in cuts))
    for name, value in vars(whole).items():
        np.testing.assert_array_equal(value, getattr(parts, name), err_msg=name)


@laws
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 3 * ROOM))
def test_sums_are_those_of_all_and_the_sample_is_every_so_manyth(seed: int, count: int) -> None:
    times_s, z = drawn(seed, count)
    found = kept(times_s, z, [])
    assert found.count == count
    assert found.mean == pytest.approx(z.mean(), abs=1e-12)
    assert found.mean_nis == pytest.approx(np.mean(z**2))
    assert found.share_near == np.mean(np.abs(z) <= NEAR)
    assert found.bins.sum() == count
    assert found.sample.size <= ROOM < 2 * found.sample.size or found.every == 1
    np.testing.assert_array_equal(found.sample, z[:: found.every])
    np.testing.assert_array_equal(found.times_s, times_s[:: found.every])


def test_bins_hold_what_lies_between_their_edges_and_beyond() -> None:
    found = Innovations()
    found.add(np.zeros(5), np.array([-99.0, -BIN / 2, 0.0, BIN / 2, 99.0]))
    middle = (EDGES.size - 1) // 2
    assert [found.bins[0], found.bins[-1]] == [1, 1]
    assert [found.bins[middle - 1], found.bins[middle]] == [1, 2]


def test_nothing_has_no_mean() -> None:
    found = Innovations()
    assert np.isnan([found.mean, found.mean_nis, found.share_near]).all()
