"""Readings that the Kalman filter leaves out are warnings of the main job."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from floatref.engine import run
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground import Scenario, simulate

PIPELINES = ("kalman-filter", "kalman-smoother-reflection", "kalman-smoother-constant-attitude")


@cache
def driven() -> Recording:
    scenario = Scenario(manoeuvre="stop", event_at_m=130.0, length_m=280.0, rate_hz=1000.0)
    return simulate(scenario).recording


def changed(name: str, change: Callable[[np.ndarray], np.ndarray]) -> Recording:
    def of(channel: Channel) -> Channel:
        if channel.id.name != name:
            return channel
        return replace(channel, values=change(channel.values.copy()))

    return replace(driven(), channels=tuple(of(channel) for channel in driven().channels))


def left_out(recording: Recording, pipeline: str) -> list[str]:
    result = run.run(recording, pipeline)
    return [line for line in result.warnings if "left out" in line]


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", PIPELINES)
def test_wild_velocities_are_told_once_for_both_wheel_paths(pipeline: str) -> None:
    name, wild = "gnss_vertical_velocity", [61, 90, 91]
    recording = changed(name, lambda x: x + 4.0 * np.isin(np.arange(x.size), wild))
    (line,) = left_out(recording, pipeline)
    assert line.startswith(f"channel {name}: 3 readings left out, more than 0.5 m/s")
    found = float(line.split("the first at ")[1].split(" s;")[0])
    # Within half a sample of the accelerometer.
    assert found == pytest.approx(driven().channel(name).times_s[61], abs=6e-4)


def test_what_is_not_read_is_not_told() -> None:
    recording = changed("gnss_vertical_velocity", lambda x: x + 4.0 * (np.arange(x.size) == 61))
    assert left_out(recording, "kalman-smoother-constant-height-attitude") == []
