"""Profiles: points on the axis of distance, validity, and what is refused."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack

FLAT = ProfileTrack.of("left", [0.0, 0.0, 0.0])


@given(st.lists(st.tuples(st.floats(allow_infinity=False), st.booleans()), min_size=1))
def test_a_point_is_valid_if_marked_and_not_missing(points: list[tuple[float, bool]]) -> None:
    elevation, marked = map(list, zip(*points, strict=True))
    track = ProfileTrack.of("left", elevation, marked)
    expected = [mark and z == z for z, mark in points]
    assert track.valid.tolist() == expected
    assert ProfileTrack.of("left", elevation).valid.tolist() == [z == z for z in elevation]


def test_point_k_lies_k_intervals_from_the_start() -> None:
    profile = Profile(0.25, (FLAT,), 3.0)
    assert profile.distance_m.tolist() == [3.0, 3.25, 3.5]
    assert profile.length_m == 0.5


def test_arrays_and_records_cannot_be_changed() -> None:
    record: dict[str, Any] = {"cutoff": 91.44}
    profile = Profile(0.25, (ProfileTrack.of("left", [0.0], sigma=[0.1]),), settings=record)
    record.clear()
    assert profile.settings["cutoff"] == 91.44
    track = profile.track("left")
    for array in (track.elevation, track.valid, track.sigma):
        assert array is not None
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@pytest.mark.parametrize(
    ("columns", "text"),
    [
        (([],), "track left: no points"),
        (([np.inf],), "track left: infinite elevation; mark missing points as NaN"),
        (([0.0], [True], [0.1, 0.1]), "track left: elevation, valid and sigma differ in length"),
        (([0.0], [True], [-0.1]), "track left: sigma is below zero"),
    ],
)
def test_impossible_tracks_are_refused(columns: tuple[list[float], ...], text: str) -> None:
    with pytest.raises(InputError, match=text):
        ProfileTrack.of("left", *columns)


def test_a_missing_point_cannot_be_valid() -> None:
    with pytest.raises(InputError, match="track left: a point without elevation is marked valid"):
        ProfileTrack("left", np.array([np.nan]), np.array([True]))


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"interval_m": 0.0}, "interval_m is 0; give it in m, between 0.00001 and 1000"),
        ({"interval_m": np.nan}, "interval_m is nan; give it in m"),
        ({"interval_m": 1e-306}, "interval_m is 1e-306; give it in m"),
        ({"interval_m": 1000.1}, "interval_m is 1000.1; give it in m"),
        ({"start_m": np.inf}, "start_m is inf; give it in m, within 10000000000 of zero"),
        ({"start_m": np.nan}, "start_m is nan; give it in m"),
        ({"start_m": -1e308}, r"start_m is -1e\+308; give it in m"),
        ({"tracks": ()}, "the profile has no tracks"),
        ({"tracks": (FLAT, FLAT)}, "two tracks of the profile have the same name"),
        ({"tracks": (FLAT, ProfileTrack.of("right", [0.0]))}, "the profile's tracks differ in"),
    ],
)
def test_impossible_profiles_are_refused(changes: dict[str, Any], text: str) -> None:
    with pytest.raises(InputError, match=text):
        Profile(**({"interval_m": 0.25, "tracks": (FLAT,)} | changes))


def test_a_missing_track_is_named_with_those_that_are_there() -> None:
    with pytest.raises(InputError, match="track right: missing; the profile holds left"):
        Profile(0.25, (FLAT,)).track("right")


@pytest.mark.parametrize("one", [True, np.bool_(True), [True]])
def test_one_mark_is_that_of_every_point(one: Any) -> None:
    assert ProfileTrack.of("left", [0.0, np.nan, 0.0], one).valid.tolist() == [True, False, True]


@pytest.mark.parametrize("shape", [(2,), (4,), (1, 3), (3, 1), (0,)])
def test_marks_of_another_shape_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match="elevation, valid and sigma differ in length"):
        ProfileTrack.of("left", [0.0, np.nan, 0.0], np.ones(shape, np.bool_))


def test_marks_that_were_given_stay_as_they_are() -> None:
    marks = np.ones(3, np.bool_)
    ProfileTrack.of("left", [0.0, np.nan, 0.0], marks)
    assert marks.all()
    assert marks.flags.writeable
