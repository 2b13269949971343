"""Slips in the equations of chapter 5: the printed form fails, the mended one holds."""

import cmath
import math

import numpy as np
import pytest

from floatref_reference.chapter_5 import section_5_6, section_5_8, section_5_10

G = 9.80665
STOP = 10.7643
"""Time step across the 10.7-second stop in s, section 5.8."""
BEFORE, AFTER = -0.01865 * G, 0.00910 * G
"""Accelerometer readings at its two ends."""
DX, LIMIT = 0.00508, 0.0014205
TEN_MPH, SIXTEEN_KMH = 4.4704, 16 / 3.6


def controller_at(hertz: float) -> complex:
    """Return what the controller of figure 5.10 makes of a sine, once it has settled."""
    t = np.arange(14_000) / 1000
    v = section_5_6.controlled_velocity(np.sin(2 * np.pi * hertz * t), np.zeros(14_000), 1e-3)
    settled = t >= 13.0
    wave = np.exp(-2j * np.pi * hertz * t[settled])
    return complex(2j * np.mean(np.asarray(v, float)[settled] * wave))


def test_response_of_the_controller_5_2() -> None:
    omega, tau = 4 * math.pi, section_5_6.time_constant()
    printed = (1j * omega - tau * omega**2) / (1 + tau**2 * omega**2) / section_5_6.K_I
    found = controller_at(2.0)
    assert section_5_6.frequency_response(omega) == pytest.approx(found, abs=1e-3)
    assert abs(printed - found) > 1.9


@pytest.mark.parametrize(("hertz", "printed"), [(2.0, 1.9), (14.0, 0.3)])
def test_phase_of_the_controller_5_6(hertz: float, printed: float) -> None:
    response = section_5_6.frequency_response(2 * math.pi * hertz)
    found = math.degrees(cmath.phase(response))
    assert math.degrees(cmath.phase(controller_at(hertz))) == pytest.approx(found, abs=0.05)
    assert found / 2 == pytest.approx(printed, abs=0.05)
    assert found > 1.8 * printed


def test_first_integration_5_5() -> None:
    dt = section_5_8.time_step([0.0, STOP])
    v = section_5_8.velocity([BEFORE, AFTER], dt, -0.00319)
    assert float(v[1]) == pytest.approx(-0.50744, abs=5.5e-4)
    printed = -0.00319 + STOP * (BEFORE + AFTER)
    assert printed == pytest.approx(2 * -0.50744, abs=5e-3)


def test_second_integration_5_6() -> None:
    dt = section_5_8.time_step([0.0, STOP])
    assert float(section_5_8.position([-0.00319, -0.50744], dt)[1]) == pytest.approx(-2.748, 2e-4)
    printed = STOP * (-0.00319 - 0.50744)
    assert printed == pytest.approx(2 * -2.748, rel=2e-4)


def test_overflow_5_8() -> None:
    step = float(section_5_10.adjusted_time_step([STOP], LIMIT)[0])
    assert step == pytest.approx(LIMIT, rel=1e-9)
    ratio, beta = np.float32(STOP / LIMIT), np.float32(25)
    with np.errstate(over="ignore"):
        printed = 1 + ratio - (1 + ratio**beta) ** (1 / beta)
    assert not np.isfinite(printed)
    stable = 1 - ratio * np.expm1(np.log1p(ratio**-beta) / beta)
    assert LIMIT * float(stable) == pytest.approx(step, rel=1e-6)


def adjustment(speed: float) -> float:
    """Return by how much the adjusted time step falls short at ``speed`` in m/s, in per cent."""
    dt = DX / speed
    return 100 * (1 - float(section_5_10.adjusted_time_step([dt], LIMIT)[0]) / dt)


def test_adjustment_at_16_km_h_5_10() -> None:
    assert adjustment(TEN_MPH) == pytest.approx(0.019, abs=5e-4)
    assert adjustment(SIXTEEN_KMH) == pytest.approx(0.022, abs=5e-4)
    assert adjustment(17.2 / 3.6) == pytest.approx(0.004, abs=3e-4)


def reflected_as_printed(v: list[float], adj: list[float], dt: list[float], h: list[float]) -> list:
    r = [0.0]
    for k in range(1, len(v)):
        reflected = (1 - (adj[k] / dt[k]) ** 2) * (h[k] - h[k - 1])
        r.append(r[-1] + adj[k] * (v[k] + v[k - 1]) - reflected)
    return r


def test_sign_of_the_reflection_5_9() -> None:
    """The profiler settles by 15 mm during the stop: the profile has to stay where it was."""
    v, adj, dt, h = [0.0, 0.0], [0.0, LIMIT], [0.0, STOP], [0.300, 0.285]
    r = section_5_10.reflected_position(v, adj, dt, h)
    assert float(r[1]) - (h[1] - h[0]) == pytest.approx(0.0, abs=1e-6)
    printed = reflected_as_printed(v, adj, dt, h)
    assert printed[1] - (h[1] - h[0]) == pytest.approx(0.030, abs=1e-6)


def test_factor_of_the_reflection_5_9() -> None:
    """At speed nothing is adjusted or reflected, so that (5.9) has to be (5.6)."""
    v, dt, h = [0.1, 0.3, 0.2], [0.0, 1e-3, 1e-3], [0.30, 0.31, 0.29]
    r = section_5_10.reflected_position(v, dt, dt, h)
    assert r == pytest.approx(section_5_8.position(v, dt), abs=1e-15)
    printed = reflected_as_printed(v, dt, dt, h)
    assert printed == pytest.approx(2 * r.astype(float), abs=1e-15)
