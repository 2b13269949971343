"""The proving ground's van, seven freedoms, told by a quarter car with parameters 3 % off."""

import numpy as np
import pytest

from floatref.engine.run import run
from floatref.measures import iri
from floatref_conformance.proving_ground import Scenario, simulate

INTERVAL_M = 0.025


@pytest.mark.parametrize("pipeline", ["response-joint-input-state", "response-observer"])
@pytest.mark.parametrize("seed", [0, 3])
def test_the_road_is_told_within_its_sigma(high_passed_road, pipeline, seed):
    numbers = {"imu": False, "gnss": False, "tracks": ("left",), "rate_hz": 1000.0}
    drive = simulate(Scenario(seed=seed, profile_interval_m=INTERVAL_M, **numbers))
    track = run(drive.recording, pipeline).profile.tracks[0]
    size = min(track.elevation.size, drive.truth.tracks[0].elevation.size)
    road = high_passed_road(drive.truth.tracks[0].elevation, 20.0, INTERVAL_M)[:size]
    valid = track.valid[:size]
    first, last = np.flatnonzero(valid)[[0, -1]]
    made, true = track.elevation[first:last], road[first:last]
    assert valid.mean() > 0.7
    assert iri(made, INTERVAL_M) == pytest.approx(iri(true, INTERVAL_M), rel=0.05)
    assert np.corrcoef(made, true)[0, 1] > 0.92
    assert np.mean(np.abs(made - true) < 2.0 * track.sigma[first:last]) > 0.9
