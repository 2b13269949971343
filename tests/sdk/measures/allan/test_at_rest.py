"""The stretch of a channel that an Allan deviation can use, whatever is missing or uneven."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.allan.at_rest import channel_noise, sound_stretch
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel

FEW = settings(deadline=None, max_examples=40)


def gyro(values: np.ndarray, rate_hz: float = 100.0, start_s: float = 0.0) -> Channel:
    return Channel.of("roll_rate", values, UniformClock.of(rate_hz, start_s))


def stamped(values: np.ndarray, times: np.ndarray) -> Channel:
    return Channel.of("roll_rate", values, StampedClock.of(times))


def white(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=count)


def longest_run(sound: np.ndarray) -> tuple[int, int]:
    """First index and length of the first longest run of true, by looking at every sample."""
    best, run = (0, 0), 0
    for k, good in enumerate(sound):
        run = run + 1 if good else 0
        if run > best[1]:
            best = (k - run + 1, run)
    return best


@FEW
@given(count=st.integers(70, 400), lost=st.sets(st.integers(0, 399), max_size=4))
def test_the_longest_stretch_without_missing_samples_is_used(count: int, lost: set[int]) -> None:
    x = white(count)
    x[[k for k in lost if k < count]] = np.nan
    first, length = longest_run(~np.isnan(x))
    if length < 64:
        with pytest.raises(InputError, match=f"roll_rate: of {count} samples no 64 in a row"):
            sound_stretch(gyro(x))
        return
    found = sound_stretch(gyro(x))
    assert (found.first, found.count, found.left_out) == (first, length, count - length)
    assert found.interval_s == pytest.approx(0.01)


@FEW
@given(
    count=st.integers(150, 400),
    holes=st.sets(st.integers(1, 399), max_size=2),
    lost=st.integers(0, 399),
    jitter=st.floats(0.0, 0.1),
)
def test_holes_in_time_stamps_are_like_missing_samples(
    count: int, holes: set[int], lost: int, jitter: float
) -> None:
    steps = np.full(count, 0.05)
    steps[[k for k in holes if k < count]] += 0.05
    times = 1e6 + np.cumsum(steps) + 0.05 * jitter * np.sin(np.arange(count))
    x = white(count)
    x[[lost] if lost < count else []] = np.nan
    bounds = [0, *sorted(k for k in holes if k < count), count]
    length = max(longest_run(~np.isnan(x[begin:end]))[1] for begin, end in pairwise(bounds))
    if length >= 64:
        found = sound_stretch(stamped(x, times))
        assert found.count == length
        assert found.interval_s == pytest.approx(0.05, rel=0.01)
        assert not np.isnan(x[found.first : found.first + found.count]).any()


@given(share=st.floats(0.3, 0.9))
@FEW
def test_uneven_time_stamps_are_refused(share: float) -> None:
    steps = 0.01 * (1.0 + share * np.tile([1.0, -1.0], 200))
    with pytest.raises(InputError, match="give rate_hz in place of time stamps"):
        sound_stretch(stamped(white(400), np.cumsum(steps)))


def test_a_clock_that_runs_a_little_fast_or_slow_is_even() -> None:
    times = np.cumsum(0.01 * (1.0 + 1e-4 * np.sin(np.arange(100_000) / 9000.0)))
    assert sound_stretch(stamped(white(100_000), times)).count == 100_000


@FEW
@given(held=st.integers(1, 30), stuck=st.integers(0, 3000), seed=st.integers(0, 999))
def test_holds_and_the_longest_of_them_are_counted(held: int, stuck: int, seed: int) -> None:
    x = np.repeat(white(500, seed), held)
    at = x.size // 2 // held * held
    x = np.concatenate([x[:at], np.full(stuck, x[at - 1]), x[at:]])
    found = sound_stretch(gyro(x))
    assert found.longest_held == held + stuck
    assert found.held == pytest.approx(x.size / 500.0)


def test_a_long_channel_is_looked_through_in_pieces() -> None:
    x = white(700_000)
    x[100_000], x[x.size - 5] = np.nan, np.nan
    x[300_000:500_000] = x[300_000]
    found = sound_stretch(gyro(x))
    assert (found.first, found.count) == (100_001, x.size - 5 - 100_001)
    assert found.longest_held == 200_000


def test_noise_of_a_channel_is_that_of_its_stretch() -> None:
    x = 0.1 + 0.02 * white(20_000)
    x[4999] = np.nan
    found = channel_noise(gyro(x, 50.0, start_s=3.0))
    assert (found.begin_s, found.end_s) == (3.0 + 100.0, 3.0 + 19_999 / 50.0)
    assert found.allan.count == 15_000
    assert found.allan.standard_deviation == pytest.approx(x[5000:].std())
    assert found.fit.coefficients.white_noise == pytest.approx(0.02 / np.sqrt(50.0), rel=0.03)
    assert found.unit == "rad/s"


def test_a_filtered_sensor_is_fitted_beyond_its_band_limit() -> None:
    filtered = np.convolve(white(200_000), np.ones(8) / 8.0, "valid")
    found = channel_noise(gyro(filtered))
    assert found.fit.coefficients.white_noise == pytest.approx(0.1, rel=0.03)
    assert found.fit.coefficients.quantization == 0.0
    assert found.fit.worst()[0] < 1.3
    everything = channel_noise(gyro(filtered), between_s=(0.0, 1e9))
    assert everything.fit.worst()[0] > 1.5


def test_the_curve_is_fitted_where_it_is_asked_for() -> None:
    hum = np.sin(2.0 * np.pi * 12.3 * np.arange(100_000) / 100.0)
    found = channel_noise(gyro(white(100_000) + 3.0 * hum), between_s=(10.0, 100.0))
    times = found.fit.allan.cluster_s
    assert times[0] >= 10.0
    assert times[-1] <= 100.0
    assert found.allan.cluster_s[0] == pytest.approx(0.01)
    assert found.fit.coefficients.white_noise == pytest.approx(0.1, rel=0.1)


@pytest.mark.parametrize(
    ("values", "between_s", "text"),
    [
        (np.full(500, 0.25), None, "channel roll_rate: every sample is 0.25"),
        (white(20), None, "channel roll_rate: of 20 samples no 64 in a row"),
        (np.full(500, np.nan), None, "channel roll_rate: of 500 samples no 64 in a row"),
        (white(500), (5.0, 1.0), "channel roll_rate: 0 cluster times from 5 s to 1 s"),
        (white(500), (float("nan"), 1.0), "channel roll_rate: 0 cluster times from nan s"),
        (white(500), (1e3, 1e6), "there are some from 0.01 s to 1.66 s"),
        (np.full(500, 1e150) * white(500), None, "channel roll_rate: a sample is"),
    ],
)
def test_a_channel_that_cannot_be_used_is_named(
    values: np.ndarray, between_s: tuple[float, float] | None, text: str
) -> None:
    with pytest.raises(InputError, match=text):
        channel_noise(gyro(values), between_s)
