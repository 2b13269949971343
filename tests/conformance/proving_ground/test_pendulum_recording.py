"""The inverted pendulum through the pipelines: a flat road gets the bump of figure 2.21."""

from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref.measures import iri
from floatref_conformance.proving_ground.pendulum import (
    Pendulum,
    PendulumMotion,
    SinSquaredPulse,
    simulate_pendulum,
)
from floatref_conformance.proving_ground.pendulum_recording import pendulum_recording


@pytest.fixture(scope="module")
def motion() -> PendulumMotion:
    return simulate_pendulum(Pendulum(), SinSquaredPulse(start_s=10.0), 22.0, 1000.0)


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", ["temporal-basic", "spatial-basic"])
def test_the_pulse_leaves_a_bump_on_a_flat_road(motion: PendulumMotion, pipeline: str) -> None:
    profile = floatref.process(pendulum_recording(motion), pipeline)
    elevation = profile.tracks[0].elevation
    assert 0.005 < np.ptp(elevation) < 0.02
    section = slice(round(140.0 / 0.00508), round(300.9 / 0.00508))
    assert iri(elevation[section], 0.00508) == pytest.approx(0.038, rel=0.5)


def test_plumb_sensors_leave_the_road_flat(motion: PendulumMotion) -> None:
    plumb = replace(motion, body_vertical=motion.vertical, body_height=motion.height)
    profile = floatref.process(pendulum_recording(plumb), "temporal-basic")
    assert np.ptp(profile.tracks[0].elevation) < 1e-4
