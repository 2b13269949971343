"""Other profilers' high-pass filters: the reference's responses, in place of ours."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conformance.checks.benches import OneRecording

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.distance.waveband import WavebandCheck
from floatref_conformance.classes import Effort
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.mutants.other_profilers import (
    OTHER_PROFILERS,
    OWN_CUT_OFF_M,
    pass_cotangent,
    pass_third_order,
    refilter,
    take_average_away,
)
from floatref_conformance.selftest.grading import NOMINAL
from floatref_reference.chapter_3.section_3_1_2_filters import (
    anti_smoothing_response,
    butterworth_response,
    cotangent_response,
)

PAIRS = (
    (take_average_away, anti_smoothing_response),
    (pass_cotangent, cotangent_response),
    (pass_third_order, butterworth_response),
)
INTERVAL = 0.1
X = INTERVAL * np.arange(30001)
FADED = np.hanning(X.size)
"""Lets a wave begin and end at nothing, so that no filter answers to its ends."""
MIDDLE = (X > 1400.0) & (X < 1600.0)


def waves(*lengths_m):
    return FADED * sum(np.sin(2 * np.pi * X / length_m + length_m) for length_m in lengths_m)


def refiltered(response, z):
    changed = refilter(response)(Profile(INTERVAL, (ProfileTrack.of("left", z),)), None)
    return changed.track("left").elevation


def pass_ours(lengths_m, interval_m):
    """Return the response of our filter, which runs forward and back."""
    return np.abs(pass_third_order(lengths_m, interval_m, OWN_CUT_OFF_M)) ** 2 + 0j


@pytest.mark.parametrize(("response", "reference"), PAIRS)
@settings(deadline=None, max_examples=40)
@given(
    interval_m=st.sampled_from([0.00508, 0.01, 0.025, 0.05, 0.25]),
    intervals=st.lists(st.floats(2.2, 40000.0), min_size=1, max_size=20),
)
def test_a_response_is_that_of_the_reference(response, reference, interval_m, intervals):
    lengths_m = interval_m * np.array(intervals)
    expected = [reference(length_m, interval_m) for length_m in lengths_m]
    assert response(lengths_m, interval_m) == pytest.approx(np.array(expected), abs=1e-9)


@pytest.mark.parametrize("response", [pass_cotangent, pass_third_order])
def test_three_decibel_are_lost_at_the_cut_off_and_none_of_short_waves(response):
    at, short = response(np.array([91.44, 1.0]), INTERVAL)
    assert 20 * np.log10(abs(at)) == pytest.approx(-3.01, abs=0.01)
    assert abs(short) == pytest.approx(1.0, abs=0.01)


@settings(deadline=None, max_examples=20)
@given(st.floats(0.5, 500.0))
def test_our_response_is_that_of_the_filter_of_a_profile(length_m):
    # -3.01 dB at 91.44 m of both directions together.
    (gain,) = pass_ours(np.array([length_m]), INTERVAL)
    x = np.arange(0.0, 60 * max(length_m, 91.44), INTERVAL)
    middle = slice(x.size // 2, x.size // 2 + round(4 * length_m / INTERVAL))
    wave = np.sin(2 * np.pi * x / length_m)
    found = high_pass(wave, INTERVAL)[middle]
    assert np.abs(found - gain.real * wave[middle]).max() < 0.003


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(st.lists(st.floats(1.0, 120.0), min_size=1, max_size=5))
def test_our_own_filter_in_place_of_ours_changes_nothing(lengths_m):
    z = waves(*lengths_m)
    assert refiltered(pass_ours, z) == pytest.approx(z, abs=1e-3)


def test_points_without_elevation_stay_so():
    z = np.where((X > 200.0) & (X < 210.0), np.nan, waves(7.0, 60.0))
    for response, _ in PAIRS:
        assert np.array_equal(np.isnan(refiltered(response, z)), np.isnan(z))


@pytest.mark.parametrize("length_m", [5.0, 30.0, 90.0, 130.0])
@pytest.mark.parametrize(("response", "reference"), PAIRS)
def test_a_wave_gets_the_gain_and_phase_of_the_other_filter(response, reference, length_m):
    own = pass_ours(np.array([length_m]), INTERVAL)[0].real
    found = refiltered(response, own * waves(length_m))
    gain = reference(length_m, INTERVAL)
    expected = abs(gain) * np.sin(2 * np.pi * X / length_m + length_m + np.angle(gain))
    assert found[MIDDLE] == pytest.approx(expected[MIDDLE], abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("mutation", OTHER_PROFILERS, ids=lambda mutation: mutation.name)
def test_each_fails_waveband_in_every_case(mutation):
    check = WavebandCheck(edition=find_edition("2026.2"))
    assert mutation.fails == (check.id,)
    for case in check.cases(0, Effort.QUICK):
        taken = make_taken(restrict_channels(NOMINAL, case.scenario))
        for make, passes in (
            (make_perfect, True),
            (lambda t: mutation.after(make_perfect(t), t.recording), False),
        ):
            measured = check.judge(case, OneRecording(taken, make))
            assert all(m.within(mutation.claims) for m in measured) is passes
