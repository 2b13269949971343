"""Table A.1 is the bilinear image of (A.1) to (A.5)."""

import cmath
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a import designations, digitization, table_a_1
from floatref_reference.appendix_a.table_a_1 import Coefficients

STAGES = ["lpf_b3s1", "lpf_b3s2", "hpf_b3s1", "hpf_b3s2"]
DT = 0.02


def row(stage: str, f_c: float, dt: float) -> Coefficients:
    build: Callable[..., Coefficients] = getattr(table_a_1, f"{stage}_coefficients")
    return build(digitization.substitution(f_c, dt))


@pytest.mark.cites("(A.2) to (A.8)", "(A.11)", "Table A.1")
@pytest.mark.parametrize("stage", STAGES)
@settings(deadline=None, max_examples=40)
@given(cut_off=st.floats(1e-3, 0.45), frequency=st.floats(1e-3, 0.49))
def test_row_equals_the_analog_stage_at_the_warped_frequency(
    stage: str, cut_off: float, frequency: float
) -> None:
    f_c, f = cut_off / DT, frequency / DT
    omega_a = float(digitization.analog_cut_off(f_c, DT))
    s = digitization.bilinear(cmath.exp(2j * cmath.pi * f * DT), DT)
    analog = getattr(designations, stage)(s, omega_a)
    digital = digitization.transfer_function(row(stage, f_c, DT), f, DT)
    assert digital == pytest.approx(analog, rel=1e-7, abs=1e-10)


@pytest.mark.cites("(A.1)")
@settings(deadline=None, max_examples=40)
@given(omega=st.floats(0.01, 100.0), omega_a=st.floats(0.1, 10.0))
def test_both_stages_make_the_third_order_butterworth_filter(omega: float, omega_a: float) -> None:
    s = 1j * omega
    high = designations.hpf_b3s1(s, omega_a) * designations.hpf_b3s2(s, omega_a)
    low = designations.lpf_b3s1(s, omega_a) * designations.lpf_b3s2(s, omega_a)
    ratio = (omega / omega_a) ** 6
    assert high == pytest.approx(designations.hpf_b3(s, omega_a), rel=1e-9)
    assert abs(high) ** 2 == pytest.approx(ratio / (1 + ratio), rel=1e-9)
    assert abs(low) ** 2 == pytest.approx(1 / (1 + ratio), rel=1e-9)


@pytest.mark.parametrize("cycles", [0.0, -0.1, 0.5, 3.0])
def test_cut_off_outside_the_nyquist_range_is_refused(cycles: float) -> None:
    with pytest.raises(ValueError, match="sample more finely"):
        digitization.substitution(cycles, 1.0)
