"""The half car of Zhu, the trailer of Imine and a van, driven over a road by the proving ground."""

import numpy as np
import pytest

from floatref.engine.run import run
from floatref.errors import InputError
from floatref.measures import iri
from floatref.values.recording import Recording
from floatref_conformance.proving_ground import Scenario, simulate

PIPELINES = pytest.mark.parametrize("pipeline", ["response-joint-input-state", "response-observer"])
SHORT_M = 0.5
"""Waves that a tyre levels are left out of what is compared."""


FAINT = 0.01
"""Of the sensors' errors: without any, accelerometers on a level lead-in would be stuck."""


def driven(vehicle: str, sensors: float = FAINT, **numbers):
    numbers = {"speed_kmh": 72.0, "length_m": 300.0, "rate_hz": 1000.0, **numbers}
    tracks = ("left", "right") if vehicle == "imine-trailer" else ("main",)
    interval = {"imu": False, "gnss": False, "profile_interval_m": 0.05}
    return simulate(
        Scenario(vehicle=vehicle, sensors=sensors, tracks=tracks, **interval, **numbers)
    )


def agreement(track, true: np.ndarray, interval_m: float) -> float:
    """Return the correlation of what waves of 0.5 to 40 m leave of both."""
    size = min(track.elevation.size, true.size)
    valid = track.valid[:size]
    first, last = np.flatnonzero(valid)[[0, -1]]
    inner = slice(first, last)

    def banded(z: np.ndarray) -> np.ndarray:
        def mean(length_m: float) -> np.ndarray:
            points = round(length_m / interval_m)
            return np.convolve(z, np.ones(points) / points, "same")

        return mean(SHORT_M) - mean(20.0)

    made, road = banded(np.nan_to_num(track.elevation[:size])), banded(true[:size])
    return float(np.corrcoef(made[inner], road[inner])[0, 1])


@pytest.mark.slow
@PIPELINES
@pytest.mark.parametrize("vehicle", ["quarter-car", "zhu-half-car"])
def test_a_model_in_the_middle_tells_the_road_there(vehicle, pipeline):
    drive = driven(vehicle)
    profile = run(drive.recording, pipeline).profile
    track, true = profile.tracks[0], drive.truth.tracks[0].elevation
    assert track.valid.mean() > 0.5
    assert agreement(track, true, profile.interval_m) > 0.99


@pytest.mark.slow
@PIPELINES
def test_the_trailer_tells_the_road_under_both_wheels(pipeline):
    drive = driven("imine-trailer")
    profile = run(drive.recording, pipeline).profile
    left, right = profile.tracks
    roads = [drive.truth.track(name).elevation for name in ("left", "right")]
    assert agreement(left, roads[0], profile.interval_m) > 0.98
    assert agreement(right, roads[1], profile.interval_m) > 0.98
    across = agreement(left, roads[1], profile.interval_m)
    assert across < agreement(left, roads[0], profile.interval_m) - 0.005


def without(recording: Recording, *names: str) -> Recording:
    kept = tuple(c for c in recording.channels if c.id.name not in names)
    return Recording(kept, recording.setup)


@pytest.mark.slow
def test_the_response_alone_is_looked_at():
    """A height, or the profiler's own accelerometer, makes no difference."""
    recording = driven("zhu-half-car", length_m=150.0).recording
    alone = without(recording, "height", "vertical_specific_force")
    one, other = (
        run(r, "response-observer").profile.tracks[0].elevation for r in (recording, alone)
    )
    np.testing.assert_array_equal(one, other)


def test_accelerometers_alone_are_integrated():
    drive = driven("zhu-half-car")
    gone = [c.id.name for c in drive.recording.channels]
    gone = [n for n in gone if n.endswith(("_displacement", "_velocity", "deflection"))]
    profile = run(without(drive.recording, *gone), "response-joint-input-state").profile
    true = drive.truth.tracks[0].elevation
    assert agreement(profile.tracks[0], true, profile.interval_m) > 0.99


@PIPELINES
def test_a_wheel_without_its_accelerometer_is_named(pipeline):
    recording = driven("zhu-half-car", length_m=100.0).recording
    with pytest.raises(InputError, match=r"rear.wheel|rear_unsprung_specific_force") as caught:
        run(without(recording, "rear_unsprung_specific_force"), pipeline)
    assert "\n" not in str(caught.value)


def test_a_trailer_needs_the_wheel_paths_of_its_tyres():
    recording = driven("imine-trailer", length_m=100.0).recording
    kept = tuple(c for c in recording.channels if c.id.track != "right")
    with pytest.raises(InputError, match=r"^channel right\.unsprung_specific_force: missing"):
        run(Recording(kept, recording.setup), "response-observer")


INTERVAL_M = 0.025


@pytest.mark.slow
@PIPELINES
@pytest.mark.parametrize("seed", [0, 3])
def test_a_van_tells_the_road_within_its_sigma(high_passed_road, pipeline, seed):
    """Seven freedoms, estimated by a quarter car with parameters 3 % off."""
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
