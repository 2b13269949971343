"""Cut-off settings of A.4 and A.5 put the -3 dB points where they promise."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_a import cut_off, digitization, table_a_1
from floatref_reference.appendix_a.table_a_1 import Coefficients

DX = 0.00508
HALF_POWER = math.sqrt(0.5)


def gain(f: float, dt: float, *rows: Coefficients) -> float:
    return math.prod(abs(digitization.transfer_function(row, f, dt)) for row in rows)


def stages(kind: str, f_c: float, dt: float) -> tuple[Coefficients, Coefficients]:
    c = digitization.substitution(f_c, dt)
    if kind == "hpf":
        return table_a_1.hpf_b3s1_coefficients(c), table_a_1.hpf_b3s2_coefficients(c)
    return table_a_1.lpf_b3s1_coefficients(c), table_a_1.lpf_b3s2_coefficients(c)


@pytest.mark.cites("(A.20)", "(A.21)")
@settings(deadline=None, max_examples=30)
@given(f=st.floats(0.1, 5.0))
def test_two_passes_lose_3_db_at_the_wanted_frequency(f: float) -> None:
    dt = 1e-4
    high = stages("hpf", float(cut_off.high_pass_cut_off(f)), dt)
    low = stages("lpf", float(cut_off.low_pass_cut_off(f)), dt)
    assert gain(f, dt, *high) ** 2 == pytest.approx(HALF_POWER, abs=1e-5)
    assert gain(f, dt, *low) ** 2 == pytest.approx(HALF_POWER, abs=1e-5)


@pytest.mark.cites("(A.22)")
def test_cut_off_wavelength_for_91_44_m_is_105_91_m() -> None:
    assert round(float(cut_off.high_pass_cut_off_wavelength(91.44)), 2) == 105.91


@pytest.mark.parametrize(
    ("wavelength", "printed"), [(42.9, 0.996), (65.6, 0.947), (91.44, round(HALF_POWER, 3))]
)
def test_digitized_filter_has_the_gains_of_section_5_3(wavelength: float, printed: float) -> None:
    rows = stages("hpf", 1 / 105.91, DX)
    assert round(gain(1 / wavelength, DX, *rows) ** 2, 3) == printed


def test_complementary_stages_lose_3_db_at_the_printed_ratios() -> None:
    assert round(float(cut_off.high_pass_second_stage_3db(1.0)), 5) == 0.78615
    assert round(float(cut_off.low_pass_second_stage_3db(1.0)), 5) == 1.27202
    dt = 1e-4
    _, high = stages("hpf", 1.0, dt)
    _, low = stages("lpf", 1.0, dt)
    assert gain(0.78615, dt, high) == pytest.approx(HALF_POWER, abs=1e-5)
    assert gain(1.27202, dt, low) == pytest.approx(HALF_POWER, abs=1e-5)


@pytest.mark.parametrize("kind", ["hpf", "lpf"])
@settings(deadline=None, max_examples=20)
@given(cycles=st.floats(1e-3, 0.49))
def test_at_the_cut_off_one_stage_loses_3_db_and_the_other_nothing(
    kind: str, cycles: float
) -> None:
    first, second = stages(kind, cycles, 1.0)
    assert gain(cycles, 1.0, first) == pytest.approx(HALF_POWER, rel=1e-9)
    assert gain(cycles, 1.0, second) == pytest.approx(1.0, rel=1e-9)
