"""A wheel path made by hand: a road of many waves, and what a device made of it."""

import numpy as np
import pytest

from floatref_conformance.resemblance.compared_path import STEP_M, ComparedPath


@pytest.fixture
def make_path():
    """Return a maker of a path of 400 m at 20 m/s, whose profile ``change`` makes of the road.

    The body moves by waves of its own, which ``change`` gets as the third argument.
    """

    def make(change, seed=0):
        draw = np.random.default_rng(seed)
        x = STEP_M * np.arange(4000)
        truth, body = np.zeros(x.size), np.zeros(x.size)
        for length in np.geomspace(1.0, 90.0, 40):
            for z, size in ((truth, 3e-4), (body, 2e-4)):
                z += size * length * np.sin(2 * np.pi * x / length + draw.uniform(0, 7))
        found = np.asarray(change(x, truth, body))
        none = np.zeros(x.size)
        speed = np.full(x.size, 20.0)
        return ComparedPath("left", x, truth, found, body, speed, none, none, found, STEP_M)

    return make
