"""What is in doubt is not valid, there and on that wheel path alone."""

import numpy as np
import pytest

from floatref.engine.withdrawing import withdraw
from floatref.screening.second_sensor.doubts import Doubt
from floatref.values.arrays import BoolArray
from floatref.values.channels import ChannelId
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording

SPEED, LENGTH_M, INTERVAL_M = 10.0, 200.0, 0.1
COUNT = int(LENGTH_M / INTERVAL_M)
TRACKS = ("left", "right")


def recording() -> Recording:
    clock = UniformClock.of(100.0)
    travelled = SPEED / 100.0 * np.arange(int(100.0 * LENGTH_M / SPEED))
    return Recording((Channel.of("distance", travelled, clock),))


def profile() -> Profile:
    tracks = tuple(ProfileTrack.of(t, np.zeros(COUNT), np.ones(COUNT, bool)) for t in TRACKS)
    return Profile(INTERVAL_M, tracks)


def valid(doubt: Doubt, reach_m: float = 0.0) -> dict[str, BoolArray]:
    found = withdraw(profile(), recording(), [doubt], reach_m)
    return {track.name: np.asarray(track.valid) for track in found.tracks}


@pytest.mark.parametrize(("track", "left", "right"), [("left", 0, COUNT), (None, 0, 0)])
def test_a_doubt_about_the_whole_run_leaves_nothing_of_its_path(
    track: str | None, left: int, right: int
) -> None:
    found = valid(Doubt((ChannelId("height", track),), "in doubt"))
    assert (found["left"].sum(), found["right"].sum()) == (left, right)


def test_a_stretch_is_not_valid_with_its_reach() -> None:
    doubt = Doubt((ChannelId("height", "right"),), "in doubt", spans=((5.0, 8.0),))
    found = valid(doubt, reach_m=2.0)
    places = INTERVAL_M * np.arange(COUNT)
    assert found["left"].all()
    inside = (places > 48.5) & (places < 81.5)
    outside = (places < 47.5) | (places > 82.5)
    assert not found["right"][inside].any()
    assert found["right"][outside].all()


def test_everything_behind_an_open_end_is_not_valid() -> None:
    doubt = Doubt((ChannelId("distance"),), "in doubt", spans=((10.0, float("inf")),))
    for track in valid(doubt).values():
        assert track[: int(99.0 / INTERVAL_M)].all()
        assert not track[int(101.0 / INTERVAL_M) :].any()


def test_replaced_samples_are_left_to_the_stages() -> None:
    doubt = Doubt((ChannelId("height", "left"),), "gone", spans=((5.0, 8.0),), replaced=True)
    assert all(track.all() for track in valid(doubt).values())
