"""The simulation and the experiments of section V of Imine et al., with a simulated trailer.

The motion is that of the reference's equations of the trailer, integrated with an error of 1e-9
over a road that is smooth between samples; the observer sees it at 128 Hz. The paper prints neither
the trailer's constants nor the chirp's frequencies, sensors or roads: those here are ours.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray
from floatref.vehicle_response import (
    IMINE_TRAILER,
    Estimate,
    Kind,
    Reading,
    UnknownInputObserver,
    default_gains,
)
from floatref_reference.imine.section_2_trailer import motion
from floatref_reference.imine.section_5_simulation import F_S, POINTS, chirp

DURATION_S = (POINTS - 1) / F_S
TIMES = np.arange(POINTS) / F_S
CHIRP_M, CHIRP_HZ = 1e-3, (0.5, 10.0)
ROAD_M, ROAD_HZ = 20e-3, (0.3, 12.0)

Road = Callable[[float], tuple[FloatArray, FloatArray]]
"""Heights in m and their rates in m/s under the left and the right wheel, of the time in s."""


class Sensors(NamedTuple):
    """Errors of displacement sensors and of accelerometers on the wheels.

    Attributes:
        displacement_sigma: noise in m; of an angle that over half the track.
        displacement_bits: of its converter over ±100 mm.
        acceleration_sigma: noise in m/s².
        acceleration_bias: in m/s².
        scale: error of every sensor's calibration, of either sign.
    """

    displacement_sigma: float = 0.0
    displacement_bits: int = 0
    acceleration_sigma: float = 0.0
    acceleration_bias: float = 0.0
    scale: float = 0.0


IDEAL = Sensors()
BENCH = Sensors(10e-6, 16, 0.02)
FIELD = Sensors(100e-6, 12, 0.05, 0.05, 0.01)


class Case(NamedTuple):
    """One drive: the road under both wheels, shape (N, 2), and what the observer makes of it."""

    road: FloatArray
    displacements: FloatArray
    accelerations: FloatArray
    estimate: Estimate

    @property
    def error(self) -> FloatArray:
        """Return estimate less road in m, shape (N, 2); NaN until it is settled."""
        return self.estimate.road - self.road


def chirps(t: float) -> tuple[FloatArray, FloatArray]:
    """Return the chirp on the left, and on the right the same from high to low frequencies."""
    low, high = CHIRP_HZ
    left = chirp(t, DURATION_S, CHIRP_M, low, high)
    right = chirp(t, DURATION_S, CHIRP_M, high, low)
    return np.array([left[0], right[0]]), np.array([left[1], right[1]])


def left_road(seed: int = 1) -> Road:
    """Return a road whose density falls with frequency squared, on the left alone."""
    hertz = np.arange(*ROAD_HZ, 0.05)
    phase = np.random.default_rng(seed).uniform(0.0, 2 * np.pi, hertz.size)
    heights = (np.sin(2 * np.pi * hertz * TIMES[:, None] + phase) / hertz).sum(axis=1)
    amplitude = ROAD_M / np.abs(heights).max() / hertz

    def road(t: float) -> tuple[FloatArray, FloatArray]:
        # It rises within a second, as the trailer is at rest at first.
        rise, rate = (
            (np.sin(np.pi / 2 * t) ** 2, np.pi / 2 * np.sin(np.pi * t)) if t < 1 else (1, 0)
        )
        angle = 2 * np.pi * hertz * t + phase
        height = amplitude @ np.sin(angle)
        slope = amplitude @ (2 * np.pi * hertz * np.cos(angle))
        return np.array([rise * height, 0.0]), np.array([rise * slope + rate * height, 0.0])

    return road


def drive(road: Road) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return road (N, 2), displacements (N, 5) and accelerations of the wheels (N, 2)."""
    from scipy.integrate import solve_ivp

    trailer = motion()
    inner, outer = (
        np.linalg.solve(trailer.M, np.hstack(pair))
        for pair in ((trailer.K, trailer.B), (trailer.C, trailer.D))
    )

    def rate(t: float, x: FloatArray) -> FloatArray:
        return np.concatenate([x[5:], outer @ np.concatenate(road(t)) - inner @ x])

    x = solve_ivp(rate, (0, DURATION_S), np.zeros(10), "DOP853", TIMES, rtol=1e-9, atol=1e-12).y.T
    accelerations = [rate(t, each)[5:7] for t, each in zip(TIMES, x, strict=True)]
    return np.array([road(t)[0] for t in TIMES]), x[:, :5], np.array(accelerations)


def read(
    displacements: FloatArray, accelerations: FloatArray, sensors: Sensors, seed: int
) -> tuple[FloatArray, FloatArray]:
    rng = np.random.default_rng(seed)
    arm = np.array([1.0, 1.0, 1.0, IMINE_TRAILER.half_track_m, IMINE_TRAILER.half_track_m])
    y = displacements * arm * (1.0 + sensors.scale * rng.choice([-1.0, 1.0], 5))
    y = y + sensors.displacement_sigma * rng.standard_normal(y.shape)
    if sensors.displacement_bits:
        quantum = 0.2 / 2**sensors.displacement_bits
        y = quantum * np.round(y / quantum)
    z = accelerations * (1.0 + sensors.scale * rng.choice([-1.0, 1.0], 2))
    noise = sensors.acceleration_sigma * rng.standard_normal(z.shape)
    return y / arm, z + sensors.acceleration_bias * rng.choice([-1.0, 1.0], 2) + noise


def observed(
    drove: tuple[FloatArray, FloatArray, FloatArray],
    sensors: Sensors = IDEAL,
    seed: int = 1,
    degree: int = 3,
) -> Case:
    """Return a drive with these sensors, and the estimate with the default gains.

    ``degree`` is that of the polynomial between two samples.
    """
    road, displacements, accelerations = drove
    y, z = read(displacements, accelerations, sensors, seed)
    model = IMINE_TRAILER.model()
    sigma = max(sensors.displacement_sigma, 1e-6)
    measured = [Reading(Kind.DISPLACEMENT, freedom.name, sigma) for freedom in model.freedoms]
    watch = UnknownInputObserver.of(
        model,
        1.0 / F_S,
        default_gains(model, measured),
        measured,
        max(sensors.acceleration_sigma, 1e-6),
        degree,
    )
    return Case(road, y, z, watch.estimate(y, z))
