"""Stages with a cut-off of its own at each sample."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a import filters, varying

STAGES = ["hpf_b3s1", "hpf_b3s2", "hpf_b3s1r", "hpf_b3s2r"]
HALF, ONE = math.atan(0.5) / math.pi, 0.25
"""Cut-offs, in cycles per sample, at which c is 1/2 and 1."""

Varying = Callable[[npt.ArrayLike, npt.ArrayLike, float], npt.NDArray[np.longdouble]]


def varying_stage(name: str) -> Varying:
    found: Varying = getattr(varying, f"{name}_varying")
    return found


@pytest.mark.parametrize("stage", STAGES)
@settings(deadline=None, max_examples=15)
@given(
    x=st.lists(st.floats(-100.0, 100.0), min_size=1, max_size=30),
    cut_off=st.floats(0.001, 0.45),
)
def test_constant_cut_off_is_the_fixed_stage(stage: str, x: list[float], cut_off: float) -> None:
    y = varying_stage(stage)(x, [cut_off] * len(x), 1.0)
    assert y == pytest.approx(getattr(filters, stage)(x, cut_off, 1.0), abs=1e-14)


# With c = 1/2 the rows are D = (3/2, -1/2) and (7/4, -3/2, 3/4), with c = 1 (2, 0) and (3, 0, 1).
@pytest.mark.parametrize(
    ("stage", "expected"),
    [
        ("hpf_b3s1", [1 / 3, -1 / 2, -1 / 6]),
        ("hpf_b3s2", [3 / 7, -10 / 21, -1 / 49]),
    ],
)
def test_each_output_takes_the_cut_off_of_its_own_sample(stage: str, expected: list[float]) -> None:
    y = varying_stage(stage)([1, 0, 0], [HALF, ONE, HALF], 1.0)
    assert y == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(
    ("stage", "expected"),
    [
        ("hpf_b3s1r", [0, -1 / 2, 1 / 3]),
        ("hpf_b3s2r", [4 / 21, -10 / 21, 3 / 7]),
    ],
)
def test_reverse_stages_pair_samples_and_cut_offs_too(stage: str, expected: list[float]) -> None:
    y = varying_stage(stage)([0, 0, 1], [ONE, ONE, HALF], 1.0)
    assert y == pytest.approx(expected, abs=1e-15)


def test_cut_offs_come_in_hertz() -> None:
    x, f_c = np.arange(9.0) ** 2, np.linspace(0.01, 0.1, 9)
    slow = varying.hpf_b3s2_varying(x, f_c, 1.0)
    assert varying.hpf_b3s2_varying(x, 1000 * f_c, 0.001) == pytest.approx(slow, abs=1e-13)


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("f_c", [[0.1], [0.1, 0.1, 0.1], [0.1, 0.5]])
def test_cut_offs_that_make_no_filter_are_refused(stage: str, f_c: list[float]) -> None:
    with pytest.raises(ValueError, match=r"cut-offs|outside"):
        varying_stage(stage)([1.0, 2.0], f_c, 1.0)
