"""Another estimate of the road in the gaps of the height sensor."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.engine.fall_back import fill_gaps
from floatref.interfaces.drop_out import DropOut
from floatref.measures import high_pass
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

INTERVAL_M, POINTS = 0.025, 16000
RECORDING = Recording((Channel.of("height", [1.0], UniformClock.of(1)),))
ROAD = 1e-3 * np.cumsum(np.random.default_rng(3).standard_normal(POINTS))
TRUE = high_pass(ROAD, INTERVAL_M)


def profile_of(gaps: FloatArray, off_m: float = 0.01, sigma: float | None = None) -> Profile:
    """Return the road high-passed after its heights in ``gaps`` were bridged by a line."""
    seen, valid = ROAD.copy(), np.ones(POINTS, np.bool_)
    for begin, end in (gaps / INTERVAL_M).astype(int):
        seen[begin:end] = np.linspace(seen[begin - 1], seen[end], end - begin) + off_m
        valid[begin:end] = False
    spread = None if sigma is None else np.full(POINTS, sigma)
    track = ProfileTrack.of("main", high_pass(seen, INTERVAL_M), valid, spread)
    return Profile(INTERVAL_M, (track,), pipeline="temporal-basic")


def estimate_of(elevation: FloatArray, sigma: float | None = None) -> Profile:
    spread = None if sigma is None else np.full(POINTS, sigma)
    track = ProfileTrack.of("main", elevation, sigma=spread)
    return Profile(INTERVAL_M, (track,), pipeline="other")


def asked(gaps: FloatArray, profile: Profile) -> DropOut:
    return DropOut(RECORDING, profile, {"main": gaps}, lambda pipeline, settings=None: profile)


@pytest.mark.slow
@given(
    begin=st.integers(20, 300),
    length=st.integers(1, 15),
    datum=st.floats(-0.05, 0.05),
    tilt=st.floats(-1e-4, 1e-4),
)
def test_an_estimate_off_by_a_line_restores_the_road_inside_and_beside(
    begin: int, length: int, datum: float, tilt: float
) -> None:
    """Datum and tilt of the other estimate do not matter; the filter's spreading is undone."""
    gaps = np.array([[float(begin), float(begin + length)]])
    profile = profile_of(gaps)
    off = datum + tilt * INTERVAL_M * np.arange(POINTS)
    found, _ = fill_gaps(asked(gaps, profile), estimate_of(TRUE + off))
    before = np.abs(profile.tracks[0].elevation - TRUE)
    after = np.abs(found.tracks[0].elevation - TRUE)
    # What is left is the line's own error: the margins are off by what the filter spread.
    assert after.max() < 0.2 * before.max()


def test_an_exact_estimate_leaves_a_hundredth() -> None:
    gaps = np.array([[150.0, 160.0]])
    profile = profile_of(gaps)
    found, lines = fill_gaps(asked(gaps, profile), estimate_of(TRUE))
    error = np.abs(found.tracks[0].elevation - TRUE).max()
    assert error < 0.01 * np.abs(profile.tracks[0].elevation - TRUE).max()
    assert lines == (
        "track main: height missing over 10 m, where other gives the elevation; flagged",
    )


def test_bridged_points_are_invalid_and_no_others() -> None:
    gaps = np.array([[150.0, 160.0], [200.0, 203.0]])
    profile = profile_of(gaps)
    sound = replace(profile.tracks[0], valid=np.ones(POINTS, np.bool_))
    drop_out = asked(gaps, replace(profile, tracks=(sound,)))
    found, _ = fill_gaps(drop_out, estimate_of(TRUE))
    np.testing.assert_array_equal(found.tracks[0].valid, profile.tracks[0].valid)


def test_sigma_is_that_of_the_estimate_and_of_the_meeting() -> None:
    gaps = np.array([[150.0, 160.0]])
    profile = profile_of(gaps, off_m=0.0, sigma=1e-4)
    found, _ = fill_gaps(asked(gaps, profile), estimate_of(TRUE, sigma=3e-3))
    sigma = found.tracks[0].sigma
    assert sigma is not None
    inside = slice(6000, 6400)
    assert sigma[inside].min() >= 3e-3
    assert sigma[inside].max() < 4e-3
    np.testing.assert_array_equal(np.delete(sigma, np.r_[inside]), np.full(POINTS - 400, 1e-4))


def test_a_gap_at_an_end_keeps_the_datum_of_its_one_side() -> None:
    gaps = np.array([[390.0, np.inf]])
    profile = profile_of(np.array([[390.0, 399.9]]))
    found, lines = fill_gaps(asked(gaps, profile), estimate_of(TRUE + 0.02))
    assert lines
    assert np.abs(found.tracks[0].elevation - TRUE)[15600:].max() < 2e-3


@pytest.mark.parametrize(
    ("gaps", "estimate"),
    [
        (np.empty((0, 2)), estimate_of(TRUE)),
        (np.array([[150.0, 160.0]]), estimate_of(np.r_[TRUE[:100], np.full(POINTS - 100, np.nan)])),
        (
            np.array([[150.0, 160.0]]),
            Profile(INTERVAL_M, (ProfileTrack.of("left", TRUE),), pipeline="other"),
        ),
    ],
    ids=["no gap", "nothing known there", "another wheel path"],
)
def test_what_cannot_be_bridged_is_left(gaps: FloatArray, estimate: Profile) -> None:
    profile = profile_of(np.array([[150.0, 160.0]]))
    found, lines = fill_gaps(asked(gaps, profile), estimate)
    np.testing.assert_array_equal(found.tracks[0].elevation, profile.tracks[0].elevation)
    assert lines == ()
