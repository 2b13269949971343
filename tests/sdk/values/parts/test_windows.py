"""A part of a profile and of a recording: every point between the limits, and no other."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.parts.windows import (
    Window,
    choose_channels,
    cut_profile,
    cut_recording,
    first_time,
    points_of,
)
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

LIMITS = st.integers(-2000, 8000).map(lambda k: k / 100 + 0.003) | st.none()
FEW = settings(max_examples=30)
START_S = 1e6


def profile() -> Profile:
    z = np.arange(200.0)
    track = ProfileTrack.of("left", z, z % 3 > 0, z / 10.0)
    return Profile(0.25, (track,), start_m=10.0)


def recording() -> Recording:
    uniform = UniformClock.of(16.0, START_S)
    stamped = StampedClock.of(START_S + 1.0 + np.cumsum(np.linspace(0.1, 1.0, 80)))
    channels = [
        Channel.of("height", np.arange(700.0), uniform, track) for track in ("left", "right")
    ]
    channels += [Channel.of(n, np.arange(80.0), stamped) for n in ("gnss_height", "gnss_speed")]
    return Recording(tuple(channels))


def window(begin: float | None, end: float | None) -> Window:
    """Return the window, its limits in order."""
    if begin is not None and end is not None and begin >= end:
        begin, end = end, begin + 1e-3
    return Window(begin, end)


def inside(places: np.ndarray, part: Window) -> np.ndarray:
    low = -np.inf if part.begin is None else part.begin
    high = np.inf if part.end is None else part.end
    return (places >= low - 1e-6) & (places <= high + 1e-6)


@given(LIMITS, LIMITS)
@FEW
def test_a_profile_is_cut_to_the_points_in_the_window(
    begin: float | None, end: float | None
) -> None:
    part, whole = window(begin, end), profile()
    chosen = inside(whole.distance_m, part)
    if chosen.sum() < 2:
        with pytest.raises(InputError, match="fewer than two points; the profile goes from 10 to"):
            points_of(whole, part)
        return
    found = cut_profile(whole, part)
    np.testing.assert_allclose(found.distance_m, whole.distance_m[chosen])
    for name in ("elevation", "valid", "sigma"):
        before, after = (getattr(p["left"], name) for p in (whole, found))
        np.testing.assert_array_equal(after, before[chosen])


@given(LIMITS, LIMITS)
@FEW
def test_a_recording_is_cut_to_the_samples_in_the_window(
    begin: float | None, end: float | None
) -> None:
    part, whole = window(begin, end), recording()
    expected = {c.id: inside(c.times_s - START_S, part) for c in whole.channels}
    if not any(chosen.any() for chosen in expected.values()):
        with pytest.raises(InputError, match="no sample; the recording lasts"):
            cut_recording(whole, part, first_time(whole))
        return
    found = cut_recording(whole, part, first_time(whole))
    there = {name for name, chosen in expected.items() if chosen.any()}
    assert {channel.id for channel in found.channels} == there
    for channel in found.channels:
        before = whole.channel(*channel.id)
        chosen = expected[channel.id]
        np.testing.assert_array_equal(channel.values, before.values[chosen])
        np.testing.assert_allclose(channel.times_s, before.times_s[chosen], rtol=0, atol=1e-6)


def test_channels_on_one_clock_stay_on_one() -> None:
    found = cut_recording(recording(), Window(5.0, 20.0), START_S)
    assert found.channel("gnss_height").clock is found.channel("gnss_speed").clock


def test_channels_are_chosen_by_name_with_and_without_the_wheel_path() -> None:
    def names(*chosen: str) -> list[str]:
        return [str(channel.id) for channel in choose_channels(recording(), chosen)]

    assert names("height") == ["left.height", "right.height"]
    assert names("right.height", "gnss_speed") == ["right.height", "gnss_speed"]
    assert len(names()) == 4
    with pytest.raises(InputError, match=r"channel hight: .*did you mean height"):
        names("hight")


@pytest.mark.parametrize(
    ("begin", "end", "line"),
    [
        (3.0, 2.0, "from 3 to 2: ends before it begins"),
        (2.0, 2.0, "ends before it begins"),
        (float("nan"), None, "from nan: not a number"),
        (None, float("inf"), "to inf: not a number"),
    ],
)
def test_impossible_limits_are_refused(begin: float, end: float, line: str) -> None:
    with pytest.raises(InputError, match=line):
        Window(begin, end)
