"""Filter and smoother return the truth where there is no noise, and keep what they promise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_c.process_model import matrix_a, matrix_q, matrix_w
from floatref_reference.chapter_6.section_6_3_6_system import f, h
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS, densities, per_step
from floatref_reference.chapter_6.section_6_5_implementation import (
    Run,
    kalman_filter,
    most_recent,
    profile,
    rts_smoother,
    spatial_profile,
    time_update,
)
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations

P_0 = np.diag([1.0, 0.5, 0.05, 0.05, 0.1, 0.01, 0.01]) ** 2


def filtered(drive, x_0, sigma_gps=SIGMA_GPS, noise=1.0, **options) -> Run:
    sigma = noise * per_step(densities(), drive.dt)
    gps = gps_observations(np.arange(0, 300, 10), drive.y[::10], sigma_gps)
    return kalman_filter(drive.u, drive.dt, x_0, P_0, sigma, gps, drive.lever, **options)


@pytest.mark.cites("(6.9)", "(6.13)", "(6.17)", "(6.47)", "(6.48)")
def test_known_start_and_no_noise_is_the_truth(drive) -> None:
    run = filtered(drive, drive.x[0])
    assert run.x == pytest.approx(drive.x, abs=1e-11)
    assert rts_smoother(run)[0] == pytest.approx(drive.x, abs=1e-9)


@pytest.mark.cites("(6.17)", "(6.48)")
def test_smoother_finds_an_unknown_start_and_the_drift_of_the_sensors(drive) -> None:
    """With exact readings and sensors, what is left is the curvature of the first correction."""
    x_0 = drive.x[0] + np.array([0.3, -0.2, 0.02, -0.02, 0.05, 0.004, -0.004])
    run = filtered(drive, x_0, sigma_gps=(1e-5, 1e-5, 1e-5, 1e-5), noise=1e-2)
    x_smoothed, _ = rts_smoother(run)
    error = np.abs(x_smoothed - drive.x).max(axis=0)
    assert (error < [1e-4, 1e-4, 1e-5, 1e-5, 1e-3, 1e-4, 1e-4]).all()
    assert (np.abs(run.x - drive.x).max(axis=0)[4:] > 100 * error[4:]).any()


@pytest.mark.cites("(6.19)", "(6.20)")
def test_stored_predictions_are_those_that_can_be_repeated(drive) -> None:
    run = filtered(drive, drive.x[0] + 0.01)
    for k in range(0, 299, 13):
        A, W = matrix_a(run.x[k], run.u[k], run.dt), matrix_w(run.x[k], run.dt)
        noise = W @ matrix_q(run.sigma[k]) @ W.T
        assert run.x_prior[k + 1] == pytest.approx(f(run.x[k], run.u[k], run.dt), abs=1e-15)
        assert run.P_prior[k + 1] == pytest.approx(A @ run.P[k] @ A.T + noise, rel=1e-12)


@pytest.mark.cites("(6.9)", "(6.10)", "(6.16)")
def test_between_readings_only_time_passes(drive) -> None:
    run = filtered(drive, drive.x[0] + 0.01)
    for k in range(1, 300):
        x, P = time_update(run.x[k - 1], run.P[k - 1], run.u[k - 1], run.dt, run.sigma[k - 1])
        assert (run.x_prior[k] == x).all()
        assert (run.P_prior[k] == P).all()
        corrected = (run.P[k] != run.P_prior[k]).any()
        assert corrected == (k % 10 == 0)
    assert (run.x_prior[0] == drive.x[0] + 0.01).all()
    assert (run.P_prior[0] == P_0).all()


@pytest.mark.cites("(6.17)", "(6.22)")
def test_what_comes_afterwards_only_helps(drive) -> None:
    run = filtered(drive, drive.x[0] + 0.01)
    x_smoothed, P_smoothed = rts_smoother(run)
    assert (x_smoothed[-1] == run.x[-1]).all()
    assert (P_smoothed[-1] == run.P[-1]).all()
    scale = np.sqrt(np.diag(P_0))
    for k in range(0, 300, 13):
        gained = (run.P[k] - P_smoothed[k]) / np.outer(scale, scale)
        assert np.linalg.eigvalsh((gained + gained.T) / 2).min() > -1e-9


@pytest.mark.cites("(6.48)")
def test_inputs_of_the_measurement_can_be_others(drive) -> None:
    """Readings taken while the body turned faster than the process was told."""
    u_at = drive.u + np.array([0, 0, 0, 0.2, -0.3, 0.1])
    y = np.array([h(x, u, drive.lever) for x, u in zip(drive.x, u_at, strict=True)])
    run = filtered(drive._replace(y=y), drive.x[0], u_at=u_at)
    assert run.x == pytest.approx(drive.x, abs=1e-11)
    assert np.abs(filtered(drive._replace(y=y), drive.x[0]).x - drive.x).max() > 1e-3


def test_state_that_is_known_exactly_cannot_be_smoothed(drive) -> None:
    run = kalman_filter(
        drive.u, drive.dt, drive.x[0], np.zeros((7, 7)), np.zeros(7), lambda k, x: None, drive.lever
    )
    with pytest.raises(np.linalg.LinAlgError):
        rts_smoother(run)


def test_observer_cannot_change_the_state_that_it_sees(drive) -> None:
    def meddler(k: int, x: np.ndarray) -> None:
        x[:] = np.nan

    run = kalman_filter(drive.u, drive.dt, drive.x[0], P_0, np.ones(7), meddler, drive.lever)
    assert np.isfinite(run.x).all()


@settings(deadline=None, max_examples=20)
@given(steps=st.sets(st.integers(0, 30), min_size=1, max_size=8), N=st.integers(1, 30))
def test_most_recent_reading_is_held(steps: set[int], N: int) -> None:
    """Readings that tell their own step; before the first, the first."""
    ordered = sorted(steps)
    held = most_recent(ordered, ordered, N)
    for k in range(N):
        assert held[k] == max((s for s in ordered if s <= k), default=ordered[0])
    twice = most_recent(ordered, np.transpose([ordered, ordered]), N)
    assert twice.tolist() == [[value, value] for value in held]


@pytest.mark.cites("(6.57)")
def test_profile_is_the_road_however_the_reference_moves() -> None:
    rng = np.random.default_rng(1)
    r_zp, road = 120 + rng.normal(size=50), 0.01 * rng.normal(size=50)
    elevation = profile(r_zp, r_zp - road)
    assert elevation == pytest.approx(road, abs=1e-12)
    points = spatial_profile(elevation, np.arange(50) * 0.25, 0.5)
    assert points.astype(float) == pytest.approx(road[::2], abs=1e-12)
