"""A quarter car driven over a road, from its equations: what ideal sensors on it measure."""

from collections.abc import Mapping

import numpy as np
from scipy.linalg import expm

from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup, TrackSetup, VehicleSetup

G = 9.80665
RATE = 1000.0
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
    a = np.array([
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [-k / m, k / m, -c / m, c / m],
        [k / w, -(k + t) / w, c / w, -c / w],
    ])
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
    """Return a road of many sines, of some 2 m/km, level and flat at 0 m."""
    rng = np.random.default_rng(seed)
    waves = np.geomspace(0.012, 2.5, 120)
    heights = 7e-5 * amplitude * waves**-1.05 * rng.uniform(0.5, 1.5, waves.size)
    phases = rng.uniform(0.0, 2.0 * np.pi, waves.size)
    z = np.zeros(distance.size)
    for wave, height, phase in zip(waves, heights, phases, strict=True):
        z += height * np.sin(2.0 * np.pi * wave * distance + phase)
    return (z - z[0]) * (1.0 - np.exp(-((distance / 5.0) ** 2)))


def recorded(
    distance: np.ndarray,
    road_under_wheel: np.ndarray,
    *,
    noise: Mapping[str, float] | None = None,
    setup: Mapping[str, float] = CAR,
    car: Mapping[str, float] = CAR,
    x_m: float = 0.0,
    laser_m: float = 0.0,
    deflection: bool = True,
    seed: int = 1,
    interval_m: float = 0.05,
) -> Recording:
    """Return what the sensors of one wheel path measure at `RATE`, with white ``noise``."""
    body, wheel, body_a, wheel_a = motion(road_under_wheel, car)
    values = {"unsprung_specific_force": wheel_a + G, "sprung_specific_force": body_a + G}
    if deflection:
        values["suspension_deflection"] = body - wheel
    rng = np.random.default_rng(seed)
    clock = UniformClock.of(RATE)
    channels = [Channel.of("distance", distance, clock)]
    for name, x in values.items():
        spread = (noise or {}).get(name, 0.0)
        channels.append(Channel.of(name, x + spread * rng.standard_normal(x.size), clock, "left"))
    tracks = {"left": TrackSetup(laser_offset_m=(laser_m, 0.0, 0.0))}
    vehicle = VehicleSetup("quarter-car", setup, x_m)
    return Recording(
        tuple(channels), Setup(profile_interval_m=interval_m, tracks=tracks, vehicle=vehicle)
    )
