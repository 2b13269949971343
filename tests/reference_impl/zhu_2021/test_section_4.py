"""Section 4: the road has its spectrum, the obstacle its length, the rate its distance."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.zhu_2021.section_4_1_random_road import (
    CLASS_E,
    N_0,
    N_1,
    TABLE_2,
    printed_covariances,
    random_road,
    road_spectrum,
)
from floatref_reference.zhu_2021.section_4_2_uneven_road import obstacle
from floatref_reference.zhu_2021.section_4_3_speed import calculation_rate, error


@pytest.mark.cites("(14) of Zhu", "(15) of Zhu")
@pytest.mark.parametrize("v", [5.0, 10.0, 20.0])
def test_road_has_the_spectrum_of_its_class_over_the_cut_off(v: float) -> None:
    """Means of periodograms over 40 roads of 204.8 m, between 5 n_1 and a tenth of the rate."""
    rng, N, dx = np.random.default_rng(3), 4096, 0.05
    power = np.zeros(N // 2)
    window = np.hanning(N)
    for _ in range(40):
        u = random_road(rng.normal(size=N), dx / v, v)
        power += np.abs(np.fft.rfft(window * u)[: N // 2]) ** 2 / 40
    density = 2 * dx * power / np.sum(window**2)
    n = np.arange(N // 2) / (N * dx)
    band = (n > 5 * N_1) & (n < 1 / (10 * dx))
    ratio = density[band] / [road_spectrum(n_i) for n_i in n[band]]
    assert float(np.mean(ratio)) == pytest.approx(1, abs=0.05)


@pytest.mark.cites("(15) of Zhu")
@settings(deadline=None, max_examples=20)
@given(v=st.floats(1, 40), dt=st.floats(1e-3, 1), n_1=st.floats(0.01, 1), seed=st.integers(0, 99))
def test_road_follows_its_differential_equation(v: float, dt: float, n_1: float, seed: int) -> None:
    """Without noise after the start it decays; the steps' noise keeps the variance as it is."""
    draws = np.zeros(5)
    draws[0] = 1
    u = random_road(draws, dt, v, n_1=n_1)
    variance = math.pi * N_0**2 * CLASS_E / (2 * n_1)
    assert u[0] ** 2 == pytest.approx(variance)
    assert u == pytest.approx(u[0] * np.exp(-2 * math.pi * n_1 * v * dt * np.arange(5)))
    pushed = random_road([0, 1], dt, v, n_1=n_1)[1]
    assert pushed**2 + u[1] ** 2 == pytest.approx(variance)


@pytest.mark.cites("(14) of Zhu")
def test_spectrum_falls_by_a_hundred_in_a_decade() -> None:
    assert road_spectrum(N_0) == CLASS_E
    assert road_spectrum(10 * N_0) == pytest.approx(CLASS_E / 100)


@pytest.mark.cites("(16) of Zhu")
@settings(deadline=None, max_examples=20)
@given(v=st.floats(2, 40), d=st.floats(0.2, 3), A=st.floats(-0.3, 0.3))
def test_obstacle_is_as_long_as_said_at_any_speed(v: float, d: float, A: float) -> None:
    heights = np.array([obstacle(0.8 + s / v, v, A=A, d=d) for s in np.arange(-2, 5, 0.01)])
    assert set(heights) <= {0.0, A}
    if A:
        assert np.count_nonzero(heights) * 0.01 == pytest.approx(d, abs=0.0201)


@pytest.mark.cites("section 4.3 of Zhu")
@settings(deadline=None, max_examples=20)
@given(v=st.floats(0.1, 60))
def test_a_step_is_five_centimetres_at_any_speed(v: float) -> None:
    assert v / calculation_rate(v) == pytest.approx(0.05)


@pytest.mark.parametrize("v", [0.0, -3.0, float("nan")])
def test_no_speed_no_rate(v: float) -> None:
    with pytest.raises(ValueError, match="no rate"):
        calculation_rate(v)


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999), share=st.floats(0, 2))
def test_error_is_in_per_cent_of_the_road(seed: int, share: float) -> None:
    u = np.random.default_rng(seed).normal(size=50)
    assert error((1 + share) * u, u) == pytest.approx(100 * share, abs=1e-9)
    assert error(-u, u) == pytest.approx(200)


def test_average_of_table_2() -> None:
    assert sum(TABLE_2) / 5 == pytest.approx(8.33)


def test_settings_of_the_filter_are_covariances_in_the_order_of_the_state() -> None:
    """Wheels are the least known: y_3 and y_4 among displacements, ẏ_3 and ẏ_4 among velocities."""
    Q, R, P_0 = printed_covariances()
    assert set(np.flatnonzero(np.diag(Q) == 1e-7)) == {2, 3}
    assert set(np.flatnonzero(np.diag(Q) == 1e-2)) == {7, 8}
    assert [float(np.trace(matrix)) for matrix in (R, P_0)] == pytest.approx([2.03e-2, 5e-4])
