"""Recordings with more sources of distance: nothing else changes, and they are processed alike."""

from dataclasses import replace

import numpy as np
import pytest

import floatref
from floatref.errors import InputError
from floatref_conformance.proving_ground.scenario import SECOND_DISTANCES, Scenario
from floatref_conformance.proving_ground.simulate import Simulation, simulate

PLAIN = Scenario(seed=2, length_m=120.0, curvature_per_km=4.0, rate_hz=2000.0)
MORE = replace(PLAIN, encoder_per_side=True, second_distance="optical")
CHANNEL = {"gnss": "gnss_speed", "can": "wheel_speed", "optical": "optical_distance"}


def names(simulation: Simulation) -> list[str]:
    return [str(channel.id) for channel in simulation.recording.channels]


@pytest.mark.parametrize("kind", [k for k in SECOND_DISTANCES if k != "none"])
def test_a_source_adds_its_channel_and_changes_no_other(kind: str) -> None:
    plain = simulate(PLAIN)
    more = simulate(replace(PLAIN, second_distance=kind))
    assert names(more) == [*names(plain), CHANNEL[kind]]
    for old, new in zip(plain.recording.channels, more.recording.channels, strict=False):
        assert np.array_equal(old.values, new.values)


def test_every_wheel_path_has_an_encoder_of_its_own() -> None:
    recording = simulate(MORE).recording
    wheels = {t: recording.channel("wheel_distance", t).values for t in recording.tracks}
    assert names(simulate(MORE))[-3:] == [
        *(f"{t}.wheel_distance" for t in wheels),
        CHANNEL["optical"],
    ]
    lead = wheels["right"][-1] - wheels["left"][-1]
    assert lead == pytest.approx(0.004 * 2 * 0.86 * 120.0, abs=2 * 3e-4 * 120.0 + 0.01)
    only = simulate(replace(MORE, tracks=("main",))).recording
    assert only.channel("wheel_distance").id.track is None


@pytest.mark.parametrize(
    "pipeline",
    [
        "temporal-basic",
        "spatial-hpf",
        "kalman-smoother",
        pytest.param("road-prior-smoother", marks=pytest.mark.slow),
        pytest.param("response-observer", marks=pytest.mark.slow),
    ],
)
def test_pipelines_work_as_without_them(pipeline: str) -> None:
    plain = floatref.process(simulate(PLAIN).recording, pipeline)
    more = floatref.process(simulate(MORE).recording, pipeline)
    for old, new in zip(plain.tracks, more.tracks, strict=True):
        assert np.array_equal(old.elevation, new.elevation, equal_nan=True)
        assert np.array_equal(old.valid, new.valid)


@pytest.mark.parametrize("kind", ["quiescent", "bounce"])
def test_a_parked_vehicle_travels_by_its_encoders_alone(kind: str) -> None:
    parked = replace(MORE, manoeuvre=kind, rate_hz=1000.0, sensors=0.0)
    wheels = simulate(parked).recording
    assert np.array_equal(
        wheels.channel("wheel_distance", "left").values, wheels.channel("distance").values
    )
    for source, name in CHANNEL.items():
        channel = simulate(replace(parked, second_distance=source)).recording.channel(name)
        limit = 0.3 if (kind, source) == ("bounce", "gnss") else 1e-3
        assert np.abs(channel.values).max() < limit


def test_a_parked_antenna_swings_about_the_reference_points() -> None:
    """Its speed is the rate of its horizontal place, by (6.23), which bouncing changes."""
    bounce = replace(MORE, manoeuvre="bounce", rate_hz=1000.0, second_distance="gnss", sensors=0.0)
    simulation = simulate(bounce)
    motion, setup = simulation.motion, simulation.recording.setup
    x, y, z = np.subtract(
        setup.gnss_antenna_offset_m, (*setup.tracks["left"].reference_point_m[:1], 0.0, 0.0)
    )
    z -= setup.tracks["left"].reference_point_m[2]
    sin, cos = np.sin, np.cos
    ahead = x * cos(motion.pitch) + sin(motion.pitch) * (
        y * sin(motion.roll) + z * cos(motion.roll)
    )
    across = y * cos(motion.roll) - z * sin(motion.roll)
    speed = np.hypot(np.gradient(ahead, 1e-3), np.gradient(across, 1e-3))
    found = simulation.recording.channel("gnss_speed")
    assert found.values.max() > 0.02
    expected = np.interp(found.times_s, motion.times_s, speed)
    assert found.values == pytest.approx(expected, abs=0.02 * expected.max())


def test_an_unknown_source_is_refused() -> None:
    with pytest.raises(InputError, match=r"second_distance 'opticl': unknown; did you mean"):
        Scenario(second_distance="opticl")
