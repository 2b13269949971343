"""Where a height sensor dropped out."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.intake.height_gaps import height_gaps
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

RATE, SPEED, COUNT = 1000, 20.0, 5000
NONE = np.empty((0, 2), dtype=np.int64)


def recording_of(height: FloatArray, times: FloatArray | None = None) -> Recording:
    clock = UniformClock.of(RATE) if times is None else StampedClock(times)
    travel = SPEED / RATE * np.arange(COUNT)
    return Recording(
        (
            Channel.of("height", height, clock),
            Channel.of("distance", travel, UniformClock.of(RATE)),
        )
    )


def heights() -> FloatArray:
    return 0.3 + 1e-3 * np.random.default_rng(0).standard_normal(COUNT)


@given(first=st.integers(1, 4000), length=st.integers(13, 900))
def test_a_gap_lies_between_the_samples_that_measure(first: int, length: int) -> None:
    values = heights()
    values[first : first + length] = np.nan
    found = height_gaps(recording_of(values), "main", NONE)
    expected = SPEED / RATE * np.array([[first - 1, first + length]])
    np.testing.assert_allclose(found, expected, atol=1e-9)


@given(length=st.integers(1, 9))
def test_what_a_line_bridges_is_no_gap(length: int) -> None:
    values = heights()
    values[2000 : 2000 + length] = np.nan
    assert len(height_gaps(recording_of(values), "main", NONE)) == 0


def test_damaged_and_missing_samples_side_by_side_are_one_gap() -> None:
    values = heights()
    values[1000:1100] = np.nan
    gone = np.array([[1100, 1200], [3000, 3002], [4000, 4100]])
    found = height_gaps(recording_of(values), "main", gone)
    np.testing.assert_allclose(found, SPEED / RATE * np.array([[999, 1200], [3999, 4100]]))


def test_a_gap_at_an_end_is_open() -> None:
    values = heights()
    values[:100] = values[-100:] = np.nan
    found = height_gaps(recording_of(values), "main", NONE)
    np.testing.assert_allclose(found, [[-np.inf, 2.0], [SPEED / RATE * 4899, np.inf]])


def test_a_hole_between_time_stamps_is_a_gap() -> None:
    kept = np.r_[0:2000, 2300:COUNT]
    found = height_gaps(recording_of(heights()[kept], kept / RATE), "main", NONE)
    np.testing.assert_allclose(found, SPEED / RATE * np.array([[1999, 2300]]), atol=1e-9)


def test_places_are_told_where_the_encoder_is_silent_as_well() -> None:
    values, travel = heights(), SPEED / RATE * np.arange(COUNT)
    values[2000:2300] = np.nan
    travel[1990:2100] = np.nan
    clock = UniformClock.of(RATE)
    channels = Channel.of("height", values, clock), Channel.of("distance", travel, clock)
    found = height_gaps(Recording(channels), "main", NONE)
    np.testing.assert_allclose(found, SPEED / RATE * np.array([[1999, 2300]]), atol=1e-9)


def test_an_encoder_on_its_own_times_tells_the_place() -> None:
    values = heights()
    values[2000:2300] = np.nan
    ticks = np.sort(np.random.default_rng(1).uniform(0.0, 5.0, 400))
    channels = (
        Channel.of("height", values, UniformClock.of(RATE)),
        Channel.of("distance", SPEED * ticks, StampedClock(ticks)),
    )
    found = height_gaps(Recording(channels), "main", NONE)
    np.testing.assert_allclose(found, SPEED / RATE * np.array([[1999, 2300]]), atol=1e-9)
