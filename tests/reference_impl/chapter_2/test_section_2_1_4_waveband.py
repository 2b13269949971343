"""Spectra, frequency response and the wavelength thresholds of Tables 2.4 to 2.6."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2 import section_2_1_4_1_spectral_models as spectra
from floatref_reference.chapter_2 import section_2_1_4_waveband as waveband
from floatref_reference.chapter_2.section_2_1_1_golden_car import state_matrices

WAVE_NUMBERS = st.floats(1e-3, 50.0)
ROADS = ["very wavy", "standard", "white noise slope", "choppy"]
PRINTED_LONG = {
    "IRI": [42.88, 36.30, 20.43, 18.79],
    "GCARS_120": [65.58, 59.63, 30.53, 29.23],
    "GCARS_40": [19.88, 14.75, 10.42, 8.45],
    "PTRN": [16.55, 11.82, 8.65, 5.80],
}
PRINTED_SHORT = {
    "IRI": [1.47, 1.12, 0.96, 0.61],
    "GCARS_120": [2.37, 1.80, 1.36, 0.86],
    "GCARS_40": [0.68, 0.59, 0.57, 0.42],
    "PTRN": [0.38, 0.34, 0.34, 0.14],
}


def near(printed: float) -> float:
    return max(0.0015 * printed, 0.02)


@pytest.mark.slow
@pytest.mark.cites("(2.11)", "Tables 2.4 to 2.6")
@pytest.mark.parametrize("column", range(4))
@pytest.mark.parametrize("index", waveband.INDICES)
def test_thresholds_agree_with_print(index: str, column: int) -> None:
    road = spectra.TABLE_2_3[ROADS[column]]
    long, short = waveband.wavelength_thresholds(waveband.INDICES[index], road)
    printed_long, printed_short = PRINTED_LONG[index][column], PRINTED_SHORT[index][column]
    assert long == pytest.approx(printed_long, abs=near(printed_long))
    assert short == pytest.approx(printed_short, abs=near(printed_short))


def test_95_percent_of_the_iri_on_the_standard_road_as_in_figure_2_8() -> None:
    road, iri = spectra.TABLE_2_3["standard"], waveband.INDICES["IRI"]
    long, short = waveband.wavelength_thresholds(iri, road, 0.95)
    assert long == pytest.approx(20.13, rel=0.0015)
    assert short == pytest.approx(1.85, abs=0.02)


@pytest.mark.cites("(2.9)", "(2.10)")
@pytest.mark.parametrize("index", waveband.INDICES.values(), ids=waveband.INDICES)
@settings(deadline=None, max_examples=20)
@given(nu=WAVE_NUMBERS)
def test_transfer_function_solves_the_equations_of_motion(index: waveband.Index, nu: float) -> None:
    A, B = (np.asarray(matrix, dtype=float) for matrix in state_matrices(index.car))
    omega = 2 * math.pi * nu * index.V / 3.6
    X = np.linalg.solve(1j * omega * np.eye(4) - A, B)
    expected = X[0] - X[2]
    assert waveband.h_suspension_stroke(nu, index) == pytest.approx(expected, rel=1e-6)


@pytest.mark.cites("(2.7)")
@settings(deadline=None, max_examples=20)
@given(nu=WAVE_NUMBERS, B=st.floats(0.05, 1.0))
def test_moving_average_is_the_mean_of_a_cosine_over_its_base(nu: float, B: float) -> None:
    x = (np.arange(4000) + 0.5) / 4000 * B - B / 2
    mean = np.cos(2 * np.pi * nu * x).mean()
    assert waveband.h_moving_average(nu, B) == pytest.approx(mean, abs=1e-3)
    assert waveband.h_moving_average(nu, 0.0) == 1.0


@pytest.mark.cites("(2.4)", "(2.5)")
@pytest.mark.parametrize("road", [*spectra.TABLE_2_2.values(), *spectra.TABLE_2_3.values()])
@settings(deadline=None, max_examples=10)
@given(nu=WAVE_NUMBERS)
def test_slope_spectrum_is_the_elevation_spectrum_differentiated(
    road: spectra.SpectralModel, nu: float
) -> None:
    expected = (2 * math.pi * nu) ** 2 * spectra.elevation_spectrum(nu, road)
    assert spectra.slope_spectrum(nu, road) == pytest.approx(expected, rel=1e-12)


@pytest.mark.cites("(2.3)", "(2.6)")
@settings(deadline=None, max_examples=10)
@given(nu=WAVE_NUMBERS, nu_0=st.floats(0.01, 1.0))
def test_la_barre_is_sayers_without_white_noise_elevation(nu: float, nu_0: float) -> None:
    ratio = spectra.acceleration_to_slope_ratio(nu_0)
    road = spectra.SpectralModel(G_e=0.0, G_s=3.0, G_a=3.0 * ratio)
    expected = spectra.la_barre_slope_spectrum(nu, 3.0, nu_0)
    assert spectra.slope_spectrum(nu, road) == pytest.approx(expected, rel=1e-12)


@pytest.mark.cites("(2.1)", "(2.2)")
@settings(deadline=None, max_examples=10)
@given(nu=WAVE_NUMBERS, nu_0=st.floats(0.01, 1.0))
def test_power_law_with_exponent_2_has_a_constant_slope_spectrum(nu: float, nu_0: float) -> None:
    slope = (2 * math.pi * nu) ** 2 * spectra.power_law(nu, 5e-6, nu_0, 2.0)
    assert spectra.constant_slope_spectrum(5e-6, nu_0) == pytest.approx(slope, rel=1e-12)


def test_flexible_constructions_have_the_printed_ratio() -> None:
    assert round(spectra.acceleration_to_slope_ratio(0.164), 2) == 1.06
