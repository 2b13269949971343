"""Bounds of the mean NIS: those of the chi-square distribution, and drawn noise keeps them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.consistency import bound_mean_nis, record_innovations
from floatref.values.innovations import Innovations
from floatref_reference.beyond.innovations import chi_square_below, mean_nis

RUNS = 4000


@settings(deadline=None, max_examples=30)
@given(count=st.integers(1, 20_000), share=st.floats(0.5, 0.999))
def test_bounds_leave_equal_tails_of_the_distribution(count: int, share: float) -> None:
    low, high = bound_mean_nis(count, share)
    tail = (1.0 - share) / 2.0
    assert chi_square_below(low * count, count) == pytest.approx(tail, rel=1e-5)
    assert 1.0 - chi_square_below(high * count, count) == pytest.approx(tail, rel=1e-5)


@settings(deadline=None, max_examples=8)
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 200))
def test_the_mean_nis_of_drawn_noise_lies_within_as_often_as_stated(seed: int, count: int) -> None:
    """95 %, within five deviations of so many runs."""
    z = np.random.default_rng(seed).standard_normal((RUNS, count))
    low, high = bound_mean_nis(count)
    means = np.mean(z * z, axis=1)
    share = np.mean((means >= low) & (means <= high))
    assert share == pytest.approx(0.95, abs=5.0 * np.sqrt(0.95 * 0.05 / RUNS))


def test_the_record_holds_what_was_summed_up() -> None:
    z = np.random.default_rng(0).standard_normal(500)
    found = Innovations(left_out=3)
    found.add(np.arange(500.0), z)
    record = record_innovations({"left": {"height": found}})["left"]["height"]
    assert record["count"] == 500
    assert record["mean_nis"] == pytest.approx(mean_nis(z))
    assert (record["lower_95_percent"], record["upper_95_percent"]) == bound_mean_nis(500)
    assert record["within_2_sigma_percent"] == 100.0 * np.mean(np.abs(z) <= 2.0)
    assert record["mean_sigmas"] == pytest.approx(z.mean())
    assert record["left_out"] == 3


def test_a_kind_that_was_always_left_out_has_no_figures() -> None:
    record = record_innovations({"left": {"height": Innovations(left_out=7)}})["left"]["height"]
    assert (record.pop("count"), record.pop("left_out")) == (0, 7)
    assert set(record.values()) == {None}


@pytest.mark.parametrize(("count", "share"), [(0, 0.95), (3, 0.0), (3, 1.0), (3, float("nan"))])
def test_bounds_of_nothing_are_refused(count: int, share: float) -> None:
    with pytest.raises(InputError, match=r"^(count|share) is "):
        bound_mean_nis(count, share)
