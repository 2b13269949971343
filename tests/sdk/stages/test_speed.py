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


def run(distance, cut=0, window_s=0.05):
    stage = TravelSpeed(window_s)
    stage.start(HEADER)
    parts = [Block(0, {DISTANCE: distance[:cut]}), Block(cut, {DISTANCE: distance[cut:]})]
    out = [stage.push(part) for part in parts if len(part)]
    flags = [b.flags.get(SPEED, np.zeros(len(b), np.uint8)) for b in out]
    return np.concatenate([b[SPEED] for b in out]), np.concatenate(flags)


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 2**32 - 1), cut=st.integers(0, 199))
def test_speed_is_that_of_the_equation(seed, cut):
    distance = 0.0003 * np.random.default_rng(seed).integers(0, 90, 200).cumsum()
    expected = section_5_6.travel_speed(distance, RATE)
    assert run(distance, cut)[0] == pytest.approx(expected.astype(float), abs=1e-12)


def test_a_steady_drive_has_its_speed_after_one_window():
    speed, flags = run(7.0 * np.arange(200) / RATE + 30.0)
    assert speed[0] == 0.0
    assert speed[50:] == pytest.approx(7.0)
    assert (np.diff(speed[:51]) > 0).all()
    assert not flags.any()


def test_a_window_below_one_sample_is_one_sample():
    distance = np.array([0.0, 0.1, 0.3])
    assert run(distance, window_s=1e-6)[0] == pytest.approx([0.0, 100.0, 200.0])


@pytest.mark.parametrize("cut", [0, 5, 12])
def test_a_missing_distance_is_the_last_known_and_flagged(cut):
    distance = np.arange(20.0)
    known = distance.copy()
    known[10:13] = 9.0
    known[:2] = distance[2]
    distance[[0, 1, 10, 11, 12]] = np.nan
    speed, flags = run(distance, cut, window_s=0.004)
    np.testing.assert_array_equal(speed, run(known, window_s=0.004)[0])
    assert set(np.flatnonzero(flags == Flag.MISSING)) == {0, 1, 10, 11, 12}


def test_only_a_stream_in_time_has_it():
    header = Header(Axis.DISTANCE, 0.1, 0.0, Fraction(9), frozenset({DISTANCE}), ("main",))
    with pytest.raises(InputError, match="not on the time axis"):
        TravelSpeed().start(header)
