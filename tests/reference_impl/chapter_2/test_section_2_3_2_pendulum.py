"""The inverted pendulum shows the error in order and shape (figures 2.18 to 2.22)."""

import functools

import numpy as np
import pytest

from floatref_reference.chapter_2 import section_2_3_2_pendulum as pendulum
from floatref_reference.chapter_2.section_2_1_1_iri import iri_trace
from floatref_reference.chapter_2.section_2_3_1_kinematics import body_fixed_acceleration
from floatref_reference.chapter_5.section_5_3 import basic_temporal

PULSE_START = 10.0
DT = 0.004
DX = 0.1


@functools.cache
def braking_from(v_0: float) -> pendulum.Response:
    def pulse(t: np.longdouble) -> np.longdouble:
        return pendulum.deceleration_pulse(t, t_s=PULSE_START)

    return pendulum.simulate(21.0, DT, v_0, pulse)


def profile(a_zp: np.ndarray, h: np.ndarray, response: pendulum.Response) -> np.ndarray:
    return basic_temporal(a_zp, h, response.x, 1 / DT, DX)[1]


def worst_section(z: np.ndarray) -> float:
    """Return the highest IRI of any 160.9 m, m/km."""
    points = round(160.9 / DX)
    total = np.concatenate([[0], np.cumsum(np.abs(iri_trace(z, DX)))])
    return float(((total[points:] - total[:-points]) / points).max())


def measured(response: pendulum.Response) -> np.ndarray:
    level = np.zeros(len(response.t))
    a_w = np.array([response.a_xp_w, level, response.a_zp_w])
    return body_fixed_acceleration(a_w, response.theta, level)[2]


@pytest.mark.cites("(2.26)")
def test_pulse_takes_22_to_20_metres_per_second() -> None:
    t = np.arange(0, 4, 0.001)
    push = [pendulum.deceleration_pulse(np.longdouble(t_k)) for t_k in t]
    assert min(push) == pytest.approx(-0.4 * 9.80665)
    assert 22 + 0.001 * float(sum(push)) == pytest.approx(20, abs=0.05)


def test_trolley_at_constant_speed_stays_upright() -> None:
    still = pendulum.simulate(1.0, 0.01, 22.0, lambda t: np.longdouble(0))
    assert not still.theta.any()
    assert float(still.x[-1]) == pytest.approx(22.0)
    assert still.h_b == pytest.approx(np.full(101, 0.3))


@pytest.mark.cites("(2.22)")
def test_steady_braking_settles_where_the_moments_balance() -> None:
    settled = pendulum.simulate(5.0, 0.005, 50.0, lambda t: np.longdouble(-3))
    vehicle, theta = pendulum.HOST_VEHICLE, settled.theta[-1]
    weight = vehicle.m * vehicle.L_cm * (9.80665 * np.sin(theta) + 3 * np.cos(theta))
    assert theta > 0
    assert weight == pytest.approx(vehicle.k_r * theta, rel=1e-6)


@pytest.mark.cites("(2.23) to (2.25)")
def test_true_vertical_acceleration_is_the_second_derivative_of_true_height() -> None:
    response = braking_from(22.0)
    curvature = np.diff(response.h_w, 2) / DT**2
    assert response.a_zp_w[1:-1] == pytest.approx(curvature, abs=0.02)
    assert np.abs(curvature).max() > 1


def test_accelerometer_error_is_the_projected_longitudinal_acceleration() -> None:
    response = braking_from(22.0)
    error = measured(response) - response.a_zp_w
    cosine = (response.a_zp_w + 9.80665) * (np.cos(response.theta) - 1)
    projected = response.a_xp_w * np.sin(response.theta)
    assert error == pytest.approx(projected + cosine, abs=1e-15)
    assert float(error.mean()) < 0


def test_body_dives_by_about_50_mm() -> None:
    response = braking_from(22.0)
    assert float(response.h_b[0] - response.h_b.min()) == pytest.approx(0.05, abs=0.01)


def test_misalignment_leaves_a_bump_of_over_5_mm_and_0_038_m_per_km() -> None:
    response = braking_from(22.0)
    z = profile(measured(response), response.h_b, response)
    inner = slice(round(60 / DX), len(z) - round(60 / DX))
    top = int(z[inner].argmax()) + inner.start
    assert 0.005 < float(z[inner].max()) < 0.010
    assert float(response.x[round(PULSE_START / DT)]) < top * DX < 11.5 * 22
    assert worst_section(z) == pytest.approx(0.038, rel=0.3)


def test_ideal_sensors_leave_the_profile_flat() -> None:
    response = braking_from(22.0)
    z = profile(response.a_zp_w, response.h_w, response)
    assert float(np.abs(z).max()) < 1e-5
    assert worst_section(z) < 1e-3


@pytest.mark.slow
def test_slower_vehicles_suffer_more() -> None:
    slow, fast = braking_from(12.0), braking_from(22.0)
    roughness = [worst_section(profile(measured(r), r.h_b, r)) for r in (slow, fast)]
    assert roughness[0] > 2 * roughness[1]
