"""A drive is told by its encoder: how fast, how slow, how it gains and loses speed."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.mutants.drive_conditions import Drive, apply_when

RATE = 1000.0


def driven(times_s, speeds_kmh, start_m=0.0):
    """Return the recording of an encoder: speeds at some times, straight lines between."""
    times = np.arange(0.0, times_s[-1], 1 / RATE)
    speed = np.interp(times, times_s, speeds_kmh) / 3.6
    distance = start_m + np.concatenate(([0.0], np.cumsum((speed[1:] + speed[:-1]) / 2 / RATE)))
    return Recording((Channel.of("distance", distance, UniformClock.of(RATE)),))


@settings(deadline=None, max_examples=10)
@given(speed=st.floats(4.0, 110.0), start=st.floats(-1e3, 1e5))
def test_a_steady_drive(speed, start):
    drive = Drive.of(driven([0.0, 20.0], [speed, speed], start))
    assert drive.slowest_kmh == pytest.approx(speed, rel=1e-6)
    assert drive.fastest_kmh == pytest.approx(speed, rel=1e-6)
    assert drive.is_steady
    assert not drive.begins_standing
    assert drive.gained_kmh(-1.0, -0.01, 0.0) == 0.0


def test_a_brake_and_a_stop():
    drive = Drive.of(driven([0.0, 5.0, 10.0, 20.0, 30.0], [72.0, 72.0, 0.0, 0.0, 36.0]))
    assert drive.slowest_kmh == pytest.approx(0.0, abs=1e-9)
    assert drive.slowest_m == pytest.approx(150.0, abs=0.5)
    assert not drive.is_steady
    assert not drive.begins_standing
    assert drive.lost_kmh == pytest.approx(36.0, abs=3.0)
    assert drive.slow_s(36.0) == pytest.approx(22.0, abs=0.5)
    deceleration = 20.0 / 5.0 / 9.80665
    lost = drive.gained_kmh(-1.1 * deceleration, -0.9 * deceleration, 0.0)
    assert lost == pytest.approx(72.0, abs=20.0)
    assert drive.gained_kmh(-0.2, -0.1, 0.0) < 2.0


def test_a_start_from_rest():
    drive = Drive.of(driven([0.0, 5.0, 15.0, 20.0], [0.0, 0.0, 50.0, 50.0]))
    assert drive.begins_standing
    assert drive.slowest_m == pytest.approx(0.0, abs=0.1)
    assert drive.gained_kmh(0.1, 0.2, 16.0) > 20.0


def test_missing_counts_and_counts_back_do_not_matter():
    sound = driven([0.0, 20.0], [50.0, 50.0])
    distance = np.array(sound.channel("distance").values)
    distance[5000:5100], distance[9000] = np.nan, distance[9000] - 0.05
    hurt = Recording((Channel.of("distance", distance, UniformClock.of(RATE)),))
    assert Drive.of(hurt).slowest_kmh == pytest.approx(50.0, abs=0.5)


def test_an_encoder_that_is_silent_seems_slow_for_less_than_its_silence():
    distance = np.array(driven([0.0, 20.0], [50.0, 50.0]).channel("distance").values)
    distance[9000:10000] = distance[9000]
    hurt = Drive.of(Recording((Channel.of("distance", distance, UniformClock.of(RATE)),)))
    assert hurt.slowest_kmh < 6.0
    assert hurt.slow_s(16.0) < 1.0


def test_a_mistake_is_made_in_some_drives_only():
    spoil = apply_when(lambda drive: drive.slowest_kmh > 40.0, lambda profile, recording: "spoilt")
    assert spoil("sound", driven([0.0, 9.0], [50.0, 50.0])) == "spoilt"
    assert spoil("sound", driven([0.0, 9.0], [30.0, 30.0])) == "sound"
