"""Slow series of a run: means over stretches of time, whatever the clock, and their integrals."""

import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.screening import slow_series
from floatref.screening.slow_series import STEP_S, Grid, Motion, bridge, integrate, means, smooth
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

laws = settings(deadline=None, max_examples=40)
NAME = "yaw_rate"


def plain_means(times: np.ndarray, values: np.ndarray, grid: Grid) -> np.ndarray:
    found = np.full(grid.count, np.nan)
    for k in range(grid.count):
        begin, end = grid.edges[k], grid.edges[k + 1]
        inside = (times >= begin - 1e-9) & (times < end - 1e-9) & ~np.isnan(values)
        if inside.any():
            found[k] = values[inside].mean()
    return found


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    rate=st.sampled_from([7.0, 20.0, 33.3, 100.0, 1000.0]),
    start=st.floats(-2.0, 2.0),
    chunk=st.sampled_from([16, 100, 1 << 18]),
    stamped=st.booleans(),
    lost=st.floats(0.0, 0.9),
)
def test_means_are_those_of_the_samples_within(
    seed: int, rate: float, start: float, chunk: int, stamped: bool, lost: float
) -> None:
    rng = np.random.default_rng(seed)
    values = rng.standard_normal(int(4 * rate))
    values[rng.random(values.size) < lost] = np.nan
    clock = UniformClock.of(rate, start)
    times = clock.times(values.size)
    grid = Grid(-0.51, 70)
    assume(np.abs(times[:, None] - grid.edges).min() > 1e-6)
    channel = Channel.of(NAME, values, StampedClock.of(times) if stamped else clock)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(slow_series, "CHUNK", chunk)
        found = means(channel, grid)
    np.testing.assert_allclose(found, plain_means(times, values, grid), rtol=1e-12, atol=1e-12)


@laws
@given(
    level=st.floats(-10, 10),
    slope=st.floats(-1, 1),
    span=st.floats(0.05, 30.0),
    count=st.integers(3, 300),
)
def test_smoothing_keeps_a_constant_and_the_middle_of_a_line(
    level: float, slope: float, span: float, count: int
) -> None:
    flat = smooth(np.full(count, level), span)
    np.testing.assert_allclose(flat, level, atol=1e-9)
    width = 2 * (round(span / STEP_S) // 2) + 1
    times = STEP_S * np.arange(count)
    line = smooth(level + slope * times, width * STEP_S)
    inner = slice(width, count - width)
    np.testing.assert_allclose(line[inner], (level + slope * times)[inner], atol=1e-9)


@laws
@given(frequency=st.floats(0.1, 2.0), phase=st.floats(0, 6.3), at=st.integers(5, 380))
def test_an_integral_is_the_angle_and_a_gap_stays_one(
    frequency: float, phase: float, at: int
) -> None:
    omega, times = 2 * np.pi * frequency, Grid(0.0, 400).times
    rate = omega * np.cos(omega * times + phase)
    found = integrate(rate)
    expected = np.sin(omega * times + phase)
    np.testing.assert_allclose(found - found.mean(), expected - expected.mean(), atol=0.07)
    rate[at : at + 3] = np.nan
    assert np.isnan(integrate(rate)[at : at + 3]).all()
    assert not np.isnan(np.delete(integrate(rate), slice(at, at + 3))).any()


def test_a_bridge_is_a_line() -> None:
    values = np.array([np.nan, 1.0, np.nan, np.nan, 4.0, np.nan])
    np.testing.assert_array_equal(bridge(values), [1.0, 1.0, 2.0, 3.0, 4.0, 4.0])


def recorded(make: Callable[[str, np.ndarray], np.ndarray], seconds: float = 20.0) -> Recording:
    clock, slow = UniformClock.of(1000.0), UniformClock.of(100.0)
    channels = []
    for name in (*slow_series.FORCES, *slow_series.RATES, "distance"):
        own = slow if name in slow_series.RATES else clock
        times = own.times(int(seconds * float(own.rate)))
        channels.append(Channel.of(name, make(name, times), own))
    return Recording(tuple(channels))


@laws
@given(
    pitch=st.floats(-0.05, 0.05),
    roll=st.floats(-0.05, 0.05),
    turn=st.floats(-0.3, 0.3),
    acceleration=st.floats(-2.0, 2.0),
)
def test_tilts_are_what_gravity_adds_to_the_travel(
    pitch: float, roll: float, turn: float, acceleration: float
) -> None:
    """Nose down, the accelerometer reads less than the acceleration, by g sin θ, (2.17)."""

    def sensed(name: str, times: np.ndarray) -> np.ndarray:
        speed = 50.0 + acceleration * times
        return {
            "distance": 50.0 * times + acceleration * times**2 / 2,
            "longitudinal_specific_force": acceleration - 9.80665 * pitch + 0 * times,
            "lateral_specific_force": speed * turn + 9.80665 * roll,
            "yaw_rate": turn + 0 * times,
        }.get(name, 0 * times)

    motion = Motion.of(recorded(sensed), "main")
    assert motion is not None
    inner = motion.tilts[:, 3:-3]
    np.testing.assert_allclose(inner, np.broadcast_to([[roll], [pitch]], inner.shape), atol=1e-3)


@laws
@given(pitch=st.floats(-0.1, 0.1), roll=st.floats(-0.1, 0.1), turn=st.floats(-0.5, 0.5))
def test_a_turn_on_a_slope_is_no_pitch_and_no_roll(pitch: float, roll: float, turn: float) -> None:
    """About a vertical axis, at constant Euler angles: the inverse of (6.27) and (6.28)."""

    def sensed(name: str, times: np.ndarray) -> np.ndarray:
        rate = turn * np.minimum(times / 10.0, 1.0)
        return {
            "roll_rate": -np.sin(pitch) * rate,
            "pitch_rate": np.cos(pitch) * np.sin(roll) * rate,
            "yaw_rate": np.cos(pitch) * np.cos(roll) * rate,
        }.get(name, 0 * times)

    motion = Motion.of(recorded(sensed), "main")
    assert motion is not None
    tilts = np.broadcast_to([[roll], [pitch]], (2, motion.times.size))
    rolled, pitched, yawed = motion.turn(tilts)
    assert np.ptp(rolled) <= 0.02 * abs(np.ptp(yawed) * pitch) + 1e-12
    assert np.ptp(pitched) <= 0.02 * abs(np.ptp(yawed) * roll) + 1e-12
    assert abs(yawed[-1]) == pytest.approx(
        15.0 * abs(turn) * np.cos(pitch) * np.cos(roll), rel=0.01, abs=1e-9
    )


def test_a_short_run_tells_nothing() -> None:
    assert Motion.of(recorded(lambda _, times: times, 2.0), "main") is None


def test_a_long_channel_is_never_held_in_memory() -> None:
    rate, seconds = 16000.0, 250
    channel = Channel.of(NAME, np.ones(int(rate * seconds)), UniformClock.of(rate))
    tracemalloc.start()
    found = means(channel, Grid(0.0, int(seconds / STEP_S)))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < channel.values.nbytes / 8
    np.testing.assert_allclose(found, 1.0)
