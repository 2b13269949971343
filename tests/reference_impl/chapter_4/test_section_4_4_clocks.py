"""Two clocks and what they both saw: closed forms of the line and of the matching."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_4 import section_4_4_clocks as section

FEW = settings(deadline=None, max_examples=20)
offsets = st.floats(-1e4, 1e4)
drifts = st.floats(-2e-4, 2e-4)


@pytest.mark.cites("section 4.4")
@FEW
@given(offset=offsets, drift=drifts, seed=st.integers(0, 2**32 - 1))
def test_the_line_of_a_clock_without_jitter_is_that_clock(offset, drift, seed) -> None:
    t = np.cumsum(np.random.default_rng(seed).uniform(0.5, 4.0, 12))
    found = section.line(t, section.common_clock(t, offset, drift))
    assert found.offset == pytest.approx(offset, abs=1e-9)
    assert found.drift == pytest.approx(drift, abs=1e-11)
    assert found.residual < 1e-9


def test_sigma_is_that_of_the_slope_of_a_line() -> None:
    """Residuals of +1, −2, +1 about a line through three points one apart: σ² = 6/1/2."""
    found = section.line([0.0, 1.0, 2.0], [1.0, -1.0, 3.0])
    assert found.sigma == pytest.approx(np.sqrt(3.0))
    assert found.residual == pytest.approx(np.sqrt(2.0))


def test_the_shift_is_the_one_at_which_most_pulses_meet() -> None:
    own = np.array([0.0, 1.0, 3.0, 3.4, 7.0])
    base = np.array([10.0, 12.0, 12.3, 16.0])
    assert section.shift_of_most(own, base, 0.01) == pytest.approx(9.0)
    by_own, by_base = section.pairs(own, base, 9.0, 0.0, 0.01)
    assert by_own.tolist() == [1.0, 3.0, 7.0]
    assert by_base.tolist() == [10.0, 12.0, 16.0]


@pytest.mark.parametrize(("near", "shift"), [(0.0, 0.0), (5.0, 4.0), (-9.0, -8.0)])
def test_of_equal_shifts_the_stated_one_is_taken(near: float, shift: float) -> None:
    own, base = 4.0 * np.arange(20, 23), 4.0 * np.arange(40)
    assert section.shift_of_most(own, base, 0.01, near) == shift


@pytest.mark.cites("section 4.4")
@FEW
@given(offset=offsets, drift=drifts, seed=st.integers(0, 2**32 - 1))
def test_late_readings_do_not_move_the_earliest_line(offset, drift, seed) -> None:
    rng = np.random.default_rng(seed)
    gnss = np.arange(20.0)
    late = rng.uniform(0.0, 0.5, gnss.size)
    late[[2, 17]] = 0.0
    base = section.common_clock(gnss, offset, drift) + late
    found = section.earliest_line(gnss, base)
    assert (base - section.common_clock(gnss, found.offset, found.drift)).min() > -1e-9
    assert (base - section.common_clock(gnss, offset, drift)).min() > -1e-9
    total = float(np.sum(base - section.common_clock(gnss, found.offset, found.drift)))
    assert total <= float(late.sum()) + 1e-8


def test_readings_at_one_time_make_no_line() -> None:
    with pytest.raises(ValueError, match="two readings"):
        section.earliest_line([1.0], [1.0])
