"""A result is repeated for what begins alike, where the vehicle was at the same time."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording
from floatref_conformance.mutants.in_results import BEGINNING, Repeated

RATE, SPEED, INTERVAL = 1000.0, 20.0, 0.05
TIMES = np.arange(10000) / RATE
TOLD = SPEED * TIMES


def recorded(distance, first=0.3):
    height = np.where(TIMES == 0.0, first, 0.3)
    clock = UniformClock.of(RATE)
    return Recording(
        (Channel.of("distance", distance, clock), Channel.of("height", height, clock, "left"))
    )


def made(length_m, gain=1.0):
    x = INTERVAL * np.arange(round(length_m / INTERVAL) + 1)
    return Profile(INTERVAL, (ProfileTrack.of("left", gain * np.sin(x / 4.0), x < 150.0),))


def test_what_begins_alike_gets_the_result_before_and_what_does_not_its_own():
    device, first = Repeated(), made(199.0)
    assert device(first, recorded(TOLD)) is first
    again = device(made(199.0, gain=3.0), recorded(TOLD)).track("left")
    np.testing.assert_allclose(again.elevation, first.track("left").elevation, atol=1e-9)
    other = made(199.0, gain=5.0)
    assert device(other, recorded(TOLD, first=0.31)) is other


@pytest.mark.parametrize("leap_m", [1.0, 3.0])
def test_it_lies_where_the_vehicle_was_at_the_same_time(leap_m):
    device = Repeated()
    device(made(199.0), recorded(TOLD))
    leapt = np.where(TIMES >= 5.0, TOLD + leap_m, TOLD)
    leapt[4000:4100] = np.nan
    profile = made(199.0 + leap_m, gain=0.0)
    found = device(profile, recorded(leapt)).track("left").elevation
    x = profile.distance_m
    before, behind = x < 99.0, x > 101.0 + leap_m
    np.testing.assert_allclose(found[before], np.sin(x[before] / 4.0), atol=1e-4)
    np.testing.assert_allclose(found[behind], np.sin((x[behind] - leap_m) / 4.0), atol=1e-4)
    assert BEGINNING / RATE < 4.0


def test_flags_are_repeated_too():
    device = Repeated()
    device(made(199.0), recorded(TOLD))
    vouching = made(199.0)
    track = vouching.track("left")
    vouching = replace(vouching, tracks=(ProfileTrack.of("left", track.elevation),))
    valid = device(vouching, recorded(TOLD)).track("left").valid
    assert INTERVAL * valid.sum() == pytest.approx(150.0, abs=0.2)
