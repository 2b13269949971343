"""The filters of other profilers: measured gain and phase are those of their closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2.section_2_2_signal_flow import (
    bidirectional_high_pass,
    conventional_high_pass,
)
from floatref_reference.chapter_3.section_3_1_2_filters import (
    TABLE_3_2,
    anti_smoothing,
    anti_smoothing_response,
    butterworth_response,
    cotangent,
    cotangent_response,
    held_length,
    sample_and_hold,
)
from floatref_reference.chapter_3.section_3_3_5_3_braking import change
from floatref_reference.chapter_3.section_3_3_7_2_stops import TABLE_3_10, contaminated

DX, LAMBDA_B6 = 0.5, 105.91
FILTERS = {
    3: lambda z: conventional_high_pass(z, DX),
    4: lambda z: bidirectional_high_pass(z, DX, LAMBDA_B6),
    5: lambda z: anti_smoothing(z, DX),
    6: lambda z: cotangent(z, DX),
}
RESPONSES = {
    3: lambda wavelength: butterworth_response(wavelength, DX),
    4: lambda wavelength: butterworth_response(wavelength, DX, LAMBDA_B6, both_ways=True),
    5: lambda wavelength: anti_smoothing_response(wavelength, DX),
    6: lambda wavelength: cotangent_response(wavelength, DX),
}
PROFILERS = sorted(FILTERS)


def measured(profiler: int, wavelength: float) -> complex:
    """Return gain and phase of the filter on a cosine, fitted far from both ends."""
    x = np.arange(2400) * DX
    wave = np.exp(2j * np.pi * x / wavelength)
    y = FILTERS[profiler](wave.real)[1100:1300].astype(float)
    columns = np.column_stack([wave.real, -wave.imag])[1100:1300]
    a, b = np.linalg.lstsq(columns, y, rcond=None)[0]
    return complex(a, b)


@pytest.mark.cites("Table 3.2")
@pytest.mark.parametrize("profiler", PROFILERS)
@settings(max_examples=4, deadline=None)
@given(wavelength=st.floats(3.0, 200.0))
def test_a_cosine_comes_out_as_the_closed_form_says(profiler: int, wavelength: float) -> None:
    assert measured(profiler, wavelength) == pytest.approx(
        RESPONSES[profiler](wavelength), abs=1e-5
    )


@pytest.mark.cites("Table 3.2")
@pytest.mark.parametrize("profiler", [3, 4, 6])
def test_3_db_are_lost_at_the_printed_wavelength(profiler: int) -> None:
    row = next(row for row in TABLE_3_2 if row.profiler == profiler)
    assert abs(RESPONSES[profiler](row.length)) == pytest.approx(math.sqrt(0.5), abs=1e-4)


@pytest.mark.cites("Table 3.2")
@given(order=st.integers(1, 6), wavelength=st.floats(3.0, 500.0))
def test_the_cotangent_filter_loses_3_db_there_in_any_order(order: int, wavelength) -> None:
    loss = abs(cotangent_response(wavelength, DX, wavelength, order))
    assert loss == pytest.approx(math.sqrt(0.5))


@pytest.mark.cites("Table 3.2")
def test_70_m_are_a_base_length_that_loses_3_db_near_91_44_m() -> None:
    assert abs(anti_smoothing_response(92.7, 0.01)) == pytest.approx(math.sqrt(0.5), abs=1e-3)
    assert abs(anti_smoothing_response(70.0, 0.01)) == pytest.approx(1.0, abs=1e-3)


@pytest.mark.cites("Table 3.2")
@pytest.mark.parametrize(("profiler", "spread"), [(3, False), (4, True), (5, True), (6, False)])
def test_only_what_runs_both_ways_spreads_ahead_of_a_disturbance(profiler: int, spread) -> None:
    """Sections 3.3.5.2 and 3.3.7.1: symmetrical, or with a forward bias."""
    z = np.where(np.arange(1001) > 500, 1.0, 0.0) - np.where(np.arange(1001) < 500, 1.0, 0.0)
    y = FILTERS[profiler](z - z[0]).astype(float)
    assert (np.abs(y[:500]).max() > 0.1) == spread
    if spread:
        assert y == pytest.approx(-y[::-1], abs=0.02)


@settings(max_examples=15)
@given(offset=st.floats(-5, 5), slope=st.floats(-0.1, 0.1))
def test_anti_smoothing_takes_away_offset_and_slope(offset: float, slope: float) -> None:
    z = offset + slope * np.arange(200) * DX
    assert np.abs(anti_smoothing(z, DX)).max() < 1e-12


@pytest.mark.slow
@pytest.mark.cites("Table 3.10", "Table 3.2")
@pytest.mark.parametrize("profiler", [2, 4, 5, 6])
def test_a_step_of_the_printed_peak_contaminates_about_the_printed_length(profiler) -> None:
    """Downstream, above 0.5 m/km, for the highest peak: upstream the brakes do most."""
    x = np.arange(1000) * DX
    step = np.where(x > 250, 1.0, 0.0)
    filtered = FILTERS.get(profiler, np.array)(step)
    delta = change(filtered, np.zeros_like(x), DX).astype(float)
    row = next(row for row in TABLE_3_10 if row.profiler == profiler)
    found = contaminated(delta * row.highest / delta.max(), DX, 250.0, 0.5)
    assert float(found.downstream) == pytest.approx(row.downstream, rel=0.2)


@pytest.mark.cites("Table 3.2")
@settings(max_examples=20)
@given(grade=st.floats(0.002, 0.05), hold=st.floats(0.5, 4.0), rise=st.floats(-2.0, 2.0))
def test_sample_and_hold_takes_the_step_and_leaves_a_flat_area(grade, hold, rise) -> None:
    """On a grade the flat area has a kink of the grade at both ends."""
    dx, a_0, a_1 = 0.02, 2.0, 1.5
    x = (np.arange(2000) - 1000) * dx + dx / 2
    v = np.sqrt(2 * np.abs(x) * np.where(x < 0, a_0, a_1))
    y = sample_and_hold(grade * x + np.where(x > 0, rise, 0.0), v, hold).astype(float)
    slopes = np.diff(y) / dx
    flat = np.flatnonzero(np.abs(slopes) < 1e-9)
    assert len(flat) * dx == pytest.approx(float(held_length(hold, a_0, a_1)), abs=2 * dx)
    assert (np.diff(flat) == 1).all()
    assert np.delete(slopes, flat) == pytest.approx(grade)
