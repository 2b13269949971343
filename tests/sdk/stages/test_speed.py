"""Travel speed is the encoder's progress over the window before."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.stages.speed import TravelSpeed
from floatref.values.arrays import Flag
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId
from floatref_reference.chapter_5 import section_5_6

DISTANCE, SPEED = ChannelId("distance"), ChannelId("travel_speed")
RATE = 1000
HEADER = Header(Axis.TIME, 1 / RATE, 0.0, Fraction(RATE), frozenset({DISTANCE}), ("main",))


def run(distance, window_s=0.05):
    stage = TravelSpeed(window_s)
    stage.start(HEADER)
    out = stage.push(Block(0, {DISTANCE: distance}))
    return out[SPEED], out.flags.get(SPEED, np.zeros(len(out), np.uint8))


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 2**32 - 1))
def test_speed_is_that_of_the_equation(seed):
    distance = 0.0003 * np.random.default_rng(seed).integers(0, 90, 200).cumsum()
    expected = section_5_6.travel_speed(distance, RATE)
    assert run(distance)[0] == pytest.approx(expected.astype(float), abs=1e-12)


def test_a_steady_drive_has_its_speed_after_one_window():
    speed, flags = run(7.0 * np.arange(200) / RATE + 30.0)
    assert speed[0] == 0.0
    assert speed[50:] == pytest.approx(7.0)
    assert (np.diff(speed[:51]) > 0).all()
    assert not flags.any()


def test_a_window_below_one_sample_is_one_sample():
    distance = np.array([0.0, 0.1, 0.3])
    assert run(distance, window_s=1e-6)[0] == pytest.approx([0.0, 100.0, 200.0])


def kept(distance, samples):
    """Speed as the stage defines it, one sample at a time."""
    known = distance.copy()
    first = int(np.argmax(~np.isnan(distance)))
    known[:first] = distance[first]
    wide, speeds = np.concatenate((np.full(samples, distance[first]), known)), [0.0]
    for k in range(distance.size):
        window = wide[k : k + samples + 1]
        missing = np.isnan(window).any()
        speeds.append(speeds[-1] if missing else (window[-1] - window[0]) * RATE / samples)
    return speeds[1:]


@settings(deadline=None, max_examples=30)
@given(lost=st.sets(st.integers(0, 199), max_size=60), samples=st.integers(1, 60))
def test_the_last_speed_is_kept_while_a_distance_is_missing_in_the_window(lost, samples):
    distance = np.random.default_rng(len(lost)).uniform(0.0, 0.02, 200).cumsum()
    distance[list(lost)] = np.nan
    distance[199] = 3.0
    speed, flags = run(distance, samples / RATE)
    assert speed == pytest.approx(kept(distance, samples), abs=1e-9)
    assert set(np.flatnonzero(flags == Flag.MISSING)) == lost - {199}


def test_only_a_stream_in_time_has_it():
    header = Header(Axis.DISTANCE, 0.1, 0.0, Fraction(9), frozenset({DISTANCE}), ("main",))
    with pytest.raises(InputError, match="not on the time axis"):
        TravelSpeed().start(header)
