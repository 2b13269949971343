"""A body heaves at a stop, its laser over an edge: the readings jump, the road stays."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.estimators.road_prior.forward import CLEARANCE, _let_go
from floatref.values.channels import ChannelId

RATE = 500
HEIGHT = ChannelId("floating_reference_height", "left")
laws = settings(deadline=None, max_examples=8)


def heaving(drive, seed):
    """Return a drive over a flat road with a stop from 8 to 14 s, and its true height."""
    drawn, rng = drive(0, 22.0, RATE, (8.0, 14.0)), np.random.default_rng(seed)
    times = np.arange(drawn.a.size) / RATE
    omega, rise = 2 * np.pi * 1.3, 0.004
    r = rise * np.sin(omega * times)
    a = -(omega**2) * r + 0.003 * rng.normal(size=times.size)
    return replace(drawn, a=a, h=0.3 + r + 3e-5 * rng.normal(size=times.size)), 0.3 + r


@pytest.mark.slow
@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    depth=st.floats(0.005, 0.05),
    first=st.floats(8.3, 10.0),
    lasts=st.floats(0.2, 2.0),
)
def test_an_edge_under_the_laser_leaves_the_height_as_it_is(
    drive, through, seed, depth, first, lasts
):
    whole, true = heaving(drive, seed)
    over = slice(round(first * RATE), round((first + lasts) * RATE))
    h = whole.h.copy()
    h[over] += depth
    edged = replace(whole, h=h)
    inside = slice(7 * RATE, 15 * RATE)

    def off(constants):
        found = through(RoadPriorSmoother(constants), edged)[HEIGHT]
        return np.ptp((found - true)[inside])

    assert off(RoadPrior()) < 1.5e-3
    assert off(RoadPrior(edge_sigmas=1e6)) > 0.3 * depth


class Edge(NamedTuple):
    """What the model says of edges: squared deviation, and variance of a reading in m²."""

    edge: float
    reading: float


@given(still_s=st.floats(0.0, 0.2))
def test_a_vehicle_has_to_stand_for_a_twentieth_of_a_second(still_s):
    covariance = np.zeros((8, 8))
    _let_go.py_func(Edge(36.0, 1e-8), 0.02, still_s, covariance)
    assert covariance[CLEARANCE, CLEARANCE] == (0.02**2 if still_s >= 0.05 else 0.0)
