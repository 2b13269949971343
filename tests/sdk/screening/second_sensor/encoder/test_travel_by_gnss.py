"""The encoder against places: scale, lost counts, lateness; slip of a hard brake is no fault."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.second_sensor.doubts import Doubt
from floatref.screening.second_sensor.encoder.travel_by_gnss import (
    FEWEST,
    RADIUS_M,
    _counted,
    encoder_doubts,
)
from floatref.values import scanning
from floatref.values.arrays import FloatArray
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording

RATE, GNSS_HZ, LENGTH_S = 100.0, 20.0, 40.0
TIMES = np.arange(int(RATE * LENGTH_S)) / RATE
LATITUDE = 0.8


def travel(times: FloatArray) -> FloatArray:
    """Return a drive at 20 m/s that slows to 10 m/s and speeds up again, in m."""
    return 15.0 * times + 5.0 * np.sin(2 * np.pi * times / LENGTH_S) * LENGTH_S / (2 * np.pi)


def recording(counted: FloatArray, course: float = 0.3, sigma_m: float = 0.01) -> Recording:
    """Return the encoder's ``counted`` beside places of the true travel on a ``course`` in rad."""
    times = np.arange(int(GNSS_HZ * LENGTH_S)) / GNSS_HZ
    source = np.random.default_rng(0)
    north = travel(times) * np.cos(course) + sigma_m * source.standard_normal(times.size)
    east = travel(times) * np.sin(course) + sigma_m * source.standard_normal(times.size)
    clock = UniformClock.of(GNSS_HZ)
    return Recording(
        (
            Channel.of("distance", counted, UniformClock.of(RATE)),
            Channel.of("gnss_latitude", LATITUDE + north / RADIUS_M, clock),
            Channel.of("gnss_longitude", -1.5 + east / RADIUS_M / np.cos(LATITUDE), clock),
            Channel.of("gnss_quality", np.full(times.size, 4.0), clock),
        )
    )


def doubts(counted: FloatArray) -> list[Doubt]:
    return list(encoder_doubts(recording(counted)))


@given(scale=st.floats(0.97, 1.03), course=st.floats(0.0, 6.0))
@settings(max_examples=20, deadline=None)
def test_a_calibrated_encoder_raises_no_doubt(scale: float, course: float) -> None:
    assert not list(encoder_doubts(recording(scale * travel(TIMES), course)))


@pytest.mark.parametrize(
    ("scale", "fatal"), [(0.5, True), (0.9, False), (1.06, False), (3.28, True)]
)
def test_a_scale_is_named_and_is_fatal_beyond_three_tenths(scale: float, fatal: bool) -> None:
    (doubt,) = doubts(scale * travel(TIMES))
    assert f"{scale:.3g} times" in doubt.line
    assert doubt.fatal == fatal
    assert doubt.whole_run


@pytest.mark.parametrize("share", [0.0, 0.5, 0.8])
def test_everything_behind_lost_counts_is_in_doubt(share: float) -> None:
    steps = np.diff(travel(TIMES), prepend=0.0)
    steps[(TIMES >= 15.0) & (TIMES < 18.0)] *= share
    (doubt,) = doubts(np.cumsum(steps))
    ((begin, end),) = doubt.spans
    assert 13.5 <= begin <= 15.5
    assert end == np.inf
    assert not doubt.fatal


def test_slip_of_a_hard_brake_is_no_fault() -> None:
    # 12 % per g in a brake of 0.8 g takes a tenth of the counts.
    steps = np.diff(travel(TIMES), prepend=0.0)
    steps[(TIMES >= 15.0) & (TIMES < 18.0)] *= 0.904
    assert not doubts(np.cumsum(steps))


def test_a_late_encoder_is_in_doubt_from_the_beginning() -> None:
    ((begin, _),) = doubts(travel(np.maximum(TIMES - 3.0, 0.0)))[0].spans
    assert begin == pytest.approx(0.0, abs=1.0)


@pytest.mark.parametrize("names", [["gnss_latitude"], ["gnss_longitude"], ["gnss_quality"]])
@pytest.mark.parametrize("known", [0, 1, FEWEST])
def test_places_that_are_no_numbers_are_no_places(names: list[str], known: int) -> None:
    """Without a warning of numpy, which is an error here; a few places give no ratio either."""
    whole = recording(3.0 * travel(TIMES))
    stride = round(GNSS_HZ)
    channels = []
    for channel in whole.channels:
        values = channel.values.copy()
        if str(channel.id) in names:
            values[known * stride :] = np.nan
        channels.append(replace(channel, values=values))
    assert not list(encoder_doubts(replace(whole, channels=tuple(channels))))


def test_without_places_there_is_no_doubt() -> None:
    alone = Recording(recording(3.0 * travel(TIMES)).channels[:1])
    assert not list(encoder_doubts(alone))


@given(
    count=st.integers(1, 60),
    missing=st.sets(st.integers(0, 59)),
    places=st.lists(st.floats(0.0, 0.59), max_size=20),
    stamped=st.booleans(),
)
def test_the_distance_at_a_time_is_the_same_in_pieces(
    count: int, missing: set[int], places: list[float], stamped: bool
) -> None:
    """Numpy's `interp` of the whole says what it has to be."""
    values = np.arange(count) + 0.3 * np.sin(np.arange(count))
    values[[k for k in missing if k < count]] = np.nan
    clock = UniformClock.of(RATE)
    encoder = Channel.of("distance", values, clock)
    if stamped:
        encoder = Channel.of("distance", values, StampedClock.of(clock.times(count) + 0.001))
    times, known = np.sort(np.array(places)), ~np.isnan(values)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scanning, "CHUNK", 7)
        found = _counted(encoder, times)
    if known.any():
        np.testing.assert_array_equal(
            found, np.interp(times, encoder.times_s[known], values[known])
        )
    else:
        assert np.isnan(found).all()


def test_an_encoder_of_hours_is_not_in_memory_as_a_whole() -> None:
    encoder = Channel.of("distance", np.zeros(4_000_000), UniformClock.of(16000.0))
    tracemalloc.start()
    _counted(encoder, np.arange(250.0))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # Times, flags and joined samples of a piece of 2 MiB; the times of all would be 32 MB.
    assert peak < 6 * 8 * scanning.CHUNK
