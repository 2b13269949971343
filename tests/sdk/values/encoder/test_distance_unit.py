"""Whether a distance is suspected to be in km: its fastest speed decides, not its mean.

Law: a drive at walking speed or faster is not suspected, however long the vehicle stands in it; the
same in km or miles always is, and a leap of a damaged encoder does not hide it.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.clock import StampedClock, UniformClock
from floatref.values.encoder.plausible_distance import FASTEST_MPS, SLOWEST_MPS, check_distance
from floatref.values.recording import Channel, Clock

INTERVAL_M = 0.001
LARGEST_UNITS = {"km": 1000.0, "miles": 1609.344}
LONGEST_STOP_S = 12 * 3600.0
few = settings(deadline=None, max_examples=60)


def suspects(values: np.ndarray, clock: Clock) -> list[str]:
    """Return the warnings that name km."""
    channel = Channel.of("distance", values, clock)
    lines = check_distance(channel, channel.scan.summary, INTERVAL_M)
    return [line for line in lines if "if the distance is in km" in line]


@st.composite
def drives(draw, slowest_mps: float = 0.5, fastest_mps: float = 40.0) -> tuple[np.ndarray, Clock]:
    """Draw a drive in m that begins and ends at rest, with a stop of up to twelve hours in it."""
    rate = draw(st.sampled_from([2.0, 5.0, 13.7]))
    moving_s = draw(st.floats(15.0, 120.0))
    peak = draw(st.floats(slowest_mps, fastest_mps))
    speed = peak * np.minimum(1.0, 3.0 * np.sin(np.linspace(0.0, np.pi, int(moving_s * rate))))
    at = int(draw(st.floats(0.0, 1.0)) * speed.size)
    stop = np.zeros(int(draw(st.floats(0.0, LONGEST_STOP_S)) * rate))
    values = np.cumsum(np.concatenate([speed[:at], stop, speed[at:]])) / rate
    if not draw(st.booleans()):
        return values, UniformClock.of(rate, start_s=draw(st.floats(0.0, 1e6)))
    # The counts alone, as of an encoder that stamps them: no sample while the vehicle stands.
    moves = np.diff(values, prepend=-1.0) > 0
    return values[moves], StampedClock.of(np.flatnonzero(moves) / rate)


@few
@given(drive=drives())
def test_no_standstill_makes_a_drive_in_m_suspected(drive) -> None:
    assert suspects(*drive) == []


@few
@given(drive=drives(fastest_mps=0.99 * FASTEST_MPS), unit=st.sampled_from(sorted(LARGEST_UNITS)))
def test_a_drive_in_km_or_miles_is_suspected_with_or_without_a_standstill(drive, unit) -> None:
    values, clock = drive
    (line,) = suspects(values / LARGEST_UNITS[unit], clock)
    assert float(line.split("at most ")[1].split(" ")[0]) < SLOWEST_MPS


@few
@given(drive=drives(fastest_mps=0.3 * FASTEST_MPS), per_m=st.sampled_from([1.0, 1 / 0.3048]))
def test_feet_are_no_km(drive, per_m) -> None:
    values, clock = drive
    assert suspects(values * per_m, clock) == []


@few
@given(
    drive=drives(fastest_mps=0.99 * FASTEST_MPS),
    leaps=st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.1, 20.0)), min_size=1, max_size=4),
)
def test_two_leaps_in_ten_seconds_do_not_hide_a_distance_in_km(drive, leaps) -> None:
    values, clock = drive
    values, seconds = values / 1000.0, np.arange(values.size) * np.diff(clock.times(2))[0]
    places: list[int] = []
    for at, size in sorted(leaps):
        first = int(at * (values.size - 1))
        if len(places) < 2 or seconds[first] - seconds[places[-2]] > 20.0:
            values[first + 1 :] += size
            places.append(first)
    assert len(suspects(values, clock)) == 1


@pytest.mark.parametrize(("seconds", "count"), [(9.0, 0), (12.0, 1)])
def test_ten_seconds_are_needed_for_a_suspicion(seconds: float, count: int) -> None:
    times = np.arange(0.0, seconds, 0.1)
    assert len(suspects(0.02 * times, UniformClock.of(10.0))) == count


def test_few_samples_far_apart_have_a_speed() -> None:
    for size in (2, 3, 30):
        times = 20.0 * np.arange(size)
        assert suspects(15.0 * times, StampedClock.of(times)) == []
        assert len(suspects(0.015 * times, StampedClock.of(times))) == 1
