"""Accelerometers that are stuck within their range."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.damage.damaged_samples import Damage
from floatref.screening.damage.stuck_sensors import combine_damage, find_stuck_force
from floatref.values.arrays import FloatArray
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

RATE, COUNT = 1000, 20_000
CLOCK = UniformClock.of(RATE)


def force_of(values: FloatArray) -> Channel:
    return Channel.of("unsprung_specific_force", values, CLOCK, "left")


def distance_of(speed: float) -> Channel:
    return Channel.of("distance", speed / RATE * np.arange(COUNT), CLOCK)


def shaken(quantum: float = 0.015) -> FloatArray:
    noise = np.random.default_rng(0).standard_normal(COUNT)
    return quantum * np.round((9.8 + 3.0 * noise) / quantum)


@settings(deadline=None)
@given(first=st.integers(0, COUNT - 600), length=st.integers(60, 600))
def test_a_stuck_stretch_is_found_where_it_is(first: int, length: int) -> None:
    values = shaken()
    values[first : first + length] = 11.0
    found = find_stuck_force(force_of(values), distance_of(20.0))
    assert len(found.gone) == 1
    (begin, end) = found.gone[0]
    # A neighbour may read the same by chance.
    assert abs(begin - first) <= 1
    assert abs(end - first - length) <= 1
    np.testing.assert_array_equal(found.lasting, found.gone)
    assert "left.unsprung_specific_force: stuck" in found.warnings[0]


@pytest.mark.parametrize("speed", [0.0, 0.5])
def test_where_the_vehicle_stands_or_crawls_nothing_is_said(speed: float) -> None:
    values = shaken()
    values[5000:5500] = 9.8
    assert not len(find_stuck_force(force_of(values), distance_of(speed)).gone)


@pytest.mark.parametrize("hold", [1, 10, 40])
def test_slow_and_coarse_sensors_are_not_suspected(hold: int) -> None:
    slow = np.repeat(shaken()[: COUNT // hold + 1], hold)[:COUNT]
    coarse = np.round(slow / 2.0) * 2.0
    for values in (slow, coarse):
        assert not len(find_stuck_force(force_of(values), distance_of(20.0)).gone)


def test_missing_samples_are_not_stuck() -> None:
    values = shaken()
    values[5000:5500] = np.nan
    assert not len(find_stuck_force(force_of(values), distance_of(20.0)).gone)


def test_two_kinds_of_damage_are_one_where_they_touch() -> None:
    first = Damage(np.array([[10, 20], [40, 50]]), warnings=("one",))
    second = Damage(np.array([[15, 30], [50, 60]]), np.array([[15, 30]]), warnings=("two",))
    both = combine_damage(first, second)
    np.testing.assert_array_equal(both.gone, [[10, 30], [40, 60]])
    np.testing.assert_array_equal(both.lasting, [[15, 30]])
    assert both.warnings == ("one", "two")
