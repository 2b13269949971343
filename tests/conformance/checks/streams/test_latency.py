"""Latency: what is declared is held, in recorded time, for metres, seconds and standstills."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_conformance.checks.streams.latency import MOST_LATE_S, LatencyCheck
from floatref_conformance.checks.streams.passing import Passing
from floatref_conformance.devices.streams.answers import Latency
from floatref_conformance.errors import DeviceError

from .conftest import LATENCY, SPEED_MPS, MadeUp, drive, recording_of, steadily

CHECK = LatencyCheck()
DUE_S = 200.0 / SPEED_MPS + 2.0
"""What `LATENCY` declares, at the speed of the drive."""


@given(
    travelled_m=st.floats(0.0, 900.0), then_s=st.floats(0.0, 9.0), longest_s=st.floats(0.0, 90.0)
)
def test_at_constant_speed_a_point_is_due_at_the_earlier_of_both(travelled_m, then_s, longest_s):
    passing = Passing.of(recording_of(drive()[1]))
    places = np.arange(5.0, 900.0, 50.0)
    due_s = passing.due_final(places, Latency(travelled_m, then_s, longest_s))
    expected = places / SPEED_MPS + min(travelled_m / SPEED_MPS + then_s, longest_s)
    np.testing.assert_allclose(due_s, expected, atol=0.06)


@pytest.mark.parametrize("standing_s", [10.0, 25.0])
def test_a_standstill_of_the_declared_length_makes_the_points_before_it_due(standing_s):
    passing = Passing.of(recording_of(drive(dwell=(30.0, 60.0))[1]))
    latency = Latency(4000.0, 0.0, 1e6, standing_s)
    due_s = passing.due_final(np.array([100.0, 590.0, 700.0]), latency)
    np.testing.assert_allclose(due_s[:2], 30.0 + standing_s, atol=0.2)
    assert due_s[2] > 1e6


def test_a_place_that_was_never_reached_is_never_due():
    passing = Passing.of(recording_of(drive()[1]))
    assert passing.due_final(np.array([1e6]), LATENCY) == [np.inf]


@pytest.mark.parametrize("late_s", [-5.0, 0.0, MOST_LATE_S + 0.3, 30.0])
def test_final_points_that_come_later_than_declared_fail(fails, transcript, late_s):
    # A piece of points is as long as the vehicle takes for it: the first of them waits that long.
    piece_m = 5.0
    given = steadily(after_s=DUE_S - piece_m / SPEED_MPS + late_s, piece_m=piece_m)
    soon = steadily("provisional", 1.0)
    found = fails(CHECK, MadeUp(transcript([*given, *soon])))
    assert found == (["lateness of final points"] if late_s > MOST_LATE_S else [])


@pytest.mark.parametrize(("after_s", "is_late"), [(0.5, False), (5.0, True)])
def test_provisional_points_that_come_later_than_declared_fail(fails, transcript, after_s, is_late):
    given = [*steadily(after_s=5.0), *steadily("provisional", after_s)]
    found = fails(CHECK, MadeUp(transcript(given)))
    assert found == (["lateness of provisional points"] if is_late else [])


def test_a_device_without_provisional_points_owes_nothing(fails, transcript):
    without = replace(LATENCY, provisional_s=None)
    given = steadily(after_s=5.0)
    assert fails(CHECK, MadeUp(transcript(given, latency=without))) == []
    assert fails(CHECK, MadeUp(transcript(given))) == ["lateness of provisional points"]


def test_a_point_that_never_comes_is_late_and_one_that_is_not_due_is_not(fails, transcript):
    given, soon = steadily(after_s=5.0), steadily("provisional", 1.0)
    assert fails(CHECK, MadeUp(transcript([*given[:-5], *soon]))) == []
    assert fails(CHECK, MadeUp(transcript([*given[:3], *given[4:], *soon]))) == [
        "lateness of final points"
    ]


def test_a_latency_longer_than_the_drive_is_refused(transcript):
    far = replace(LATENCY, travelled_m=5000.0)
    with pytest.raises(DeviceError, match="travelled_m 5000"):
        CHECK.judge(MadeUp(transcript(latency=far)))
