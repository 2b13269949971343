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
    "pipeline", ["temporal-basic", "spatial-hpf", "kalman-smoother", "response-observer"]
)
def test_pipelines_work_as_without_them(pipeline: str) -> None:
    plain = floatref.process(simulate(PLAIN).recording, pipeline)
    more = floatref.process(simulate(MORE).recording, pipeline)
    for old, new in zip(plain.tracks, more.tracks, strict=True):
        assert np.array_equal(old.elevation, new.elevation, equal_nan=True)
        assert np.array_equal(old.valid, new.valid)


@pytest.mark.parametrize("kind", ["quiescent", "bounce"])
def test_a_parked_vehicle_travels_by_its_encoders_alone(kind: str) -> None:
    parked = Scenario(manoeuvre=kind, rate_hz=1000.0, encoder_per_side=True, sensors=0.0)
    wheels = simulate(parked).recording
    assert np.array_equal(
        wheels.channel("wheel_distance", "left").values, wheels.channel("distance").values
    )
    for source, name in CHANNEL.items():
        channel = simulate(replace(parked, second_distance=source)).recording.channel(name)
        limit = 0.3 if (kind, source) == ("bounce", "gnss") else 1e-3
        assert np.abs(channel.values).max() < limit


def test_an_unknown_source_is_refused() -> None:
    with pytest.raises(InputError, match=r"second_distance 'opticl': unknown; did you mean"):
        Scenario(second_distance="opticl")
