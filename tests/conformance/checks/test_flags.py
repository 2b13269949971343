"""Flagged lengths: whose they are, and which do not count."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.flags import SLOW_MPS, measure_flags, speed_at
from floatref_conformance.checks.scoring import Compared
from floatref_conformance.proving_ground.scenario import Scenario

INTERVAL, LENGTH = 0.1, 500.0
DISTANCE = np.arange(round(LENGTH / INTERVAL) + 1) * INTERVAL
STEADY, STOP = Scenario(), Scenario(manoeuvre="stop")
QUICK = settings(deadline=None, max_examples=25)


def lengths(bad, scenario=STEADY, events=(316.0,)):
    """Return the flagged lengths in m at an end and around an event."""
    zero = np.zeros(DISTANCE.size)
    ends, around = measure_flags(
        Compared("left", DISTANCE, zero, zero, ~bad, INTERVAL), scenario, events
    )
    return ends.value, around.value


def between(start, end):
    x = DISTANCE
    return (x >= start - 1e-9) & (x <= end + 1e-9)


def test_a_profile_that_is_vouched_for_throughout_has_none():
    assert lengths(between(1.0, 0.0)) == (0.0, 0.0)


@QUICK
@given(st.floats(0.0, 200.0), st.floats(0.0, 200.0))
def test_what_is_in_one_piece_with_an_end_belongs_to_it_and_the_longer_end_counts(first, last):
    ends, around = lengths(between(0.0, first) | between(LENGTH - last, LENGTH), events=())
    assert ends == pytest.approx(max(first, last), abs=2 * INTERVAL)
    assert around == 0.0


@QUICK
@given(st.floats(1.0, 300.0), st.floats(0.5, 100.0))
def test_what_is_flagged_elsewhere_belongs_to_the_event(start, length):
    ends, around = lengths(between(start, start + length))
    assert ends == 0.0
    assert around == pytest.approx(length, abs=2 * INTERVAL)


def test_every_length_belongs_to_the_nearest_event_and_the_longest_counts():
    bad = between(100.0, 120.0) | between(150.0, 160.0) | between(290.0, 340.0)
    assert lengths(bad, events=(120.0, 316.0))[1] == pytest.approx(50.0, abs=2 * INTERVAL)
    assert lengths(bad, events=(120.0,))[1] == pytest.approx(80.0, abs=4 * INTERVAL)


def test_flagging_all_is_too_long_for_an_end_unless_an_event_takes_its_share():
    everything = np.ones(DISTANCE.size, dtype=bool)
    assert lengths(everything, events=())[0] == pytest.approx(LENGTH, abs=2 * INTERVAL)
    ends, around = lengths(everything)
    assert ends <= 106.5
    assert around > 125.0


def test_travel_below_16_km_per_h_does_not_count():
    slow = speed_at(STOP, DISTANCE) < SLOW_MPS
    assert 5.0 < INTERVAL * slow.sum() < 20.0
    assert lengths(slow, STOP) == (0.0, 0.0)
    assert lengths(np.ones(DISTANCE.size, dtype=bool), Scenario(speed_kmh=10.0), ()) == (0.0, 0.0)


def test_the_speed_at_a_stop_is_zero_and_that_of_the_drive_elsewhere():
    found = speed_at(STOP, np.array([50.0, 316.0, 499.0]))
    assert found == pytest.approx([72 / 3.6, 0.0, 58 / 3.6], abs=0.05)
