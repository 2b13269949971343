"""Recordings: read-only samples, wheel paths, shared channels, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording, Setup, TrackSetup, check_interval

CLOCK = UniformClock.of(10.0, 2.0)


def height(track: str | None, value: float = 0.3) -> Channel:
    return Channel.of("height", [value, value], CLOCK, track)


def test_samples_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        height("left").values[0] = 1.0


def test_samples_of_float64_are_not_copied() -> None:
    values = np.ones(3)
    assert np.shares_memory(Channel.of("height", values, CLOCK).values, values)


def test_more_than_one_dimension_is_refused() -> None:
    with pytest.raises(ValueError, match=r"expected one dimension, got shape \(2, 2\)"):
        Channel.of("height", np.ones((2, 2)), CLOCK)


@pytest.mark.parametrize(
    ("values", "clock", "text"),
    [
        ([], CLOCK, "channel height: no samples"),
        ([1.0, np.inf], CLOCK, "channel height: sample 1 is infinite; mark missing samples as NaN"),
        ([1.0], StampedClock.of([0, 1]), "channel height: 1 samples but 2 time stamps"),
    ],
)
def test_impossible_samples_are_refused(values: list[float], clock: object, text: str) -> None:
    with pytest.raises(InputError, match=text):
        Channel.of("height", values, clock)


def test_the_span_is_that_of_the_first_and_the_last_sample() -> None:
    assert Channel.of("height", np.ones(11), CLOCK).span_s == (2.0, 3.0)
    stamped = Channel.of("height", np.ones(3), StampedClock.of([0.5, 1.0, 4.0]))
    assert stamped.span_s == (0.5, 4.0)
    assert stamped.times_s.tolist() == [0.5, 1.0, 4.0]


@given(st.lists(st.none() | st.text(min_size=1, max_size=3), min_size=1, max_size=6, unique=True))
def test_tracks_keep_the_order_of_their_channels(tracks: list[str | None]) -> None:
    recording = Recording(tuple(height(track) for track in tracks))
    named = tuple(track for track in tracks if track is not None)
    assert recording.tracks == (named or ("main",))


def test_a_track_prefers_its_own_channel_to_the_shared_one() -> None:
    recording = Recording((height(None, 1.0), height("left", 2.0)))
    assert recording.channel("height", "left").values[0] == 2.0
    assert recording.channel("height", "right").values[0] == 1.0
    assert recording.find("distance") is None


def test_a_missing_channel_is_named_with_those_that_are_there() -> None:
    recording = Recording((height("left"),))
    with pytest.raises(InputError, match=r"right.height: missing; the recording holds left.height"):
        recording.channel("height", "right")


def test_no_channel_and_the_same_channel_twice_are_refused() -> None:
    with pytest.raises(InputError, match="the recording has no channels"):
        Recording(())
    with pytest.raises(InputError, match=r"channel left.height: given twice"):
        Recording((height("left"), height("left")))


@pytest.mark.parametrize("interval", [0.0, 9e-6, 10.1, np.nan])
def test_a_refused_interval_is_named_as_the_caller_says(interval: float) -> None:
    with pytest.raises(InputError, match=r"^settings.interval_m is .*, between 0.00001 and 10$"):
        check_interval(interval, "settings.interval_m")
    check_interval(1e-5, "")
    check_interval(10.0, "")


@pytest.mark.parametrize("interval", [0.0, -0.1, 1e-30, 11.0, np.nan, np.inf])
def test_an_impossible_interval_is_refused(interval: float) -> None:
    with pytest.raises(
        InputError, match=r"setup.profile_interval_m is .*; give the profile interv"
    ):
        Setup(interval)


def test_the_geometry_cannot_be_changed_from_outside() -> None:
    tracks = {"left": TrackSetup()}
    setup = Setup(tracks=tracks)
    tracks.clear()
    assert list(setup.tracks) == ["left"]
