"""The varying kernels are the printed recursion at every sample's own cut-off."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import varying
from floatref.kernels.memories import VARYING
from floatref.values.arrays import new_record
from floatref_reference.appendix_a import varying as literal

SEEDS = st.integers(0, 2**32 - 1)
FEW = settings(deadline=None, max_examples=12)
PAIRS = {
    ("high_pass_1", False): literal.hpf_b3s1_varying,
    ("high_pass_2", False): literal.hpf_b3s2_varying,
    ("high_pass_1", True): literal.hpf_b3s1r_varying,
    ("high_pass_2", True): literal.hpf_b3s2r_varying,
}
every_kernel = pytest.mark.parametrize(("name", "backward"), PAIRS)


def drawn(seed, size, highest=0.2):
    """A signal with a stand-off, and the tangent of a cut-off in cycles per sample."""
    rng = np.random.default_rng(seed)
    return rng.standard_normal(size) + 3.0, np.tan(np.pi * rng.uniform(1e-4, highest, size))


def filtered(name, x, c, backward):
    y = np.empty(x.size)
    getattr(varying, name)(x, y, c, new_record(VARYING), backward)
    return y


def fused(name, x, c, backward):
    y = np.empty(x.size)
    memories = new_record(VARYING), new_record(VARYING)
    getattr(varying, name)(x, y, c, *memories, backward)
    return y


@pytest.mark.cites("(A.9)", "(A.10)", "Table A.1")
@every_kernel
@FEW
@given(seed=SEEDS, wander=st.floats(0.0, 0.05))
def test_each_kernel_is_the_printed_recursion(name, backward, seed, wander):
    rng = np.random.default_rng(seed)
    cutoff = np.clip(0.05 + wander * rng.standard_normal(300).cumsum(), 1e-4, 0.45)
    x = rng.standard_normal(300).cumsum()
    expected = PAIRS[name, backward](x, cutoff, 1.0)
    found = filtered(name, x, np.tan(np.pi * cutoff), backward)
    assert np.abs(found - expected).max() <= 1e-12 * max(np.abs(expected).max(), np.abs(x).max())


@pytest.mark.cites("(A.9)", "(A.10)", "Table A.1")
@every_kernel
def test_accuracy_holds_at_low_cut_offs_and_16_khz(name, backward):
    x = np.random.default_rng(1).standard_normal(4000).cumsum()
    cutoff = (0.05 + 0.04 * np.sin(np.arange(4000) / 300.0)) / 16_000.0
    expected = PAIRS[name, backward](x, cutoff, 1.0)
    error = np.abs(filtered(name, x, np.tan(np.pi * cutoff), backward) - expected).max()
    assert error <= 1e-12 * np.abs(x).max()


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize("name", ["high_pass_12", "high_pass_21"])
@FEW
@given(seed=SEEDS, lost=st.sets(st.integers(0, 63)), unknown=st.sets(st.integers(0, 63)))
def test_a_fused_kernel_is_its_two_parts(name, backward, seed, lost, unknown):
    x, c = drawn(seed, 64)
    x[list(lost)], c[list(unknown)] = np.nan, np.nan
    apart = x
    for order in name[-2:]:
        apart = filtered(f"high_pass_{order}", apart, c, backward)
    assert np.abs(fused(name, x, c, backward) - apart).max() <= 1e-11


@every_kernel
@FEW
@given(seed=SEEDS, at=st.integers(1, 98), of_c=st.booleans())
def test_a_missing_sample_or_cut_off_is_the_one_before_it(name, backward, seed, at, of_c):
    x, c = drawn(seed, 100)
    held_x, held_c = x.copy(), c.copy()
    missing, held = (c, held_c) if of_c else (x, held_x)
    held[at] = missing[at + 1] if backward else missing[at - 1]
    missing[at] = np.nan
    np.testing.assert_array_equal(
        filtered(name, x, c, backward), filtered(name, held_x, held_c, backward)
    )


@every_kernel
@pytest.mark.parametrize("lead", [1, 5])
def test_nothing_comes_out_until_input_and_cut_off_are_there(name, backward, lead):
    x, c = drawn(0, 40)
    whole = filtered(name, x[: 40 - lead] if backward else x[lead:], c[lead:], backward)
    late = np.concatenate((np.full(lead, np.nan), c[lead:]))
    if backward:
        late = np.concatenate((c[lead:], np.full(lead, np.nan)))
    out = filtered(name, x, late, backward)[:: -1 if backward else 1]
    assert not out[:lead].any()
    np.testing.assert_array_equal(out[lead:], whole[:: -1 if backward else 1])


@every_kernel
def test_output_may_take_the_place_of_the_input(name, backward):
    x, c = drawn(3, 50)
    expected = filtered(name, x, c, backward)
    getattr(varying, name)(x, x, c, new_record(VARYING), backward)
    np.testing.assert_array_equal(x, expected)


def test_nothing_but_missing_samples_gives_zero():
    missing, c = np.full(5, np.nan), np.full(5, 0.1)
    assert not filtered("high_pass_2", missing, c, False).any()
    assert not fused("high_pass_21", missing, c, True).any()
