"""Scores of profiles made by hand: a gain, steps, shifts, and points that count."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.errors import DeviceError
from floatref_conformance.table import Scores, mean_scores, score
from floatref_reference.chapter_2.section_2_1_1_iri import iri_trace
from floatref_reference.chapter_2.section_2_1_3_roughness_profiles import short_interval_roughness

DX, LENGTH_M, SECTION_M = 0.1, 480.0, 100.0
X = DX * np.arange(round(LENGTH_M / DX) + 1)


def rough(x, phase=0.0):
    """Waves of 1.7 m to 31 m whose lengths have no common multiple within the profile."""
    waves = ((0.004, 31.0), (0.002, 11.3), (0.0007, 4.1), (0.0003, 1.7))
    return sum(height * np.sin(2 * np.pi * x / wave + phase * wave) for height, wave in waves)


def profile_of(**tracks):
    return Profile(DX, tuple(ProfileTrack.of(name, z) for name, z in tracks.items()))


ROAD = profile_of(left=rough(X), right=rough(X, 1.0))


def step_at(section_m, height=0.05):
    return profile_of(left=rough(X) + height * (SECTION_M + section_m < X), right=rough(X, 1.0))


@settings(deadline=None, max_examples=10)
@given(st.floats(0.1, 10.0))
def test_a_gain_is_an_error_of_roughness_and_a_loss_of_agreement(gain):
    of_itself = score(ROAD, ROAD)
    louder = profile_of(left=gain * rough(X), right=gain * rough(X, 1.0))
    for track, scores in score(ROAD, louder).items():
        assert scores.iri_error_percent == pytest.approx(100 * (gain - 1), abs=1e-6)
        assert scores.cross_correlation == pytest.approx(min(gain, 1 / gain))
        assert scores.peak_m_per_km == pytest.approx(gain * of_itself[track].peak_m_per_km)


def test_a_step_raises_peak_and_average_as_the_equations_say():
    scores = score(ROAD, step_at(205.0))["left"]
    stepped = step_at(205.0).track("left").elevation
    roughness = short_interval_roughness(stepped, DX)[2800:3280]
    assert scores.peak_m_per_km == pytest.approx(float(roughness.max()))
    means = [
        np.abs(iri_trace(z, DX)[2200:3809]).astype(np.float64).mean() for z in (stepped, rough(X))
    ]
    assert scores.iri_error_percent == pytest.approx(100 * (means[0] / means[1] - 1))
    assert score(ROAD, step_at(205.0))["right"] == score(ROAD, ROAD)["right"]


@pytest.mark.parametrize(
    ("section_m", "in_peak", "in_average"),
    [(170.0, False, True), (181.0, True, True), (220.0, True, True), (235.0, False, True),
     (285.0, False, False)],
)  # fmt: skip
def test_where_a_step_counts(section_m, in_peak, in_average):
    plain, stepped = score(ROAD, ROAD)["left"], score(ROAD, step_at(section_m))["left"]
    # The car still rings for some metres behind a step, but less than under it.
    at_step = short_interval_roughness(step_at(section_m).track("left").elevation, DX).max()
    assert (stepped.peak_m_per_km == pytest.approx(float(at_step))) == in_peak
    assert (stepped.iri_error_percent > 1.0) == in_average
    assert (stepped.cross_correlation < 0.99) == in_average
    assert plain.cross_correlation == pytest.approx(1.0)


@pytest.mark.parametrize(("shift_m", "found"), [(0.9, True), (-0.9, True), (2.5, False)])
def test_lags_of_up_to_a_metre_are_found(shift_m, found):
    moved = profile_of(left=rough(X - shift_m), right=rough(X, 1.0))
    agreement = score(ROAD, moved)["left"].cross_correlation
    assert agreement > 0.995 if found else agreement < 0.9


def test_points_lie_where_the_profile_says():
    late = Profile(DX, tuple(ProfileTrack.of(t.name, t.elevation[170:]) for t in ROAD.tracks), 17.0)
    for track, scores in score(ROAD, late).items():
        expected = score(ROAD, ROAD)[track]
        assert scores.peak_m_per_km == pytest.approx(expected.peak_m_per_km, rel=1e-6)
        assert scores.cross_correlation == pytest.approx(1.0, abs=1e-6)


def test_flagged_points_count_and_missing_ones_are_refused():
    z = step_at(205.0).track("left").elevation
    flagged = ProfileTrack.of("left", z, np.abs(X - 305.0) > 20.0)
    left = replace(ROAD, tracks=ROAD.tracks[:1])
    assert score(left, replace(left, tracks=(flagged,))) == score(left, profile_of(left=z))
    holed = ProfileTrack.of("left", np.where(np.abs(X - 250.0) < 0.05, np.nan, z))
    with pytest.raises(DeviceError, match="track left: 1 of 1610 points without elevation"):
        score(left, replace(left, tracks=(holed,)))


def test_a_reference_without_roughness_is_refused():
    flat = profile_of(left=np.zeros(X.size))
    with pytest.raises(InputError, match="track left: the reference has no roughness"):
        score(flat, ROAD)


def test_the_mean_is_that_of_the_raw_values():
    scores = [Scores(2.0, 10.0, 0.9, 1.0), Scores(6.0, -40.0, -0.6, 0.5)]
    assert mean_scores(scores) == Scores(4.0, -15.0, pytest.approx(0.15), 0.75)
    without = [scores[0], replace(scores[1], cross_correlation_encoder=None)]
    assert mean_scores(without).cross_correlation_encoder is None
    with pytest.raises(InputError, match="no scores"):
        mean_scores([])
