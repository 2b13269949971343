"""A quarter car driven over a road, from its equations: what its sensors measure."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass

import numpy as np
import pytest
from scipy.linalg import expm

from floatref.engine.run import run
from floatref.kernels.memories import STATE_VARIABLE
from floatref.kernels.state_variable import high_pass_1, high_pass_2
from floatref.stages.filters.schedule import AdaptiveCutOff
from floatref.values.arrays import new_record
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup, TrackSetup, VehicleSetup
from floatref.vehicle_response import IMINE_TRAILER, ZHU_HALF_CAR, QuarterCar

G = 9.80665
RATE = 1000.0
SECTIONS = (high_pass_1, False), (high_pass_2, False), (high_pass_2, True), (high_pass_1, True)
FAINT = 1e-9
"""No sensor is without noise: on a level road it would be stuck."""
CAR = {
    "sprung_kg": 700.0,
    "unsprung_kg": 75.0,
    "suspension_n_per_m": 45000.0,
    "suspension_ns_per_m": 3300.0,
    "tyre_n_per_m": 320000.0,
    "tyre_ns_per_m": 0.0,
}


def motion(road: np.ndarray, car: Mapping[str, float] = CAR, rate: float = RATE):
    """Return (z_s, z_u, z_s'', z_u'') over ``road``, linear between samples, from rest on it."""
    m, w = car["sprung_kg"], car["unsprung_kg"]
    k, c, t = (car[n] for n in ("suspension_n_per_m", "suspension_ns_per_m", "tyre_n_per_m"))
    a = np.array(
        [
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [-k / m, k / m, -c / m, c / m],
            [k / w, -(k + t) / w, c / w, -c / w],
        ]
    )
    b = np.array([0.0, 0.0, 0.0, t / w])
    wide = np.zeros((6, 6))
    wide[:4, :4], wide[:4, 4], wide[4, 5] = a / rate, b / rate, 1.0
    power = expm(wide)
    step, before, slope = power[:4, :4], power[:4, 4], power[:4, 5]
    x = np.zeros((road.size, 4))
    for i in range(1, road.size):
        x[i] = step @ x[i - 1] + before * road[i - 1] + slope * (road[i] - road[i - 1])
    rates = x @ a.T + np.outer(road, b)
    return x[:, 0], x[:, 1], rates[:, 2], rates[:, 3]


def rough(distance: np.ndarray, seed: int = 0, amplitude: float = 1.0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    waves = np.geomspace(0.012, 2.5, 120)
    heights = 7e-5 * amplitude * waves**-1.05 * rng.uniform(0.5, 1.5, waves.size)
    phases = rng.uniform(0.0, 2.0 * np.pi, waves.size)
    z = np.zeros(distance.size)
    for wave, height, phase in zip(waves, heights, phases, strict=True):
        z += height * np.sin(2.0 * np.pi * wave * distance + phase)
    return (z - z[0]) * (1.0 - np.exp(-((distance / 5.0) ** 2)))


@dataclass(frozen=True)
class Drive:
    """One wheel path at a constant speed; places in m ahead of the vehicle point.

    ``noise`` is of one sample by channel, ``stated`` the parameters that it says the vehicle has.
    """

    mps: float = 20.0
    length_m: float = 500.0
    wheel_m: float = 0.0
    laser_m: float = 0.0
    noise: Mapping[str, float] | None = None
    stated: Mapping[str, float] | None = None
    car: Mapping[str, float] | None = None
    seed: int = 0
    interval_m: float = 0.05
    bump_m: float | None = None

    def road(self, place: np.ndarray) -> np.ndarray:
        """Return the road at each ``place``: rough, or flat with one bump of 20 mm over 1 m."""
        if self.bump_m is None:
            return rough(place, self.seed)
        inside = np.abs(place - self.bump_m) < 0.5
        return np.where(inside, 0.01 * (1.0 + np.cos(2.0 * np.pi * (place - self.bump_m))), 0.0)

    def recording(self, **replaced: Channel | None) -> Recording:
        """Return what is measured, channels ``replaced`` or, if None, left out."""
        car = dict(self.car or CAR)
        distance = np.arange(0.0, self.length_m, self.mps / RATE)
        under = self.road(distance + self.wheel_m)
        body, wheel, body_a, wheel_a = motion(under - under[0], car)
        values = {
            "unsprung_specific_force": wheel_a + G,
            "sprung_specific_force": body_a + G,
            "suspension_deflection": body - wheel,
        }
        rng, clock = np.random.default_rng(self.seed + 1), UniformClock.of(RATE)
        channels: dict[str, Channel | None] = {"distance": Channel.of("distance", distance, clock)}
        for name, x in values.items():
            spread = (self.noise or {}).get(name, FAINT) * rng.standard_normal(x.size)
            channels[name] = Channel.of(name, x + spread, clock, "left")
        channels |= replaced
        tracks = {"left": TrackSetup((0.1, 0.0, 0.0), (self.laser_m - 0.1, 0.0, 0.0))}
        vehicle = VehicleSetup("quarter-car", dict(self.stated or car), self.wheel_m)
        setup = Setup(profile_interval_m=self.interval_m, tracks=tracks, vehicle=vehicle)
        return Recording(tuple(c for c in channels.values() if c is not None), setup)

    def compared(self, pipeline: str, settings=None, **replaced: Channel | None):
        """Return (track of the profile, road where a laser looks, filtered alike)."""
        result = run(self.recording(**replaced), pipeline, settings)
        profile = result.profile
        road = self.road(profile.distance_m + self.laser_m)
        return profile.tracks[0], high_passed(road, self.mps, self.interval_m)


def high_passed(z: np.ndarray, mps: float, interval_m: float) -> np.ndarray:
    """Return ``z`` through HPF_B3 forward and backward, which start as those of a profile do."""
    wave_number = float(AdaptiveCutOff().wave_number(mps, interval_m))
    tangent = np.tan(np.pi * wave_number * interval_m)
    for kernel, backward in SECTIONS:
        out = np.empty_like(z)
        kernel(z, out, new_record(STATE_VARIABLE), tangent, backward)
        z = out
    return z


@pytest.fixture
def drive():
    return Drive


@pytest.fixture
def quarter_car():
    return dict(CAR)


@pytest.fixture
def high_passed_road():
    """Return what filters a road as a profile of (5.7) is at a constant speed."""
    return high_passed


CORNER = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, 150.0)


@pytest.fixture(scope="session")
def drawn_parameters():
    """Return a function from a seed to drawn parameters of every model."""

    def draw(seed):
        rng = np.random.default_rng(seed)
        known = CORNER, ZHU_HALF_CAR, IMINE_TRAILER
        return [
            type(p)(**{name: v * rng.uniform(0.7, 1.4) for name, v in asdict(p).items()})
            for p in known
        ]

    return draw
