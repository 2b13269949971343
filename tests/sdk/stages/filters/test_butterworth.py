"""The filter sets as stages, and the cut-offs that a stage refuses."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.engine import flow
from floatref.errors import InputError
from floatref.stages.filters import butterworth
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_reference.appendix_a import filters

ELEVATION = ChannelId("elevation", "main")
HEADER = Header(Axis.DISTANCE, 0.05, 0.0, Fraction(1000), frozenset({ELEVATION}), ("main",))
SETS = {
    "high_pass_b3": filters.hpf_b3,
    "low_pass_b3": filters.lpf_b3,
    "high_pass_b3x2": filters.hpf_b3x2,
    "low_pass_b3x2": filters.lpf_b3x2,
}


@pytest.mark.cites("(A.1)")
@pytest.mark.parametrize("name", SETS)
@settings(deadline=None, max_examples=10)
@given(cutoff=st.floats(0.01, 4.0), cut=st.integers(1, 199), seed=st.integers(0, 2**32 - 1))
def test_a_set_of_stages_is_the_printed_one(name, cutoff, cut, seed):
    x = np.random.default_rng(seed).standard_normal(200)
    blocks = [Block(0, {ELEVATION: x[:cut]}), Block(cut, {ELEVATION: x[cut:]})]
    _, out = flow.run(getattr(butterworth, name)("elevation", cutoff), HEADER, blocks)
    found = np.concatenate([block[ELEVATION] for block in out])
    assert np.abs(found - SETS[name](x, cutoff, 0.05)).max() <= 1e-10


def through(stages, x, cuts):
    bounds = sorted({0, *cuts, x.size})
    blocks = [Block(a, {ELEVATION: x[a:b]}) for a, b in pairwise(bounds)]
    _, out = flow.run(stages, HEADER, blocks)
    return np.concatenate([block[ELEVATION] for block in out])


@settings(deadline=None, max_examples=30)
@given(
    cutoff=st.floats(0.01, 4.0),
    cuts=st.lists(st.integers(1, 199), max_size=4),
    missing=st.lists(st.integers(0, 199), max_size=9),
    lead=st.integers(0, 200),
    seed=st.integers(0, 2**32 - 1),
)
def test_one_pass_of_a_low_pass_has_the_bits_of_two(cutoff, cuts, missing, lead, seed):
    x = np.random.default_rng(seed).standard_normal(200)
    x[missing], x[:lead] = np.nan, np.nan
    two = [each("elevation", cutoff) for each in (butterworth.LowPassB3S1, butterworth.LowPassB3S2)]
    one = through(butterworth.low_pass_b3("elevation", cutoff), x, cuts)
    np.testing.assert_array_equal(one, through(two, x, cuts))


@pytest.mark.parametrize("cutoff", [0.0, -1.0, 10.0, float("nan")])
def test_a_cut_off_beyond_half_the_sampling_rate_is_refused(cutoff):
    with pytest.raises(InputError, match="outside 0 to 10, half the sampling rate"):
        butterworth.HighPassB3S1("elevation", cutoff).start(HEADER)
