"""The coefficients of the gyroscope are those in print, and (6.56) is their spectrum."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_4_1_allan import modelled_variance
from floatref_reference.chapter_6.section_6_4_2_gyroscopes import (
    K_A,
    N_A,
    R_A,
    per_root_hour,
    spectral_density,
)


@pytest.mark.cites("(6.54)")
def test_angle_random_walk_per_root_hour() -> None:
    assert round(float(per_root_hour(N_A)), 4) == 0.0454


@pytest.mark.cites("(6.53)", "(6.54)")
def test_angle_random_walk_is_the_deviation_at_1_s() -> None:
    assert math.sqrt(modelled_variance(1.0, N_A=N_A)) == pytest.approx(7.56e-4)


@pytest.mark.cites("(6.53)", "(6.54)")
def test_standard_deviation_is_the_deviation_at_one_sample() -> None:
    """At 100 Hz the text gives 0.00752 deg/s, and white noise of N_A has 0.00756."""
    assert math.sqrt(modelled_variance(0.01, N_A=N_A)) == pytest.approx(0.00752, rel=0.006)


@pytest.mark.cites("(6.53)", "(6.55)")
def test_angle_random_walk_dominates_up_to_100_s() -> None:
    others = float(modelled_variance(100.0, R_A=R_A, K_A=K_A))
    assert others < 0.05 * float(modelled_variance(100.0, N_A=N_A))
    assert float(modelled_variance(1800.0, R_A=R_A, K_A=K_A)) > 10 * float(
        modelled_variance(1800.0, N_A=N_A)
    )


@pytest.mark.cites("(6.55)", "(6.56)")
def test_spectrum_is_flat_above_0_002_hz_and_outpaced_below_0_0005_hz() -> None:
    assert float(spectral_density(0.002)) == pytest.approx(N_A**2, rel=0.05)
    assert float(spectral_density(0.0005, n_a=0.0)) == pytest.approx(N_A**2, rel=0.1)


@pytest.mark.cites("(6.53)", "(6.56)")
@settings(deadline=None, max_examples=10)
@given(tau=st.floats(0.1, 100), white=st.floats(0, 1), walk=st.floats(0.001, 1))
def test_variance_is_the_two_sided_spectrum_seen_through_clusters(tau, white, walk) -> None:
    """The transform 4 ∫ S(f) sin⁴(πfτ)/(πfτ)² df over f > 0, in closed form beyond the last."""
    edges = np.linspace(0, 400 * math.pi, 200_001)
    u = (edges[1:] + edges[:-1]) / 2
    S = np.array(spectral_density(u / (math.pi * tau), 0.0, walk, white), dtype=float)
    inside = 4 * np.sum(S * np.sin(u) ** 4 / u**2) * edges[1] / (math.pi * tau)
    beyond = 4 * white**2 * 3 / 8 / edges[-1] / (math.pi * tau)
    expected = float(modelled_variance(tau, K_A=walk, N_A=white))
    assert float(inside + beyond) == pytest.approx(expected, rel=1e-4)
