"""The designated filters have the responses of their transfer functions."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a import designations, filters

Filter = Callable[[npt.ArrayLike, float, float], npt.NDArray[np.longdouble]]
STAGES = ["lpf_b3s1", "lpf_b3s2", "hpf_b3s1", "hpf_b3s2"]
DX = 0.5


def named(name: str) -> Filter:
    found: Filter = getattr(filters, name)
    return found


def warped(frequency: float) -> float:
    return 2 * math.tan(math.pi * frequency)


def spatial_gain(wavelength: float, lambda_c: float = 105.91) -> float:
    """Measure HPF_B3x2 on a cosine, in the middle of a profile of 2 km."""
    x = np.arange(4001) * DX
    z = np.cos(2 * np.pi * (x - x[2000]) / wavelength)
    return float(filters.hpf_b3x2(z, 1 / lambda_c, DX)[2000])


@pytest.mark.parametrize("stage", STAGES)
@settings(deadline=None, max_examples=10)
@given(cut_off=st.floats(0.03, 0.3), frequency=st.floats(0.01, 0.45))
def test_sinusoid_comes_out_as_the_transfer_function_says(
    stage: str, cut_off: float, frequency: float
) -> None:
    k = np.arange(400)
    y = named(stage)(np.cos(2 * np.pi * frequency * k), cut_off, 1.0)
    H = getattr(designations, stage)(1j * warped(frequency), warped(cut_off))
    expected = (H * np.exp(2j * np.pi * frequency * k)).real
    assert y[-20:] == pytest.approx(expected[-20:], abs=1e-9)


@pytest.mark.parametrize("stage", STAGES)
@settings(deadline=None, max_examples=15)
@given(
    x=st.lists(st.floats(-100.0, 100.0), min_size=1, max_size=12),
    cut_off=st.floats(0.001, 0.45),
)
def test_reverse_stage_is_the_forward_stage_back_to_front(
    stage: str, x: list[float], cut_off: float
) -> None:
    forward = named(stage)(x[::-1], cut_off, 1.0)[::-1]
    assert (named(f"{stage}r")(x, cut_off, 1.0) == forward).all()


@pytest.mark.parametrize("kind", ["lpf", "hpf"])
def test_sets_apply_their_stages_in_the_printed_order(kind: str) -> None:
    x = np.random.default_rng(3).normal(size=40)
    first, second = named(f"{kind}_b3s1"), named(f"{kind}_b3s2")
    y = first(x, 0.05, 1.0)
    assert (named(f"{kind}_b3")(x, 0.05, 1.0) == second(y, 0.05, 1.0)).all()
    y = second(y[::-1], 0.05, 1.0)
    y = first(y, 0.05, 1.0)[::-1]
    y = second(y, 0.05, 1.0)
    assert named(f"{kind}_b3x2")(x, 0.05, 1.0) == pytest.approx(y, abs=1e-16)


@pytest.mark.parametrize(("wavelength", "printed"), [(42.9, 0.996), (65.6, 0.947)])
def test_zero_phase_high_pass_has_the_gains_of_section_5_3(
    wavelength: float, printed: float
) -> None:
    assert round(spatial_gain(wavelength), 3) == printed


def test_zero_phase_high_pass_loses_3_db_at_91_44_m() -> None:
    assert spatial_gain(91.44) == pytest.approx(math.sqrt(0.5), abs=1e-4)


def test_zero_phase_low_pass_keeps_phase_and_squares_the_gain() -> None:
    k = np.arange(-500, 501)
    y = filters.lpf_b3x2(np.cos(2 * np.pi * 0.04 * k), 0.05, 1.0)
    ratio = (warped(0.04) / warped(0.05)) ** 6
    assert y[480:521] == pytest.approx(
        np.cos(2 * np.pi * 0.04 * k[480:521]) / (1 + ratio), abs=1e-9
    )
