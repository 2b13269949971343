"""Timer distortion and height-sensor reflection: limits of the time step, sign by cancellation."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_5.section_5_8 import position
from floatref_reference.chapter_5.section_5_9 import spatial_high_pass
from floatref_reference.chapter_5.section_5_10 import (
    adjusted_time_step,
    reflected_position,
    time_step_limit,
    timer_distortion,
    timer_distortion_reflection,
)

DX = 0.00508
DT_0 = 0.0014205
Pipeline = Callable[..., tuple[float, npt.NDArray[np.longdouble]]]
PIPELINES: list[Pipeline] = [timer_distortion, timer_distortion_reflection]


def drive(speed: float, n: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Draw sensor signals sampled at 1 kHz and a drive at constant speed."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=n), 0.3 + 0.01 * rng.normal(size=n), np.arange(n) * speed / 1000


@pytest.mark.cites("(5.7)")
def test_limit_is_the_one_in_print() -> None:
    assert time_step_limit(DX) == pytest.approx(DT_0, abs=1e-7)


def test_step_of_the_10_7_second_stop_is_limited() -> None:
    assert adjusted_time_step([10.7643], DT_0)[0] == pytest.approx(0.0014205, rel=1e-9)


def test_at_16_km_h_a_fiftieth_of_a_percent_is_missing() -> None:
    dt = DX / 4.470
    missing = 1 - adjusted_time_step([dt], time_step_limit(DX))[0] / dt
    assert 0.00018 < missing < 0.0002


@pytest.mark.cites("(5.8)")
@settings(deadline=None, max_examples=50)
@given(ratio=st.floats(1e-6, 1e6), dt_0=st.floats(1e-5, 1.0), beta=st.floats(2.0, 40.0))
def test_adjusted_step_stays_below_both_limits_and_reaches_them(
    ratio: float, dt_0: float, beta: float
) -> None:
    adjusted = adjusted_time_step([ratio * dt_0], dt_0, beta)[0] / dt_0
    assert 0 <= adjusted <= min(ratio, 1) * (1 + 1e-12)
    if ratio**beta < 1e-12:
        assert adjusted == pytest.approx(ratio, rel=1e-6)
    if ratio > 1e5:
        assert adjusted == pytest.approx(1, abs=1e-5)


def test_longer_steps_are_adjusted_to_longer_steps() -> None:
    dt = np.geomspace(1e-5, 1e5, 500)
    assert (np.diff(adjusted_time_step(dt, DT_0)) >= -1e-12).all()


def test_no_time_stays_no_time() -> None:
    assert adjusted_time_step([0.0], DT_0)[0] == 0


@pytest.mark.cites("(5.9)")
@settings(deadline=None, max_examples=20)
@given(heights=st.lists(st.floats(-1.0, 1.0), min_size=2, max_size=30))
def test_without_motion_and_time_the_profile_is_flat_whatever_the_height_does(
    heights: list[float],
) -> None:
    h = np.array(heights) - heights[0]
    still, dt = np.zeros(len(h)), np.full(len(h), 10.0)
    r_zp = reflected_position(still, adjusted_time_step(dt, DT_0), dt, h)
    assert r_zp - h == pytest.approx(still, abs=1e-6)


@settings(deadline=None, max_examples=20)
@given(step=st.floats(1e-4, 3.0), seed=st.integers(0, 99))
def test_unadjusted_steps_reflect_nothing(step: float, seed: int) -> None:
    v, h = np.random.default_rng(seed).normal(size=(2, 20))
    dt = np.where(np.arange(20) % 7 == 0, 0.0, step)
    assert reflected_position(v, dt, dt, h) == pytest.approx(position(v, dt), abs=1e-14)


@pytest.mark.cites("(5.9)")
@settings(deadline=None, max_examples=20)
@given(part=st.floats(0.0, 1.0), lift=st.floats(-1.0, 1.0))
def test_reflection_replaces_the_part_that_both_integrations_lose(part: float, lift: float) -> None:
    r_zp = reflected_position([0.0, 0.0], [0.0, part], [0.0, 1.0], [0.0, lift])
    assert r_zp[1] - lift == pytest.approx(-(part**2) * lift, abs=1e-15)


@pytest.mark.parametrize("pipeline", PIPELINES)
def test_at_high_speed_nothing_is_distorted(pipeline: Pipeline) -> None:
    a, h, x = drive(15.0, 400, 5)
    _, expected = spatial_high_pass(a, h, x, 1000.0, 0.015)
    _, profile = pipeline(a, h, x, 1000.0, 0.015)
    assert profile == pytest.approx(expected, abs=1e-12)


def test_crawling_vehicle_reflects_its_height_sensor() -> None:
    _, h, x = drive(0.04, 2000, 6)
    h[0] = 0.3
    _, distorted = timer_distortion(np.zeros(2000), h, x, 1000.0, 4e-4)
    _, reflected = timer_distortion_reflection(np.zeros(2000), h, x, 1000.0, 4e-4)
    assert np.std(distorted) == pytest.approx(0.01, rel=0.2)
    assert np.abs(reflected).max() < 2e-4 * np.std(distorted) * 10


def test_reflected_is_the_height_that_is_subtracted() -> None:
    x = np.arange(2000) * 4e-5
    sinking = 0.3 - 0.5 * x
    profiles = [
        pipeline(np.zeros(2000), sinking, x, 1000.0, 4e-4, lambda_c=0.02) for pipeline in PIPELINES
    ]
    distorted, reflected = (np.abs(profile).max() for _, profile in profiles)
    assert distorted > 1e-4
    assert reflected < 1e-3 * distorted


@settings(deadline=None, max_examples=10)
@given(speed=st.floats(0.2, 3.0), v_0=st.floats(4.0, 9.0))
def test_distortion_runs_both_integrations_on_the_adjusted_clock(speed: float, v_0: float) -> None:
    a, _, x = drive(speed, 150, 7)
    dx = speed / 1000
    flat = np.full(150, 0.3)
    _, profile = timer_distortion(a, flat, x, 1000.0, dx, v_0=v_0)
    _, actual = spatial_high_pass(a, flat, x, 1000.0, dx)
    factor = adjusted_time_step([0.001], time_step_limit(dx, v_0))[0] / 0.001
    assert profile == pytest.approx(actual * factor**2, rel=1e-9, abs=1e-15)
