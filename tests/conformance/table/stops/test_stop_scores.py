"""Scores around a stop: the truth is filtered alike, and sigma is held to its own axis."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.errors import DeviceError
from floatref_conformance.table.stops.stop_scores import STRETCH_M, stop_scores

DX, LENGTH_M = 0.1, 550.0
X = DX * np.arange(round(LENGTH_M / DX) + 1)
INSIDE = (STRETCH_M[0] - DX / 2 < X) & (STRETCH_M[1] + DX / 2 > X)


def rough(x):
    """Waves of 1.7 m to 31 m on a hill, of which the high-pass leaves nothing."""
    waves = ((0.004, 31.0), (0.002, 11.3), (0.0007, 4.1), (0.0003, 1.7))
    hill = 3.0 * np.sin(2 * np.pi * x / 5000.0) + 0.02 * x
    return hill + sum(height * np.sin(2 * np.pi * x / wave + wave) for height, wave in waves)


TRUTH = Profile(DX, (ProfileTrack.of("left", rough(X)),))
FILTERED = high_pass(rough(X), DX)


def scored(elevation, sigma=None, encoder_m=X):
    track = ProfileTrack.of("left", elevation, sigma=sigma)
    return stop_scores(TRUTH, encoder_m, Profile(DX, (track,)))["left"]


def test_the_filtered_truth_is_perfect():
    scores = scored(FILTERED)
    assert scores.cross_correlation == pytest.approx(1.0)
    assert scores.iri_error_percent == pytest.approx(0.0, abs=1e-9)
    assert scores.within_two_sigma_percent is None
    assert scores.within_two_sigma_true_distance_percent is None


@pytest.mark.parametrize("gain", [0.5, 1.3])
def test_a_gain_is_an_error_of_roughness_and_a_loss_of_agreement(gain):
    scores = scored(gain * FILTERED)
    assert scores.iri_error_percent == pytest.approx(100 * (gain - 1))
    assert scores.cross_correlation == pytest.approx(min(gain, 1 / gain))


@pytest.mark.parametrize(("errors", "share"), [((1.9, -1.9), 100), ((2.1, 1.9), 50), ((3, -3), 0)])
def test_points_within_two_sigma_are_counted(errors, share):
    sigma = 1e-3 * (1.0 + X / LENGTH_M)
    error = np.where(np.arange(X.size) % 2, *errors) * sigma
    scores = scored(FILTERED + error, sigma)
    assert scores.within_two_sigma_percent == pytest.approx(share, abs=0.1)
    assert scores.within_two_sigma_true_distance_percent == pytest.approx(share, abs=0.1)


@pytest.mark.parametrize("off", [0.5, 1.0, 3.0])
def test_the_nees_is_the_square_of_errors_over_sigma(off):
    sigma = 1e-3 * (1.0 + X / LENGTH_M)
    scores = scored(FILTERED + off * sigma * np.where(np.arange(X.size) % 2, 1.0, -1.0), sigma)
    assert scores.nees == pytest.approx(off**2, rel=1e-3)
    assert scores.nees_true_distance == pytest.approx(off**2, rel=1e-3)
    assert scored(FILTERED).nees is None


def test_the_nees_along_the_true_distance_has_the_error_of_the_axis():
    encoder_m = 1.002 * X
    shifted = np.interp(X, encoder_m, rough(X))
    scores = scored(high_pass(shifted, DX), np.full(X.size, 1e-4), encoder_m)
    assert scores.nees < 0.1
    assert scores.nees_true_distance > 10.0


def test_only_points_around_the_stop_count_for_sigma():
    off = np.where(INSIDE, 0.0, 1.0)
    assert scored(FILTERED + off, np.full(X.size, 1e-6)).within_two_sigma_percent == 100.0
    untold = np.where(np.cumsum(INSIDE) <= INSIDE.sum() / 2, np.nan, 1.0)
    share = scored(FILTERED, untold).within_two_sigma_percent
    assert share == pytest.approx(50.0, abs=0.1)


def test_an_encoder_that_tells_too_much_is_an_error_of_the_axis_alone():
    encoder_m = 1.002 * X
    along_told = high_pass(np.interp(X, encoder_m, rough(X)), DX)
    scores = scored(along_told, np.full(X.size, 1e-4), encoder_m)
    assert scores.within_two_sigma_percent == 100.0
    assert scores.within_two_sigma_true_distance_percent < 50.0


def test_what_is_missing_is_named():
    holed = np.where(np.abs(X - 300.0) < 0.05, np.nan, FILTERED)
    with pytest.raises(DeviceError, match="track left: 1 of 1610 points without elevation"):
        scored(holed)
    right = Profile(DX, (ProfileTrack.of("right", FILTERED),))
    with pytest.raises(InputError, match="left"):
        stop_scores(TRUTH, X, right)
