"""The scores of a profile: along both distances, and whether what is valid is right."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of
from floatref_conformance.table.families.family_scores import family_scores

STEADY = Scenario(length_m=600.0)
INTERVAL = 0.05
X = np.arange(round(600 / INTERVAL) + 1) * INTERVAL
ENCODER = X * 1.0


@pytest.fixture(scope="module")
def truth():
    walk = np.cumsum(np.random.default_rng(3).normal(0.0, 3e-4, X.size))
    return Profile(INTERVAL, (ProfileTrack.of("left", walk),))


def perfect(truth, change=lambda z: z, valid=None, sigma=None):
    z = change(high_pass(truth.track("left").elevation, INTERVAL))
    return replace(truth, tracks=(ProfileTrack.of("left", z, valid, sigma),))


def scored(truth, profile, encoder_m=ENCODER):
    return family_scores(STEADY, truth, encoder_m, profile)["left"]


def test_the_road_itself_is_right_along_both_distances(truth):
    found = scored(truth, perfect(truth, sigma=np.full(X.size, 1e-3)))
    for axis in (found.true, found.encoder):
        assert axis.cross_correlation == pytest.approx(1.0)
        assert axis.iri_error_percent == pytest.approx(0.0, abs=1e-9)
        assert axis.within_two_sigma_percent == 100.0
        assert axis.valid_is_right
    assert (found.flagged_m, found.missing_m) == (0.0, 0.0)


@pytest.mark.parametrize(("percent", "right"), [(4.0, True), (8.0, False)])
def test_what_is_valid_is_wrong_by_5_percent(truth, percent, right):
    found = scored(truth, perfect(truth, lambda z: (1 + percent / 100) * z))
    assert found.true.valid_is_right is right
    assert found.true.valid_error_percent == pytest.approx(percent, abs=0.2)


def test_a_smooth_road_may_be_wrong_by_a_tenth_of_a_metre_per_km(truth):
    smooth = replace(truth, tracks=(ProfileTrack.of("left", 0.02 * truth.track("left").elevation),))
    assert scored(smooth, perfect(smooth, lambda z: 1.2 * z)).true.valid_is_right


def test_what_is_flagged_does_not_count_as_valid_but_in_the_correlation(truth):
    bad = (X > 260.0) & (X < 320.0)
    wrong = perfect(truth, lambda z: np.where(bad, 4.0 * z, z), ~bad)
    found = scored(truth, wrong)
    assert found.true.valid_is_right
    assert found.true.cross_correlation < 0.95
    assert found.flagged_m == pytest.approx(60.0, abs=0.2)
    told = scored(truth, perfect(truth, lambda z: np.where(bad, 4.0 * z, z)))
    assert not told.true.valid_is_right


def test_all_points_are_right_or_wrong_whatever_is_flagged(truth):
    bad = (X > 260.0) & (X < 320.0)
    for valid in (None, ~bad):
        found = scored(truth, perfect(truth, lambda z: np.where(bad, 4.0 * z, z), valid))
        assert not found.encoder.all_is_right
        assert scored(truth, perfect(truth, valid=valid)).encoder.all_is_right


def test_only_what_is_flagged_faster_than_16_kmh_is_flagged_fast(truth):
    stop = Scenario(length_m=600.0, manoeuvre="stop", event_at_m=316.0)
    motion = drive_of(stop).motion(np.arange(0.0, 60.0, 1e-3))
    slow_m = motion.distance[np.argmax(motion.speed < 16 / 3.6)]
    assert 300.0 < slow_m < 314.0

    def fast_m(start_m, end_m, encoder_m=ENCODER):
        profile = perfect(truth, valid=~((start_m < X) & (end_m > X)))
        return family_scores(stop, truth, encoder_m, profile)["left"].flagged_fast_m

    near = pytest.approx(7.0, abs=3 * INTERVAL)
    assert fast_m(slow_m - 7.0, 316.0) == near
    assert fast_m(314.0, 316.5) == 0.0
    # Two metres that the encoder loses ahead of the stretch move every flag by as much.
    assert fast_m(slow_m - 9.0, 314.0, X - 2.0 * np.clip(X / 100.0, 0.0, 1.0)) == near


def test_the_share_within_two_sigma_is_of_the_points_that_have_one(truth):
    bad = (X > 260.0) & (X < 290.0)
    sigma = np.full(X.size, 1e-3)
    whole = scored(truth, perfect(truth, sigma=sigma)).encoder.sigma_points
    assert whole == pytest.approx(160.9 / INTERVAL, abs=2)
    holed = scored(truth, perfect(truth, lambda z: np.where(bad, np.nan, z), sigma=sigma))
    assert whole - holed.encoder.sigma_points == pytest.approx(30.0 / INTERVAL, abs=3)
    assert scored(truth, perfect(truth)).encoder.sigma_points == 0


def test_points_without_elevation_get_the_roads_shape_and_are_counted(truth):
    bad = (X > 260.0) & (X < 290.0)
    found = scored(truth, perfect(truth, lambda z: np.where(bad, np.nan, z)))
    assert found.true.cross_correlation == pytest.approx(1.0)
    assert found.missing_m == pytest.approx(30.0, abs=0.2)


def test_an_axis_that_is_wrong_costs_along_the_true_distance_alone(truth):
    encoder = X - 3.0 * np.clip((X - 250.0) / 100.0, 0.0, 1.0)
    along = np.interp(X, encoder, truth.track("left").elevation)
    profile = replace(truth, tracks=(ProfileTrack.of("left", high_pass(along, INTERVAL)),))
    found = scored(truth, profile, encoder)
    assert found.encoder.cross_correlation > 0.98
    assert found.true.cross_correlation < 0.8


def test_a_sigma_that_is_too_small_contains_little(truth):
    off = perfect(truth, lambda z: z + 0.01, sigma=np.full(X.size, 1e-3))
    assert scored(truth, off).true.within_two_sigma_percent < 1.0
    assert scored(truth, perfect(truth)).true.within_two_sigma_percent is None


@pytest.mark.parametrize("off", [0.5, 2.0])
def test_the_nees_is_the_square_of_errors_over_sigma(truth, off):
    sigma = np.full(X.size, 1e-3)
    error = off * sigma * np.where(np.arange(X.size) % 2, 1.0, -1.0)
    found = scored(truth, perfect(truth, lambda z: z + error, sigma=sigma))
    for axis in (found.true, found.encoder):
        assert axis.nees == pytest.approx(off**2)
    assert scored(truth, perfect(truth)).true.nees is None
