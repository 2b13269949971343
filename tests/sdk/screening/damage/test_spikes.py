"""Spikes of one sample: found at their place, and nothing else is."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.damage.spikes import find_spikes
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

RATE, COUNT, G = 8000.0, 40_000, 9.80665


def force(values: FloatArray, rate: float = RATE) -> Channel:
    return Channel.of("vertical_specific_force", values, UniformClock.of(rate), "left")


def body(seed: int = 0) -> FloatArray:
    """Return an accelerometer on a body that heaves, with white noise, in m/s²."""
    source = np.random.default_rng(seed)
    times = np.arange(COUNT) / RATE
    return G + 2.0 * np.sin(9.0 * times) + 0.05 * source.standard_normal(COUNT)


@given(size=st.floats(1.0, 50.0), at=st.sets(st.integers(5, COUNT - 5), min_size=1, max_size=30))
@settings(max_examples=20, deadline=None)
def test_single_samples_are_found_and_only_these(size: float, at: set[int]) -> None:
    apart = [k for k in sorted(at) if not {k - 1, k + 1, k - 2, k + 2} & at]
    values = body()
    values[apart] += size * G
    assert find_spikes(force(values)).gone[:, 0].tolist() == apart


@given(seed=st.integers(0, 1000))
@settings(max_examples=10, deadline=None)
def test_noise_alone_has_no_spikes(seed: int) -> None:
    assert not find_spikes(force(body(seed))).gone.size


def test_a_shock_of_several_samples_is_no_spike() -> None:
    values = body()
    values[1000:1008] += 20.0 * G * np.hanning(8)
    assert not find_spikes(force(values)).gone.size


def test_a_slow_accelerometer_may_have_a_shock_in_one_sample() -> None:
    values = body()
    values[1000] += 5.0 * G
    assert not find_spikes(force(values, 200.0)).gone.size


def test_a_crack_of_a_centimetre_is_no_spike_and_a_decimetre_is() -> None:
    for depth, many in ((0.01, 0), (0.1, 1)):
        values = 0.3 + 3e-5 * np.random.default_rng(1).standard_normal(COUNT)
        values[777] += depth
        channel = Channel.of("height", values, UniformClock.of(RATE), "left")
        assert len(find_spikes(channel).gone) == many


def test_the_warning_names_channel_and_place() -> None:
    values = body()
    values[8000] -= 30.0 * G
    (line,) = find_spikes(force(values)).warnings
    assert line.startswith("channel left.vertical_specific_force: ")
    assert "from 1 s" in line


@pytest.mark.parametrize("share", [0.02, 0.2])
def test_what_is_mostly_spikes_is_noise(share: float) -> None:
    values = body()
    chosen = np.arange(3, COUNT - 3, int(1 / share))
    values[chosen] += 10.0 * G
    assert not find_spikes(force(values)).gone.size
