"""The 1-sigma of the IRI's bias is what stretches of the section differ by."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_conformance.certify.judging.comparing import ratio_sigma


@given(st.integers(0, 2**31), st.floats(0.5, 2.0))
def test_traces_in_one_proportion_have_no_scatter(seed, ratio):
    trace = np.random.default_rng(seed).normal(size=600)
    assert ratio_sigma(trace, ratio * trace) == pytest.approx(0.0, abs=1e-9)


def test_sigma_is_the_scatter_of_the_ratio():
    draw, ratios, sigmas = np.random.default_rng(5), [], []
    for _ in range(300):
        common, mine, theirs = draw.normal(size=(3, 1200))
        p, q = common + 0.4 * mine, common + 0.4 * theirs
        ratios.append(np.abs(q).sum() / np.abs(p).sum())
        sigmas.append(ratio_sigma(p, q))
    assert np.mean(sigmas) == pytest.approx(np.std(ratios), rel=0.2)


def test_points_that_one_of_both_lacks_do_not_count():
    p, q = np.random.default_rng(1).normal(size=(2, 600))
    short = q.copy()
    short[:30] = np.nan
    assert ratio_sigma(p, short) == pytest.approx(ratio_sigma(p[30:], q[30:]))


def test_a_level_line_has_no_ratio():
    assert np.isnan(ratio_sigma(np.zeros(60), np.ones(60)))
