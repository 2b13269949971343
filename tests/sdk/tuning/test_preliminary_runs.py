"""Runs are told apart by their encoder alone, whatever its steps."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.travel import Travel
from floatref.tuning.preliminary_runs import RECOMMENDED, Kind, drive_of
from floatref.values.channels import STANDARD_GRAVITY as G
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

RATE_HZ = 200.0
encoders = st.sampled_from([0.0003, 0.002, 0.02])


def travel(speed: np.ndarray, step_m: float, start_m: float = 0.0) -> Travel:
    distance = start_m + step_m * np.floor(np.cumsum(speed) / RATE_HZ / step_m)
    return Travel.of(Recording((Channel.of("distance", distance, UniformClock.of(RATE_HZ)),)))


def held(speed_mps: float, seconds: float) -> np.ndarray:
    return np.full(round(seconds * RATE_HZ), speed_mps)


def ramp(begin_mps: float, end_mps: float, rate_g: float) -> np.ndarray:
    seconds = abs(end_mps - begin_mps) / (rate_g * G)
    return np.linspace(begin_mps, end_mps, round(seconds * RATE_HZ))


@settings(deadline=None, max_examples=30)
@given(st.floats(3.0, 120.0), encoders, st.floats(-0.1, 0.1))
def test_a_constant_speed_is_low_high_or_between(
    speed_kmh: float, step_m: float, sway: float
) -> None:
    times = np.arange(round(150.0 * 3.6 / speed_kmh * RATE_HZ)) / RATE_HZ
    speed = speed_kmh / 3.6 * (1.0 + sway * np.sin(0.1 * times))
    found = drive_of(travel(speed, step_m), 20.0, 120.0)
    assert found.speed_kmh == pytest.approx(speed_kmh, rel=0.12)
    assert (found.deceleration_g, found.stop_s, found.critical_m) == (0.0, 0.0, ())
    mean = found.speed_kmh
    expected = Kind.LOW if mean <= 12.0 else Kind.HIGH if mean >= 60.0 else Kind.CONSTANT
    assert found.kind is expected


@settings(deadline=None, max_examples=30)
@given(st.sampled_from([0.15, 0.2, 0.3, 0.4, 0.8]), st.floats(25.0, 35.0), encoders)
def test_a_brake_is_light_or_heavy_and_released_where_it_is(
    rate_g: float, down_to_kmh: float, step_m: float
) -> None:
    speed = [held(20.0, 4.0), ramp(20.0, down_to_kmh / 3.6, rate_g), held(down_to_kmh / 3.6, 12.0)]
    released = float(np.concatenate(speed[:2]).sum()) / RATE_HZ
    found = drive_of(travel(np.concatenate(speed), step_m, 1000.0), 1010.0, 1050.0 + released)
    assert found.kind is (Kind.LIGHT if rate_g <= 0.2 else Kind.HEAVY)
    # The speed is smoothed over half a second, which takes some of a short, hard brake.
    assert 0.8 * rate_g < found.deceleration_g < 1.05 * rate_g
    (place,) = found.critical_m
    assert place == pytest.approx(1000.0 + released, abs=5.0)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.5, 12.0), st.sampled_from([0.2, 0.33]), encoders)
def test_a_stop_is_short_or_long_and_lies_where_it_is(
    dwell_s: float, rate_g: float, step_m: float
) -> None:
    down = [held(15.0, 3.0), ramp(15.0, 0.0, rate_g)]
    speed = [*down, held(0.0, dwell_s), ramp(0.0, 12.0, 0.2), held(12.0, 5.0)]
    place = float(np.concatenate(down).sum()) / RATE_HZ
    found = drive_of(travel(np.concatenate(speed), step_m), 20.0, place + 50.0)
    assert found.stop_s == pytest.approx(dwell_s, abs=0.6)
    assert found.kind is (Kind.LONG if found.stop_s >= 3.5 else Kind.SHORT)
    assert found.critical_m == pytest.approx([place], abs=0.1)
    assert found.deceleration_g > 0.7 * rate_g


def test_where_there_is_a_stop_it_alone_is_critical() -> None:
    down = [held(20.0, 3.0), ramp(20.0, 12.0, 0.4), held(12.0, 5.0), ramp(12.0, 0.0, 0.2)]
    place = float(np.concatenate(down).sum()) / RATE_HZ
    speed = np.concatenate([*down, held(0.0, 5.0), ramp(0.0, 10.0, 0.2), held(10.0, 4.0)])
    found = drive_of(travel(speed, 0.0003), 20.0, place + 20.0)
    assert found.kind is Kind.LONG
    assert found.critical_m == pytest.approx([place], abs=0.1)
    assert found.deceleration_g == pytest.approx(0.4, rel=0.1)


def test_what_happens_elsewhere_does_not_count() -> None:
    speed = [held(20.0, 10.0), ramp(20.0, 0.0, 0.3), held(0.0, 4.0)]
    found = drive_of(travel(np.concatenate(speed), 0.0003), 10.0, 190.0)
    assert (found.kind, found.critical_m) == (Kind.HIGH, ())


def test_a_run_that_gathers_speed_is_neither_constant_nor_braked() -> None:
    assert drive_of(travel(ramp(5.0, 20.0, 0.1), 0.0003), 20.0, 150.0).kind is Kind.OTHER


def test_six_kinds_are_recommended() -> None:
    assert set(RECOMMENDED) == set(Kind) - {Kind.CONSTANT, Kind.OTHER}
