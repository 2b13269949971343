"""The line between two clocks where a drift, or a clock itself, leaps: nothing sound is dropped."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures.clocks.clock_alignment import align_by_pulses

FEW = settings(deadline=None, max_examples=40)
seeds = st.integers(0, 2**32 - 1)


@pytest.mark.slow
@FEW
@given(
    seed=seeds,
    before=st.floats(-2e-4, 2e-4),
    change=st.floats(5e-5, 2e-4),
    at=st.integers(20, 180),
    bad=st.booleans(),
)
def test_a_drift_that_leaps_is_followed_around_the_corner(seed, before, change, at, bad) -> None:
    rng = np.random.default_rng(seed)
    own = np.cumsum(rng.uniform(1.0, 7.0, 200))
    true = 7.0 + (1 + before) * own + change * np.clip(own - own[at], 0.0, None)
    seen = true + rng.uniform(-1e-5, 1e-5, own.size)
    seen[at // 2] += 5e-3 * bad
    found = align_by_pulses(own, seen)
    assert found.pairs == own.size - bad
    assert np.abs(found.to_base(own) - true).max() < 1e-4


@pytest.mark.slow
@FEW
@given(seed=seeds, leap=st.floats(1e-3, 1e-2), at=st.integers(20, 180))
def test_a_clock_that_leaps_by_less_than_a_match_keeps_its_pulses(seed, leap, at) -> None:
    rng = np.random.default_rng(seed)
    own = np.cumsum(rng.uniform(1.0, 7.0, 200))
    base = own + leap * (np.arange(own.size) > at) + rng.uniform(-1e-5, 1e-5, own.size)
    found = align_by_pulses(own, base)
    assert found.pairs == own.size
    assert np.abs(found.to_base(own) - base).max() < 1e-4
    assert "the drift is not constant" in found.warnings[-1]


def test_a_clock_that_was_set_is_told() -> None:
    own = 4.0 * np.arange(300)
    found = align_by_pulses(own, own + 0.25 * (own > 600))
    assert "149 pulses in a row, from 600 to 1196 s of this clock" in found.warnings[-1]


def test_pulses_that_one_clock_alone_had_for_a_while_are_no_such_case() -> None:
    own = np.cumsum(np.random.default_rng(3).uniform(1.0, 7.0, 300))
    for some, base in ((own[90:], own[:200]), (own, own[(own < 300) | (own > 700)])):
        assert align_by_pulses(some, base).warnings == ()
        assert align_by_pulses(base, some).warnings == ()
