"""A measurement that is missing teaches as much as one of infinite variance: nothing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_1_3_multi_rate import multi_rate_update

pytestmark = pytest.mark.cites("(6.16)")


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 999), there=st.lists(st.booleans(), min_size=4, max_size=4))
def test_missing_is_infinitely_uncertain(seed: int, there: list[bool]) -> None:
    rng = np.random.default_rng(seed)
    root, H, y = rng.normal(size=(7, 7)), rng.normal(size=(4, 7)), rng.normal(size=4)
    P, x, variances = root @ root.T, rng.normal(size=7), rng.uniform(0.5, 2, 4)
    missing = np.where(there, y, np.nan)
    x_found, P_found = multi_rate_update(x, P, missing, H @ x, H, np.diag(variances))
    vague = np.diag(np.where(there, variances, 1e15))
    x_vague, P_vague = multi_rate_update(x, P, y, H @ x, H, vague)
    assert x_found == pytest.approx(x_vague, abs=1e-8)
    assert P_found == pytest.approx(P_vague, abs=1e-8)


@pytest.mark.parametrize("y", [None, np.full(4, np.nan)])
def test_no_observation_changes_nothing(y: np.ndarray | None) -> None:
    x, P = np.arange(7.0), np.diag(np.arange(1.0, 8.0))
    x_found, P_found = multi_rate_update(x, P, y, np.zeros(4), np.ones((4, 7)), np.eye(4))
    assert (x_found == x).all()
    assert (P_found == P).all()
