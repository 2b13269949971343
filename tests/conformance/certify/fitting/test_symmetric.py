"""Run and reference are treated alike, and another line on the road is no scale of heights."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.fitting.fit import fit
from floatref_conformance.certify.fitting.spectra import Windows
from floatref_conformance.certify.fitting.symmetric import (
    bands_of,
    find_division,
    fit_bands,
)
from floatref_conformance.proving_ground.roads.random_roads import sayers_road
from floatref_conformance.proving_ground.roads.strips import along_line
from floatref_conformance.proving_ground.roads.wander import Line

WAVE_NUMBER = np.arange(2, 33) / 12.8


def drawn(seed, windows, gain=1.0, own=0.0, others=0.0):
    """Windows of a white road, with noise of the run and of the reference as shares of it."""
    rng = np.random.default_rng(seed)
    shape = (3, windows, WAVE_NUMBER.size)
    common, mine, theirs = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    at = 6.4 * np.arange(windows)
    return Windows(WAVE_NUMBER, at, common + others * theirs, gain * (common + own * mine))


def exchanged(windows):
    return replace(windows, reference=windows.run, run=windows.reference)


def fitted(windows):
    return fit_bands(bands_of(windows, np.ones(windows.at_m.size)))


@given(
    st.integers(0, 2**31),
    st.integers(8, 60),
    st.floats(0.9, 1.1),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.0),
)
@settings(max_examples=25)
def test_exchanged_run_and_reference_have_the_opposite_gain(seed, count, gain, own, others):
    windows = drawn(seed, count, gain, own, others)
    here, there = fitted(windows), fitted(exchanged(windows))
    assert here.log_height == pytest.approx(-there.log_height, abs=1e-9)
    assert here.smoothing_m2 == pytest.approx(-there.smoothing_m2, abs=1e-9)
    assert here.log_sigma == pytest.approx(there.log_sigma, rel=1e-6)


@given(st.integers(0, 2**31), st.floats(0.95, 1.05))
@settings(max_examples=10)
def test_a_gain_without_noise_is_found_whatever_the_road(seed, gain):
    assert fitted(drawn(seed, 24, gain)).log_height == pytest.approx(math.log(gain), abs=1e-9)


def test_sigma_is_what_gains_scatter_by_that_have_as_much_noise_each():
    # Every second window: drawn ones are independent, and those of a road lie half over each other.
    found = [fitted(drawn(seed, 40, 1.0, 0.3, 0.3)) for seed in range(100)]
    scatter = np.std([one.log_height for one in found])
    sigma = np.mean([one.log_sigma for one in found])
    assert 0.55 < scatter / sigma < 0.95


def growing(seed, mine, theirs):
    """Windows whose noise grows with the wave number, as a share of it in each of both."""
    windows = drawn(seed, 200)
    rng = np.random.default_rng(seed + 1)
    noise = rng.normal(size=(2, *windows.run.shape)) + 1j * rng.normal(size=(2, *windows.run.shape))
    amount = 0.5 * WAVE_NUMBER
    return replace(
        windows,
        run=windows.run + mine * amount * noise[0],
        reference=windows.reference + theirs * amount * noise[1],
    )


@pytest.mark.parametrize(("mine", "theirs", "where"), [(1, 0, 1.0), (1, 1, 0.0), (0, 1, -1.0)])
def test_noise_that_grows_with_the_wave_number_says_whose_it_is(mine, theirs, where):
    windows = growing(3, mine, theirs)
    division, sigma = find_division(bands_of(windows, np.ones(windows.at_m.size)))
    assert sigma < 0.3
    assert division == pytest.approx(where, abs=3.0 * sigma)


def test_so_few_waves_that_they_make_one_band_share_a_gain():
    windows = drawn(1, 6, 1.04)
    few = replace(
        windows,
        wave_number=WAVE_NUMBER[:3],
        reference=windows.reference[:, :3],
        run=windows.run[:, :3],
    )
    assert fitted(few).log_height == pytest.approx(math.log(1.04), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("percent", [0.0, 3.0, -3.0])
def test_lines_beside_the_reference_have_its_height(percent):
    heights, sigmas = [], []
    for seed in range(20):
        road = sayers_road("normal", 320.0, seed=seed)
        reference = profile_of(road)
        line = along_line(road, Line(seed, 0.08, 0.03), seed)
        run = profile_of(line, 1.0 + percent / 100.0)
        there, back = fit(reference, run, "left"), fit(run, reference, "left")
        gains = [math.log1p(one.height_percent / 100.0) for one in (there, back)]
        # The windows begin elsewhere, and the run lies between other points.
        assert sum(gains) == pytest.approx(0.0, abs=0.003)
        heights.append(100.0 * gains[0])
        sigmas.append(there.height_sigma)
    usual = math.sqrt(np.mean(np.square(sigmas)))
    mean = 100.0 * math.log1p(percent / 100.0)
    assert np.mean(heights) == pytest.approx(mean, abs=3.5 * usual / math.sqrt(20.0))
    assert np.std(heights) < 1.7 * usual
    assert usual < 1.5


def profile_of(road, gain=1.0):
    """The road from 60 m on, every 2.5 cm."""
    at = np.arange(60.0, 221.0, 0.025)
    tracks = (ProfileTrack.of(name, gain * road.at(name, at)) for name in road.tracks)
    return Profile(0.025, tuple(tracks), 60.0)
