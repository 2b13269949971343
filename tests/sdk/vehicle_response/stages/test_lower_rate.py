"""Resampling keeps what lies in the new band, in time, and nothing of what lies above it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response.stages.lower_rate import Resampling

FEW = settings(deadline=None, max_examples=20)
RATIOS = st.floats(1.01, 30.0)


def inside(rule):
    return slice(
        math.ceil(rule.reach_s * rule.to_hz) + 1, -math.ceil(rule.reach_s * rule.to_hz) - 1
    )


@FEW
@given(ratio=RATIOS, share=st.floats(0.0, 0.8), phase=st.floats(0.0, 6.0))
def test_a_wave_of_the_pass_band_is_there_at_every_time(ratio, share, phase):
    rule = Resampling(200.0 * ratio, 200.0)
    wave = 2 * np.pi * share * 100.0
    n = int(120 * ratio)
    found = rule.resample(np.cos(wave * np.arange(n) / rule.from_hz + phase))
    expected = np.cos(wave * np.arange(found.size) / rule.to_hz + phase)
    part = inside(rule)
    assert np.abs(found - expected)[part].max() <= 1e-3
    assert found[part].size > 60


@FEW
@given(ratio=st.floats(2.0, 30.0), share=st.floats(1.0, 1.9), phase=st.floats(0.0, 6.0))
def test_a_wave_above_half_the_new_rate_is_sixty_decibels_down(ratio, share, phase):
    rule = Resampling(200.0 * ratio, 200.0)
    wave = 2 * np.pi * share * 100.0
    found = rule.resample(np.cos(wave * np.arange(int(120 * ratio)) / rule.from_hz + phase))
    assert np.abs(found[inside(rule)]).max() <= 1e-3


@FEW
@given(ratio=RATIOS, level=st.floats(-1e3, 1e3), slope=st.floats(-1e3, 1e3))
def test_a_level_stays_and_a_slope_nearly(ratio, level, slope):
    rule = Resampling(ratio, 1.0)
    found = rule.resample(level + slope * np.arange(int(100 * ratio)) / ratio)
    part = inside(rule)
    error = np.abs(found - level - slope * np.arange(found.size))[part]
    assert error.max() <= 1e-9 * abs(level) + 1e-3 * abs(slope) + 1e-12


@FEW
@given(at=st.integers(250, 750))
def test_a_missing_sample_is_missing_around_itself_alone(at):
    rule = Resampling(500.0, 200.0)
    samples = np.ones(2000)
    whole = rule.resample(samples)
    samples[at] = np.nan
    found = rule.resample(samples)
    away = np.abs(np.arange(found.size) / 200.0 - at / 500.0)
    np.testing.assert_array_equal(np.isnan(found) & ~np.isnan(whole), away < rule.reach_s)


def test_beyond_the_ends_all_is_missing():
    rule = Resampling(500.0, 200.0)
    samples, beyond = np.random.default_rng(1).standard_normal(2000), np.full(200, np.nan)
    among = rule.resample(np.concatenate((beyond, samples, beyond)))
    found = rule.resample(samples)
    # Places are counted from another first sample, which rounds otherwise.
    np.testing.assert_allclose(found, among[80 : 80 + found.size], atol=1e-12)
    assert 0 < np.isnan(found).sum() <= 2 * rule.reach_s * 200.0 + 1


@pytest.mark.parametrize(
    ("rates", "says"),
    [
        ((100.0, 200.0), "200 Hz is above the 100 Hz"),
        ((0.0, 0.0), "a rate is 0 Hz"),
        ((math.nan, 1.0), "a rate is nan Hz"),
        ((100.0, -1.0), "a rate is -1 Hz"),
    ],
)
def test_wrong_rates_are_refused_in_one_line(rates, says):
    with pytest.raises(InputError, match=says) as raised:
        Resampling(*rates)
    assert "\n" not in str(raised.value)


def test_two_channels_at_once_are_refused():
    with pytest.raises(InputError, match=r"shape \(3, 2\); give one channel"):
        Resampling(2.0, 1.0).resample(np.zeros((3, 2)))
