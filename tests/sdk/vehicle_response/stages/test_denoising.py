"""Singular spectrum analysis: what it keeps of sines and of noise, and what it refuses."""

import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response.stages.denoising import remove_noise, singular_spectrum

FEW = settings(deadline=None, max_examples=20)
SEEDS = st.integers(0, 2**32 - 1)


def drawn(seed, size, coloured=True):
    noise = np.random.default_rng(seed).standard_normal(size)
    return np.convolve(noise, [1.0, 0.8, 0.5], mode="same") if coloured else noise


@FEW
@given(seed=SEEDS, waves=st.integers(1, 3), window=st.integers(8, 40))
def test_a_few_sines_lie_in_two_components_each(seed, waves, window):
    rng = np.random.default_rng(seed)
    time, rate = np.arange(200), 0.3 + 0.7 * np.arange(waves) + rng.uniform(0, 0.2, waves)
    samples = np.cos(np.outer(time, rate) + rng.uniform(0, 6, waves)).sum(1)
    np.testing.assert_allclose(
        remove_noise(samples, window, components=2 * waves), samples, atol=1e-9
    )
    np.testing.assert_allclose(remove_noise(samples, window, share=1.0 - 1e-9), samples, atol=1e-3)
    np.testing.assert_allclose(remove_noise(samples, window, noise=1e-6), samples, atol=1e-4)


@pytest.mark.parametrize("how", [{"noise": 0.5}, {"components": 2}])
def test_a_sine_comes_out_of_noise(how):
    wave = np.sin(0.05 * np.arange(4000))
    found = remove_noise(wave + 0.5 * drawn(1, 4000, coloured=False), 100, **how)
    # Two components of a hundred keep about two hundredths of the noise's power.
    assert np.sqrt(np.mean((found - wave) ** 2)) <= 0.5 * math.sqrt(2 * 2 / 100)


@pytest.mark.parametrize("seed", range(5))
def test_white_noise_alone_leaves_little_above_its_own_level(seed):
    samples = drawn(seed, 8000, coloured=False)
    assert np.mean(remove_noise(samples, 50, noise=1.0) ** 2) <= 0.06
    assert np.mean(remove_noise(samples, 50, noise=0.5) ** 2) >= 0.9


@FEW
@given(seed=SEEDS, share=st.floats(0.05, 1.0))
def test_a_share_takes_as_few_components_as_it_needs(seed, share):
    samples = drawn(seed, 300)
    variances, _ = singular_spectrum(samples, 20)
    reached = np.cumsum(variances) / variances.sum()
    fewest = int(np.flatnonzero(reached >= share * (1 - 1e-9))[0]) + 1
    np.testing.assert_array_equal(
        remove_noise(samples, 20, share=share), remove_noise(samples, 20, components=fewest)
    )


@pytest.mark.slow
def test_ten_minutes_at_540_hz_take_a_few_copies_of_memory():
    samples = drawn(3, 324_000)
    tracemalloc.start()
    remove_noise(samples, 100, components=2)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak <= 12 * samples.nbytes


@pytest.mark.parametrize(
    ("samples", "window", "how", "says"),
    [
        (np.ones((10, 2)), 4, {"components": 1}, r"shape \(10, 2\); give one channel"),
        (np.ones(10), 1, {"components": 1}, "window of 1 of 10"),
        (np.ones(10), 6, {"components": 1}, "window of 6 of 10"),
        (np.array([1.0, np.nan] * 5), 4, {"components": 1}, "sample 1 is nan; bridge gaps"),
        (np.ones(10), 4, {}, "give exactly one of components, share and noise"),
        (np.ones(10), 4, {"share": 0.5, "noise": 1.0}, "give exactly one of"),
        (np.ones(10), 4, {"components": 5}, "5 components; give 1 to 4"),
        (np.ones(10), 4, {"components": 0}, "0 components"),
        (np.ones(10), 4, {"share": 0.0}, "share of 0"),
        (np.ones(10), 4, {"share": 1.5}, "share of 1.5"),
        (np.ones(10), 4, {"noise": -1.0}, "noise is -1"),
        (np.ones(10), 4, {"noise": math.nan}, "noise is nan"),
    ],
)
def test_wrong_input_is_refused_in_one_line(samples, window, how, says):
    with pytest.raises(InputError, match=says) as raised:
        remove_noise(samples, window, **how)
    assert "\n" not in str(raised.value)
