"""Figures of chapter 6 that its text and its tables do not agree on."""

import numpy as np
import pytest

from floatref_conformance.table.published import RUN_NAMES, published_figures
from floatref_conformance.table.scores import Scores
from floatref_reference.chapter_6.section_6_4_2_distribution import autocorrelation

BRAKING = [run for run in RUN_NAMES if run.startswith(("brk", "ns"))]
REFERENCE_PEAK = 2.4


def scores(pipeline: str, run: str) -> Scores:
    return published_figures()[pipeline, run].scores


def test_71_to_30_km_h_6_6_2() -> None:
    """Text 0.975, Table 6.3 0.978; the IRI error of 2 % in the text fits the run, not the next."""
    found = {run: scores("kalman-smoother", run).cross_correlation for run in BRAKING}
    assert found["brk_71-30_0.19g"] == 0.978
    assert [run for run, value in found.items() if value == 0.975] == ["brk_72-29_0.39g"]
    assert scores("kalman-filter", "brk_71-30_0.19g").cross_correlation == 0.915
    assert round(scores("kalman-smoother", "brk_71-30_0.19g").iri_error_percent) == 2


def test_eight_of_the_nine_6_6_2() -> None:
    """Eight runs brake without a stop, and seven of them have a peak within 10 %."""
    assert len(BRAKING) == 8
    found = {run: scores("kalman-smoother", run) for run in BRAKING}
    assert all(abs(of.iri_error_percent) < 5 for of in found.values())
    above = [run for run, of in found.items() if of.peak_m_per_km > 1.1 * REFERENCE_PEAK]
    assert above == ["brk_49-23_0.18g_b"]


def test_5_km_h_with_high_pass_filters_6_6_2() -> None:
    """Text 0.938, Tables 5.5 and 7.1 0.940; 0.938 is the smoother's at the 10.7-second stop."""
    at_5_km_h = {
        pipeline: of.scores.cross_correlation
        for (pipeline, run), of in published_figures().items()
        if run == "const_5"
    }
    assert at_5_km_h["temporal-hpf"] == 0.940
    assert at_5_km_h["kalman-smoother"] == 0.973
    assert 0.938 not in at_5_km_h.values()
    assert scores("kalman-smoother", "sg_10.7s_0.20g").cross_correlation == 0.938


def test_20_000_data_points_6_4_2() -> None:
    """White noise of so few points exceeds 0.5 %; 20,000 lags of a million points do not."""
    few = autocorrelation(np.random.default_rng(1).normal(size=20_000), 100)[1:]
    assert float(np.std(few)) == pytest.approx(1 / np.sqrt(20_000), rel=0.25)
    assert few.max() > 0.01
    many = np.random.default_rng(1).normal(size=1_000_000)
    spectrum = np.abs(np.fft.rfft(many, 2**20 + 2**17)) ** 2
    lags = np.fft.irfft(spectrum)[1:20_001] / np.sum(many**2)
    assert lags.max() < 0.005
