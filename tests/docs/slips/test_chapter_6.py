"""Slips in the equations of chapter 6: the printed form fails, the mended one holds."""

import math

import numpy as np
import pytest

from floatref_reference.chapter_6.section_6_1_1_linear import measurement_update
from floatref_reference.chapter_6.section_6_1_2_extended import predicted_covariance
from floatref_reference.chapter_6.section_6_2_frames import direction_cosines
from floatref_reference.chapter_6.section_6_3_2_inertial_sensors import (
    measured_acceleration,
    measured_rate,
    vertical_acceleration,
)
from floatref_reference.chapter_6.section_6_3_4_gps_height import measured_height
from floatref_reference.chapter_6.section_6_3_5_gps_attitude import (
    pitch_inclination,
    roll_inclination,
)
from floatref_reference.chapter_6.section_6_3_6_system import f
from floatref_reference.chapter_6.section_6_4_1_allan import modelled_variance
from floatref_reference.chapter_6.section_6_4_2_gyroscopes import N_A, spectral_density
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS, SIGMA_PROCESS
from floatref_reference.chapter_6.section_6_5_implementation import profile
from floatref_reference.chapter_6.section_6_6_3_reflection import height_reading, reflected_height

G = 9.80665
THETA, PHI = 0.05, 0.03


def test_shape_of_the_observation_matrix_6_1() -> None:
    ns, nm = 7, 4
    x, P, y, R = np.zeros(ns), np.eye(ns), np.ones(nm), np.eye(nm)
    with pytest.raises(ValueError, match="mismatch"):
        measurement_update(x, P, y, np.ones((ns, nm)), R)
    assert measurement_update(x, P, y, np.eye(nm, ns), R)[0][:nm] == pytest.approx(y / 2)


def test_covariance_of_which_step_6_10() -> None:
    """A walk adds its variance at each step; nothing is equal to itself and more."""
    one, P = np.eye(1), np.array([[3.0]])
    for k in range(1, 5):
        P = predicted_covariance(P, one, one, 0.25 * one)
        assert float(P[0, 0]) == pytest.approx(3 + 0.25 * k)
        printed = P - predicted_covariance(P, one, one, 0.25 * one)
        assert float(printed[0, 0]) == pytest.approx(-0.25)


def test_sign_of_the_drift_6_37() -> None:
    """Biases of (6.32) as they are, or with the sign turned over."""
    C_nb, bias = direction_cosines(0.4, THETA, PHI), np.array([0.02, -0.01, 0.03])
    u_a = measured_acceleration([-3.0, 0.5, 0.7], C_nb, bias)
    vertical = float((C_nb @ bias)[2])
    assert vertical_acceleration(u_a, THETA, PHI, -vertical) == pytest.approx(0.7)
    printed = vertical_acceleration(u_a, THETA, PHI, vertical)
    assert printed - 0.7 == pytest.approx(2 * vertical)


def test_sign_of_the_drift_of_the_gyroscopes_6_30() -> None:
    """What a gyroscope reads too much is -δ in (6.30), and (6.47) gives it back."""
    reading = measured_rate([0.1, 0.0, 0.0], [-0.02, 0.0, 0.0])
    assert reading[0] == pytest.approx(0.12)
    turned = {
        delta: f([0, 0, 0, 0, 0, delta, 0], [0, 0, G, *reading], 1.0)[3] for delta in (-0.02, 0.02)
    }
    assert turned[-0.02] == pytest.approx(0.1)
    assert turned[0.02] == pytest.approx(0.14)


@pytest.mark.parametrize(("rover", "axis"), [([1, 0, 0], "pitch"), ([0, -1, 0], "roll")])
def test_inclination_with_the_rover_above_6_43(rover: list[int], axis: str) -> None:
    """The rovers stand forward and to the right of the master antenna."""
    printed = math.asin((direction_cosines(0.4, THETA, PHI) @ np.array(rover))[2])
    meant = {"pitch": pitch_inclination(THETA), "roll": roll_inclination(THETA, PHI)}[axis]
    assert printed == pytest.approx(-meant)
    assert abs(meant) > 0.02


def test_one_sided_spectrum_6_56() -> None:
    """The variance at 100 Hz is the density times 50 Hz if one-sided, times 100 Hz if two-sided."""
    density = float(spectral_density(10.0))
    assert density == pytest.approx(float(modelled_variance(0.01, N_A=N_A)) * 0.01)
    assert math.sqrt(density * 100) == pytest.approx(0.00752, rel=0.006)
    assert math.sqrt(density * 50) == pytest.approx(0.00535, abs=2e-5)


def corner(noise: float, order: int) -> float:
    """Return where a GPS height of density σ_rz √(0.05 s) takes over from noise integrated."""
    return float((noise / (SIGMA_GPS[0] * math.sqrt(0.05))) ** (1 / order))


def test_units_of_the_random_walks_table_6_1() -> None:
    """Acceleration noise and its walk were tuned against each other, so both have to matter."""
    dt = 1 / 16_000
    white = corner(SIGMA_PROCESS[0] * math.sqrt(dt), 2)
    assert corner(5e-8 / math.sqrt(dt), 3) == pytest.approx(white, rel=0.05)
    as_density, times_dt = corner(5e-8, 3), corner(5e-8 * dt / math.sqrt(dt), 3)
    assert as_density < white / 4
    assert times_dt < white / 20


def test_sign_of_the_reflection_6_58() -> None:
    """While the vehicle settles by 18.4 mm, GPS falls by 17.5 mm, and the ground stays."""
    h_ref, y_ref = 0.3, 120.0
    h = h_ref - 0.0184
    assert reflected_height(h, y_ref, h_ref) - y_ref == pytest.approx(-0.0175, abs=1e-3)
    printed = y_ref + (h_ref - h)
    assert printed - y_ref == pytest.approx(0.0175, abs=1e-3)
    ground = profile([y_ref, reflected_height(h, y_ref, h_ref), printed], [h_ref, h, h])
    assert ground[1] - ground[0] == pytest.approx(0, abs=1e-12)
    assert ground[2] - ground[0] == pytest.approx(2 * 0.0184)


def test_sign_of_the_references_6_59() -> None:
    """At the references themselves the height sensor has to read h_ref."""
    y_ref, h_ref, lever = 120.0, 0.3, [0.0, -0.6, 2.0]
    r_zp = y_ref - measured_height(0.0, THETA, PHI, lever)
    x = [r_zp, 0, THETA, PHI, 0, 0, 0]
    assert height_reading(x, lever, y_ref, h_ref) == pytest.approx(h_ref)
    printed = measured_height(r_zp, THETA, PHI, lever) + y_ref + h_ref
    assert printed == pytest.approx(2 * y_ref + h_ref)
