"""A recording of a vehicle at rest whose noise is known, and `floatref allan` on it."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

from floatref.files import write_recording
from floatref.values.channels import STANDARD_GRAVITY, ChannelId
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

GYRO = {"roll_rate": 1.4e-5, "pitch_rate": 2.8e-5, "yaw_rate": 0.7e-5}
"""Densities in rad/s/√Hz."""
WALK = 1e-5
FORCE = {"left": 5e-5, "right": 8e-5}
"""Densities in m/s²/√Hz."""


def white(density: float, rate_hz: float, count: int, seed: int = 0) -> np.ndarray:
    return density * np.sqrt(rate_hz) * np.random.default_rng(seed).normal(size=count)


def still_vehicle() -> dict[ChannelId, Channel]:
    """Six minutes of gyros, of which one walks, and of the accelerometers of two wheel paths."""
    gyro, force, gnss = (UniformClock.of(x) for x in (50.0, 100.0, 10.0))
    channels = []
    for seed, (name, density) in enumerate(GYRO.items()):
        channels.append(Channel.of(name, 1e-3 + white(density, 50.0, 18_000, seed), gyro))
    steps = np.random.default_rng(7).normal(size=18_000)
    walk = WALK / np.sqrt(50.0) * np.cumsum(steps)
    channels[0] = Channel.of("roll_rate", channels[0].values + walk, gyro)
    for seed, (track, density) in enumerate(FORCE.items(), 10):
        x = STANDARD_GRAVITY + white(density, 100.0, 36_000, seed)
        channels.append(Channel.of("vertical_specific_force", x, force, track))
    channels.append(Channel.of("gnss_height", 250.0 + white(1e-3, 10.0, 3600, 20), gnss))
    channels.append(Channel.of("gnss_quality", np.full(3600, 4.0), gnss))
    channels.append(Channel.of("distance", np.zeros(36_000), force))
    return {channel.id: channel for channel in channels}


def record(folder: Path, *changed: Channel) -> Path:
    channels = still_vehicle() | {channel.id: channel for channel in changed}
    write_recording(Recording(tuple(channels.values())), folder / "still")
    return folder / "still"


@pytest.fixture(scope="session")
def noise() -> Callable[..., np.ndarray]:
    return white


@pytest.fixture(scope="session")
def channels() -> dict[ChannelId, Channel]:
    return still_vehicle()


@pytest.fixture(scope="session")
def densities() -> dict[str, float]:
    drawn = {f"{name}_density": density for name, density in GYRO.items()}
    return {**drawn, "acceleration_density": max(FORCE.values()), "roll_rate_walk": WALK}


@pytest.fixture(scope="session")
def written() -> Callable[..., Path]:
    return record


@pytest.fixture
def still(tmp_path: Path) -> Path:
    return record(tmp_path)


@pytest.fixture(scope="session")
def run(invoke: Callable[..., Result]) -> Callable[..., Result]:
    return partial(invoke, "allan")


@pytest.fixture(scope="session")
def report(reported: Callable[..., dict[str, Any]]) -> Callable[..., dict[str, Any]]:
    return partial(reported, "allan")


@pytest.fixture(scope="session")
def refused(refused: Callable[..., str]) -> Callable[..., str]:
    return partial(refused, "allan")
