"""A part of the run is what the run up to then says of it, and the parts follow one another."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref_reference.road_prior import fixed_lag as lag
from floatref_reference.road_prior.lag_sections import Sections
from floatref_reference.road_prior.least_squares import least_squares
from floatref_reference.road_prior.smoother import smooth
from floatref_reference.road_prior.symbols import Constants

C = Constants(q=1e-5, g=3e-6)
LITERAL = 3e-6
"""Of the largest height: the literal smoother inverts covariances at every sample."""
laws = settings(deadline=None, max_examples=8, phases=[Phase.explicit, Phase.generate])
SEEDS = st.integers(0, 9999)


def whole(count):
    return Sections([], [False] * count)


@pytest.mark.cites("(6.17)")
@laws
@given(seed=SEEDS, share=st.floats(0.4, 1.0))
def test_without_sections_it_is_the_smoother_and_least_squares(drawn, seed, share):
    run = drawn(seed, share=share)
    found = lag.fixed_lag(run, C, whole(run.t.size), np.longdouble).astype(float)
    scale = np.abs(found).max()
    np.testing.assert_allclose(found, least_squares(run, C).x[:, 0], atol=1e-8 * scale)
    np.testing.assert_allclose(found, smooth(run, C).r[0], atol=LITERAL * scale)


@laws
@given(seed=SEEDS)
def test_the_first_part_is_what_the_run_up_to_the_third_end_says(drawn, seed):
    run = drawn(seed, N=60)
    ends = [14, 29, 44]
    found = lag.fixed_lag(run, C, Sections(ends, [False] * 60))
    signals = {n: getattr(run, n)[..., :45] for n in ("t", "distance", "a_m", "h", "a_x")}
    begun = run._replace(u=run.u[:, :45], **signals)
    expected = smooth(begun, C).r[0]
    atol = LITERAL * np.abs(expected).max()
    np.testing.assert_allclose(found[:15], expected[:15], rtol=0, atol=atol)


@laws
@given(seed=SEEDS)
def test_a_part_begins_where_the_one_before_has_ended(drawn, seed):
    """Next to the joint, both parts differ from the smoothed run by the same, which fades away."""
    run = drawn(seed, N=60)
    ends = [14, 29, 44]
    found = lag.fixed_lag(run, C, Sections(ends, [False] * 60))
    last = smooth(run, C).r[0]
    gap = found[14] - last[14]
    assert found[15] - last[15] == pytest.approx(gap, abs=0.3 * abs(gap) + 1e-6)


@given(gap=st.floats(-0.1, 0.1), slope=st.floats(-1e-3, 1e-3))
def test_what_fades_begins_with_gap_and_slope_and_is_gone_after_kilometres(gap, slope):
    step = 1e-4
    assert lag.fading(gap, slope, 0.0) == gap
    found = (lag.fading(gap, slope, step) - gap) / step
    assert found == pytest.approx(slope, abs=1e-9 + 1e-6 * abs(gap))
    assert abs(lag.fading(gap, slope, 2e4)) < 1e-6


def test_in_single_precision_a_reading_has_a_variance_below_zero(drawn):
    """P holds a height that is known to a metre, and a difference to 0.1 mm: eight digits."""
    run = drawn(3, N=400, dt=0.002, share=1.0)
    usual = Constants()
    single = lag.forward(run, usual, np.float32)
    double = lag.forward(run, usual)
    assert min(step.information for step in double if step.nu != 0) > 0
    assert min(step.information for step in single) < 0
