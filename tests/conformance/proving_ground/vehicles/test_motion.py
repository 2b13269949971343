"""A recording slower than the model has the model's motion, its accelerations averaged."""

import numpy as np
import pytest

from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.vehicles.motion import BodyMotion
from floatref_conformance.proving_ground.vehicles.response import LOWEST_RATE_HZ

AVERAGED = ("longitudinal", "lateral", "vertical", "acceleration")
KEPT = ("range_m", "height_m", "velocity", "road_m")


def driven(rate_hz: float) -> BodyMotion:
    scenario = Scenario(seed=5, speed_kmh=60.0, length_m=40.0, rate_hz=rate_hz, tracks=("left",))
    return simulate(scenario).motion


@pytest.mark.parametrize("every", [2, 4])
def test_a_slower_recording_has_every_nth_sample_and_averages_around_it(every: int) -> None:
    slow, fast = driven(LOWEST_RATE_HZ / every), driven(LOWEST_RATE_HZ)
    centres = every * np.arange(slow.distance.size)
    for name in KEPT:
        of_fast = getattr(fast.tracks["left"], name)[centres]
        np.testing.assert_array_equal(getattr(slow.tracks["left"], name), of_fast)
    for name in AVERAGED:
        of_fast = getattr(fast.tracks["left"], name)[: centres[-1] + 1]
        mean = np.zeros(centres.size)
        for offset in range(-every // 2, every // 2 + 1):
            weight = (0.5 if abs(offset) == every // 2 else 1.0) / every
            mean += weight * of_fast[np.clip(centres + offset, 0, centres[-1])]
        np.testing.assert_array_equal(getattr(slow.tracks["left"], name), mean)
