"""Slips in the print of chapter 2: the printed form fails, the mended one holds."""

import numpy as np
import pytest

from floatref_reference.chapter_2 import section_2_1_4_waveband as waveband
from floatref_reference.chapter_2.section_2_1_1_golden_car import QuarterCar
from floatref_reference.chapter_2.section_2_1_3_roughness_profiles import BASE_LENGTH
from floatref_reference.chapter_2.section_2_1_4_1_spectral_models import TABLE_2_3
from floatref_reference.chapter_2.section_2_1_5_comparison import correlation, standard_deviation
from floatref_reference.chapter_2.section_2_3_2_pendulum import deceleration_pulse, simulate

G = 9.80665
TENTH_OF_A_MILE = 160.9344


def denominator_as_printed(omega: float, car: QuarterCar) -> complex:
    K_1, K_2, C, mu = car
    real = mu * omega**4 - (K_1 + K_2 * (1 + mu)) * omega**2 + K_1 * K_2
    return real + 1j * C * omega * (K_1 + omega**2 * (1 + mu))


def longest_wave() -> float:
    """Return the first cell of Table 2.4, where 42.88 m is printed."""
    return waveband.wavelength_thresholds(waveband.INDICES["IRI"], TABLE_2_3["very wavy"])[0]


def test_damping_term_2_10(monkeypatch: pytest.MonkeyPatch) -> None:
    assert longest_wave() == pytest.approx(42.88, rel=1.5e-3)
    monkeypatch.setattr(waveband, "denominator", denominator_as_printed)
    assert longest_wave() == pytest.approx(47.58, abs=0.01)


def test_normalization_2_14() -> None:
    p = np.random.default_rng(1).normal(size=60)
    assert float(correlation(p, p, 0)) == pytest.approx(1.0)
    printed = np.sum((p - p.mean()) ** 2) / standard_deviation(p) ** 2
    assert float(printed) == pytest.approx(60.0)


def test_base_length_7_26() -> None:
    """Peaks of 3299.8 and 317.5 m/km are said to add 156.2 and 15.0 m/km to the section's IRI."""
    for peak, share in [(3299.8, 156.2), (317.5, 15.0)]:
        assert peak * BASE_LENGTH / TENTH_OF_A_MILE == pytest.approx(share, abs=0.05)
        assert peak * 7.26 / TENTH_OF_A_MILE < share - 0.5


def test_deceleration_pulse_2_26() -> None:
    t = np.arange(2.0, 3.0, 0.001)
    mended = sum(float(deceleration_pulse(np.longdouble(t_k))) for t_k in t) * 0.001
    assert 22.0 + mended == pytest.approx(20.0, abs=0.05)
    printed = -0.4 * G * np.sin(2 * np.pi * (t - 2.0) / 1.0)
    assert 22.0 + printed.sum() * 0.001 == pytest.approx(22.0, abs=1e-9)
    assert printed.max() == pytest.approx(0.4 * G, rel=1e-3)


def test_braking_from_40_km_h_2_3_2() -> None:
    """79 to 37 km/h with at least 3.75 s above 0.25 g; the same brake from 40 km/h."""
    brake = 0.31 * G
    duration = 42 / 3.6 / brake
    assert duration > 3.75

    def push(t: np.longdouble) -> np.longdouble:
        return np.longdouble(-brake if t < duration else 0)

    steps = {v: np.diff(simulate(5.0, 0.02, v / 3.6, push).x) for v in (79.0, 40.0)}
    assert steps[79.0].min() / 0.02 == pytest.approx(37 / 3.6, rel=0.01)
    assert steps[40.0].min() / 0.02 == pytest.approx(-2 / 3.6, rel=0.1)
