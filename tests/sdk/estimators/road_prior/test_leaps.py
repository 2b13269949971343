"""A height sensor that leaps at a standstill: the place is flagged, and the user is told."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPriorSmoother
from floatref.values.arrays import Flag
from floatref.values.channels import ChannelId

HEIGHT = ChannelId("floating_reference_height", "left")
RATE, STOP = 200, (6.0, 10.0)


def standing(drive, seed, leap_m, at_s):
    drawn = drive(seed, 16.0, RATE, STOP)
    noise = np.random.default_rng(seed).normal(size=(2, drawn.a.size))
    height = 0.3 + 4e-5 * noise[0]
    height[round(at_s * RATE) :] += leap_m
    return replace(drawn, a=1e-3 * noise[1], h=height)


@settings(deadline=None, max_examples=10)
@given(
    seed=st.integers(0, 2**32 - 1),
    leap_m=st.floats(0.015, 0.3),
    down=st.booleans(),
    at_s=st.floats(8.0, 9.5),
    cuts=st.sets(st.integers(1, 16 * RATE - 1), max_size=5),
)
def test_a_leap_is_flagged_and_told(drive, through, seed, leap_m, down, at_s, cuts):
    stage = RoadPriorSmoother()
    by_m = -leap_m if down else leap_m
    out = through(stage, standing(drive, seed, by_m, at_s), cuts)
    flags = out.flags.get(HEIGHT, np.zeros(len(out), np.uint8))
    slow = np.flatnonzero(flags & np.uint8(Flag.SLOW))
    assert slow.size
    assert abs(slow[0] - at_s * RATE) <= 1.0
    (line,) = stage.warnings()
    assert "height, left" in line
    (found_mm,) = re.findall(r"leaps by (\d+) mm", line)
    assert abs(float(found_mm) - 1e3 * leap_m) <= 1.0


@pytest.mark.parametrize("leap_m", [0.0, 0.005])
def test_an_edge_of_the_road_is_no_leap(drive, through, leap_m):
    stage = RoadPriorSmoother()
    out = through(stage, standing(drive, 1, leap_m, 8.5))
    assert not (out.flags.get(HEIGHT, np.zeros(1, np.uint8)) & np.uint8(Flag.SLOW)).any()
    assert stage.warnings() == ()


def test_while_it_moves_nothing_is_a_leap(drive, through):
    stage = RoadPriorSmoother()
    through(stage, standing(drive, 2, 0.05, 3.0))
    assert stage.warnings() == ()
