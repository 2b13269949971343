"""The simulations of section 4 of Zhu et al. (2021): road, obstacle, half car and its sensors.

The half car is integrated by the classical Runge-Kutta rule of order four in steps much shorter
than the estimator's, over a road that is linear between its own points. The estimator sees all
accelerations, velocities and displacements with white noise of a share of each signal's RMS.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floatref.vehicle_response import (
    ZHU_HALF_CAR,
    Hold,
    JointInputState,
    Kind,
    Reading,
    hold_error_of,
    join_at_speed,
    state_space,
)

Array = NDArray[np.float64]
MODEL = ZHU_HALF_CAR.model()
CLASS_E = 4096e-6
"""G_q(n0) of class E of ISO 8608, geometric mean, in m³."""
N0, N1 = 0.1, 0.1
"""Reference and lower cut-off wave number of (14) and (15), in cycles/m."""
NOISE = 0.05
"""Of each signal's RMS."""
INITIAL = 5e-5
"""P of the first state, on the diagonal (4.1)."""


@dataclass(frozen=True, eq=False)
class Drive:
    """What the half car truly does at the estimator's samples.

    Attributes:
        speed: in m/s.
        rate_hz: of the samples.
        road: under the rear and the front axle, shape (N, 2), in m.
        signals: accelerations, velocities, displacements of the freedoms, shape (N, 15).
    """

    speed: float
    rate_hz: float
    road: Array
    signals: Array


def random_road(seed: int, spacing_m: float, length_m: float) -> Array:
    """Return (15) at points ``spacing_m`` apart: filtered white noise, from its stationary state.

    The speed cancels: du/dx = -2π·n1·u + 2π·n0·√G·w over the distance x.
    """
    rng = np.random.default_rng(seed)
    rate = 2 * np.pi * N1
    sigma = 2 * np.pi * N0 * np.sqrt(CLASS_E / (2 * rate))
    decay = np.exp(-rate * spacing_m)
    shocks = rng.standard_normal(round(length_m / spacing_m) + 1)
    road = np.empty(shocks.size)
    road[0] = sigma * shocks[0]
    for k in range(1, road.size):
        road[k] = decay * road[k - 1] + sigma * np.sqrt(1 - decay**2) * shocks[k]
    return road


def obstacle(spacing_m: float, length_m: float, at_m: float = 8.0) -> Array:
    """Return (16): 0.2 m high over 0.8 m, from ``at_m`` on."""
    x = spacing_m * np.arange(round(length_m / spacing_m) + 1)
    return np.where((x >= at_m) & (x <= at_m + 0.8), 0.2, 0.0)


def driven(
    road: Array, spacing_m: float, speed: float, rate_hz: float, fine_hz: float = 4000.0
) -> Drive:
    """Drive over ``road`` at ``speed`` in m/s; the rear axle follows by the delay of (8)."""
    steps = round((road.size - 1) * spacing_m / speed * fine_hz)
    half = 0.5 / fine_hz * np.arange(2 * steps + 1)
    places = speed * half
    points = spacing_m * np.arange(road.size)
    front = np.interp(places, points, road)
    rear = np.interp(places - ZHU_HALF_CAR.wheelbase_m, points, road)
    under = np.stack([rear, front], axis=1)
    states = _integrated(under, fine_hz)
    a, b = state_space(MODEL)
    forces = MODEL.tyres[0].stiffness * under[::2]
    rates = states @ a.T + forces @ b.T
    signals = np.hstack([rates[:, 5:], states[:, 5:], states[:, :5]])
    every = round(fine_hz / rate_hz)
    return Drive(speed, rate_hz, under[:: 2 * every], signals[::every])


def measured(drive: Drive, seed: int, noise: float = NOISE) -> tuple[Array, list[Reading]]:
    """Return the drive's signals with their noise, and the readings that they are."""
    rng = np.random.default_rng([seed, 1])
    sigma = noise * np.sqrt(np.mean(drive.signals**2, axis=0))
    seen = drive.signals + sigma * rng.standard_normal(drive.signals.shape)
    kinds = (Kind.ACCELERATION, Kind.VELOCITY, Kind.DISPLACEMENT)
    names = [(kind, freedom.name) for kind in kinds for freedom in MODEL.freedoms]
    return seen, [Reading(k, f, float(s)) for (k, f), s in zip(names, sigma, strict=True)]


def estimated(
    drive: Drive, seen: Array, readings: list[Reading], hold: Hold
) -> tuple[Array, Array]:
    """Return the road under both axles, shape (N, 2), and joined under the front, (N,), in m."""
    step_s = 1 / drive.rate_hz
    disturbance = hold_error_of(MODEL, step_s, drive.speed, "E", hold)
    initial = INITIAL * np.eye(10)
    found = JointInputState.of(MODEL, readings, step_s, disturbance, initial, hold).estimate(seen)
    behind = (-ZHU_HALF_CAR.wheelbase_m, 0.0)
    both, _ = join_at_speed(found.road.T, found.road_sigma.T, behind, drive.speed, step_s)
    return found.road, both


def rmse_percent(found: Array, true: Array) -> float:
    """Return 100·‖û - u‖/‖u‖, the RMSE of Table 2."""
    return float(100 * np.linalg.norm(found - true) / np.linalg.norm(true))


def _integrated(under: Array, fine_hz: float) -> Array:
    """Return the states at every other row of ``under``, by steps over two of its intervals."""
    a, b = state_space(MODEL)
    forced = MODEL.tyres[0].stiffness * under @ b.T / (6 * fine_hz)
    # The four slopes of the rule, put into each other: the equations are linear.
    z, one = a / fine_hz, np.eye(10)
    kept = one + z @ (one + z @ (one + z @ (one + z / 4) / 3) / 2)
    first, middle = one + z @ (one + z @ (one + z / 2) / 2), 4 * one + z @ (2 * one + z / 2)
    pushed = forced[:-1:2] @ first.T + forced[1::2] @ middle.T + forced[2::2]
    states = np.zeros((len(pushed) + 1, 10))
    for k, push in enumerate(pushed):
        states[k + 1] = kept @ states[k] + push
    return states
