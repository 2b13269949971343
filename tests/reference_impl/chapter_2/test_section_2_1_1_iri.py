"""The Golden Car and the IRI."""

import math
from importlib.resources import files

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_2 import section_2_1_1_golden_car as golden_car
from floatref_reference.chapter_2 import section_2_1_1_iri as section
from floatref_reference.chapter_2.section_2_1_4_waveband import INDICES, h_suspension_stroke

MEASURED = files("floatref_conformance.proving_ground") / "data/sroubek/profile_1.txt"


def test_measured_road_has_its_published_iri() -> None:
    z = np.loadtxt(MEASURED)[:, 1]
    assert len(z) == 2177
    assert section.iri(z, 0.25) == pytest.approx(3.334, rel=1e-3)


@settings(deadline=None, max_examples=15)
@given(grade=st.floats(-0.2, 0.2), dx=st.sampled_from([0.01, 0.05, 0.25, 0.6]))
def test_steady_grade_has_no_roughness(grade: float, dx: float) -> None:
    z = 100 + grade * dx * np.arange(80)
    assert section.iri(z, dx) < 1e-10


@settings(deadline=None, max_examples=10)
@given(factor=st.floats(-10.0, 10.0), seed=st.integers(0, 99))
def test_iri_grows_with_the_amplitude(factor: float, seed: int) -> None:
    z = np.random.default_rng(seed).normal(size=200).cumsum() * 1e-3
    expected = abs(factor) * section.iri(z, 0.1)
    assert section.iri(factor * z, 0.1) == pytest.approx(expected, rel=1e-10, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("wavelength", [1.0, 2.5, 10.0, 25.0])
def test_sinusoid_comes_out_with_the_gain_of_2_7_and_2_9(wavelength: float) -> None:
    dx, nu = 0.01, 1 / wavelength
    z = 1e-3 * np.sin(2 * np.pi * nu * dx * np.arange(25_001))
    settled = np.asarray(section.iri_trace(z, dx)[-5000:], float)
    gain = abs(h_suspension_stroke(nu, INDICES["IRI"])) * math.sin(math.pi * 0.25 * nu)
    gain /= math.pi * 0.25 * nu
    expected = 1000 * 2 * math.pi * nu * 1e-3 * gain
    assert math.sqrt(2 * np.mean(settled**2)) == pytest.approx(expected, rel=1e-3)


def test_slope_profile_of_a_parabola_is_a_straight_line() -> None:
    x = np.arange(20) * 0.5
    assert section.slope(x**2, 0.5) == pytest.approx(2 * x[:-1] + 0.5, abs=1e-14)


@pytest.mark.parametrize(("z", "dx"), [([1.0], 0.1), ([1.0, 2.0], 0.0)])
def test_profile_without_a_slope_is_refused(z: list[float], dx: float) -> None:
    with pytest.raises(ValueError, match="two points"):
        section.slope(z, dx)


@settings(deadline=None, max_examples=20)
@given(dx=st.floats(0.02, 0.16), seed=st.integers(0, 99))
def test_moving_average_of_slopes_is_the_secant_over_the_window(dx: float, seed: int) -> None:
    z = np.random.default_rng(seed).normal(size=40)
    n = round(0.25 / dx)
    smoothed = section.moving_average(section.slope(z, dx), dx)
    for i in range(39):
        last = min(i + n, 39)
        assert float(smoothed[i]) == pytest.approx((z[last] - z[i]) / ((last - i) * dx), abs=1e-9)


@pytest.mark.parametrize("dx", [0.25, 0.3, 0.2])
def test_moving_average_is_off_at_coarse_intervals(dx: float) -> None:
    s = np.random.default_rng(1).normal(size=20)
    assert (section.moving_average(s, dx) == s).all()


def test_car_starts_on_the_mean_slope_of_11_m() -> None:
    z = (0.25 * np.arange(100)) ** 2
    assert section.start_slope(z, 0.25) == pytest.approx(11.0)
    assert section.start_slope([0.0, 0.1, 0.3], 0.25) == pytest.approx(0.6)


def test_transition_over_two_intervals_is_two_transitions() -> None:
    S, P = golden_car.state_transition(0.01)
    twice, held = golden_car.state_transition(0.02)
    assert twice == pytest.approx(S @ S, abs=1e-15)
    assert held == pytest.approx(S @ P + P, abs=1e-15)


def test_car_riding_a_grade_stays_as_it_is() -> None:
    S, P = golden_car.state_transition(0.01)
    riding = np.array([1, 0, 1, 0])
    assert S @ riding + P == pytest.approx(riding, abs=1e-15)


@settings(deadline=None, max_examples=20)
@given(angle=st.floats(-20.0, 20.0))
def test_matrix_exponential_of_a_spin_is_a_rotation(angle: float) -> None:
    M = np.array([[0, -angle], [angle, 0]], dtype=np.longdouble)
    c, s = math.cos(angle), math.sin(angle)
    expected = np.array([[c, -s], [s, c]])
    assert golden_car.matrix_exponential(M) == pytest.approx(expected, abs=1e-13)
