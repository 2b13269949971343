"""At a stop the height sensor says how the vehicle moves, and the profile stays where it is."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_3_4_gps_height import measured_height
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS, densities, per_step
from floatref_reference.chapter_6.section_6_5_implementation import (
    kalman_filter,
    profile,
    rts_smoother,
)
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations
from floatref_reference.chapter_6.section_6_6_3_reflection import (
    SIGMA_H,
    V_0,
    height_reading,
    height_sensor_reflection,
    reflected_height,
    stopped,
    stopped_variances,
)

X, DT, G = np.zeros(7), 1 / 200, 9.80665
STOP = slice(100, 240)
STEPS = np.arange(0, 300, 10)


@pytest.fixture(scope="module")
def speed() -> npt.NDArray[np.float64]:
    v = np.full(300, 5.0)
    v[STOP] = 0.0
    return v


@pytest.mark.cites("(6.58)", "(6.59)")
@settings(deadline=None, max_examples=30)
@given(
    angles=st.tuples(*[st.floats(-0.5, 0.5)] * 2),
    lever=st.tuples(*[st.floats(-3, 3)] * 3),
    r_zp=st.floats(-5, 5),
    references=st.tuples(st.floats(-5, 5), st.floats(0, 1)),
)
def test_height_reading_reflects_the_height_of_the_antenna(angles, lever, r_zp, references) -> None:
    h = height_reading([r_zp, 0, *angles, 0, 0, 0], lever, *references)
    antenna = measured_height(r_zp, *angles, lever)
    assert reflected_height(h, *references) == pytest.approx(antenna, abs=1e-12)


@pytest.mark.cites("(6.58)")
def test_stop_of_10_7_s() -> None:
    """GPS fell by 17.5 mm while the range to the road shrank by 18.4 mm (section 6.6.1)."""
    assert reflected_height(0.3 - 0.0184, 120.0, 0.3) - 120 == pytest.approx(-0.0175, abs=1e-3)


@pytest.mark.cites("(6.60)", "(6.61)")
def test_uncertainty_while_stopped() -> None:
    deviations = np.sqrt(stopped_variances())
    assert deviations / SIGMA_GPS == pytest.approx(np.array([0.0015 / 0.012, 10, 10, 1]))


def test_stopped_is_below_0_16_km_h() -> None:
    assert stopped([0.15 / 3.6, 0.17 / 3.6]).tolist() == [True, False]
    assert stopped([V_0]).tolist() == [False]


@pytest.mark.cites("(6.58)", "(6.60)", "(6.61)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999), share=st.floats(0.05, 1.0))
def test_what_is_observed_when(speed, seed: int, share: float) -> None:
    rng = np.random.default_rng(seed)
    h, fresh, y = (
        rng.uniform(0.2, 0.4, 300),
        rng.uniform(size=300) < share,
        rng.normal(size=(30, 4)),
    )
    fresh[0] = True
    observe = height_sensor_reflection(STEPS, y, h, fresh, speed)
    h_ref = h[:100][fresh[:100]][-1]
    for k in range(300):
        found = observe(k, X)
        at_rest = 100 <= k < 240
        assert (found is None) == ((not fresh[k]) if at_rest else k % 10 > 0)
        if found is not None and at_rest:
            assert found[0] == pytest.approx(np.array([y[9, 0] + h[k] - h_ref, y[9, 1], 0, 0]))
            assert found[1][0] == pytest.approx(SIGMA_H**2)
        elif found is not None:
            assert (found[0] == y[k // 10]).all()
            assert found[1] == pytest.approx(np.array(SIGMA_GPS) ** 2)


@pytest.mark.cites("(6.58)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999), again=st.integers(101, 239))
def test_each_stop_counts_from_its_own_references(speed, seed: int, again: int) -> None:
    """A crawl of one step ends the stop: the last readings before it begins again count."""
    rng = np.random.default_rng(seed)
    h, y, v = rng.uniform(0.2, 0.4, 300), rng.normal(size=(30, 4)), speed.copy()
    v[again - 1] = 1.0
    observe = height_sensor_reflection(STEPS, y, h, np.ones(300, bool), v)
    expected = y[(again - 1) // 10, 0] + h[again] - h[again - 1]
    assert observe(again, X)[0][0] == pytest.approx(expected)


@pytest.mark.cites("(6.58)")
def test_start_at_a_stop_counts_from_the_first_readings() -> None:
    h, v = 0.3 + 0.001 * np.arange(50.0), np.zeros(50)
    y = np.arange(16.0).reshape(4, 4)
    observe = height_sensor_reflection([5, 15, 25, 35], y, h, np.arange(50) % 2 == 0, v)
    assert [k for k in range(50) if observe(k, X)] == [5, *range(6, 50, 2)]
    assert (observe(5, X)[0] == y[0]).all()
    assert observe(20, X)[0] == pytest.approx(np.array([0.016, 1, 0, 0]))


@pytest.mark.cites("(6.58)")
def test_readings_that_are_missing_are_not_references(speed) -> None:
    y = np.arange(120.0).reshape(30, 4)
    y[9], y[8, 0] = np.nan, np.nan
    h = np.full(300, 0.3)
    h[99], h[150] = np.nan, np.nan
    observe = height_sensor_reflection(STEPS, y, h, np.ones(300, bool), speed)
    assert observe(100, X)[0] == pytest.approx(np.array([y[7, 0], y[8, 1], 0, 0]))
    assert observe(150, X) is None


def settling() -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return acceleration and height of a level vehicle that sinks by 18 mm when it has stopped."""
    t = np.linspace(0, 1, 120)
    a, v, r = np.zeros(300), np.zeros(300), np.zeros(300)
    a[110:230] = np.sin(2 * np.pi * t) * -0.018 * 2 * np.pi / 0.6**2
    for k in range(1, 300):
        v[k] = v[k - 1] + a[k - 1] * DT
        r[k] = r[k - 1] + v[k - 1] * DT + a[k - 1] * DT**2 / 2
    return a, r


def smoothed(a: npt.NDArray[np.float64], observe) -> npt.NDArray[np.float64]:
    u = np.zeros((300, 6))
    u[:, 2] = G + a
    P_0 = np.diag([0.1, 0.1, 0.01, 0.01, 0.01, 0.001, 0.001]) ** 2
    run = kalman_filter(u, DT, X, P_0, per_step(densities(), DT), observe, [0.5, -0.6, 2.0])
    return rts_smoother(run)[0][:, 0]


@pytest.mark.cites("(6.57)", "(6.58)", "(6.59)", "(6.60)", "(6.61)")
def test_drift_of_gps_at_a_stop_does_not_reach_the_profile(speed) -> None:
    """Over flat ground, GPS drifts by 40 mm while the vehicle stands and settles."""
    a, r = settling()
    assert r[-1] == pytest.approx(-0.018, abs=1e-3)
    drift = np.interp(np.arange(300), [100, 240], [0, 0.04])
    y = np.transpose([2 + r + drift, np.gradient(r, DT), np.zeros(300), np.zeros(300)])[STEPS]
    h = 0.3 + r
    gps = profile(smoothed(a, gps_observations(STEPS, y)), h)
    reflect = height_sensor_reflection(STEPS, y, h, np.arange(300) % 5 == 0, speed)
    reflected = profile(smoothed(a, reflect), h)
    assert np.ptp(reflected[STOP]) < SIGMA_H
    assert np.ptp(gps[STOP]) > 1e-2
