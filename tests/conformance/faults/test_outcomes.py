"""What a profile is against the truth: right, flagged, warned of, or believed."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.scoring import filter_truth
from floatref_conformance.faults.outcomes import Outcome, Truth, judge
from floatref_conformance.proving_ground.roads.random_roads import CASES, sayers_road
from floatref_conformance.table.stops.stop_scores import along_encoder

INTERVAL_M, LENGTH_M = 0.025, 500.0
ENDS_M = 220.0, 380.9


def truth() -> Truth:
    """Return a road of 500 m, and an encoder that counts every metre."""
    road = sayers_road(CASES["normal"], LENGTH_M, seed=3)
    places = INTERVAL_M * np.arange(int(LENGTH_M / INTERVAL_M))
    tracks = tuple(ProfileTrack.of(name, road.at(name, places)) for name in road.tracks)
    return Truth(Profile(INTERVAL_M, tracks), places, *ENDS_M)


def profile(of: Truth, scale: float = 1.0, valid: BoolArray | None = None) -> Profile:
    """Return the filtered road with the left path ``scale`` times as high."""
    made = filter_truth(of.road)

    def track(each: ProfileTrack) -> ProfileTrack:
        size: FloatArray = (scale if each.name == "left" else 1.0) * each.elevation
        return ProfileTrack.of(each.name, size, valid)

    return replace(made, tracks=tuple(track(each) for each in made.tracks))


@pytest.mark.parametrize("scale", [1.0, 1.03, 0.97])
def test_a_profile_within_five_percent_is_right(scale: float) -> None:
    found = truth()
    assert judge(found, profile(found, scale), False) is Outcome.RIGHT


@pytest.mark.parametrize(("warned", "outcome"), [(True, Outcome.WARNED), (False, Outcome.SILENT)])
def test_a_wrong_profile_that_is_valid_is_believed_unless_warned_of(
    warned: bool, outcome: Outcome
) -> None:
    found = truth()
    assert judge(found, profile(found, 2.0), warned) is outcome
    assert judge(found, profile(found, -1.0), warned) is outcome


def test_a_wrong_profile_without_valid_points_is_flagged() -> None:
    found = truth()
    nothing = np.zeros(found.encoder_m.size, np.bool_)
    assert judge(found, profile(found, 2.0, nothing), False) is Outcome.FLAGGED


def test_right_along_the_encoder_is_right() -> None:
    found = truth()
    stretched = replace(found, encoder_m=1.02 * found.encoder_m)
    along = along_encoder(found.road, stretched.encoder_m)
    made = filter_truth(along)
    assert judge(stretched, made, False) is Outcome.RIGHT


def test_a_profile_that_ends_too_early_is_wrong() -> None:
    found = truth()
    whole = profile(found)
    short = replace(
        whole, tracks=tuple(ProfileTrack.of(t.name, t.elevation[:100]) for t in whole.tracks)
    )
    assert judge(found, short, False) is Outcome.SILENT
