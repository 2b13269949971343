"""What the road-prior smoother takes sensors, vehicle and road for."""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.estimators.models.road_prior_values import (
    CLEARANCE,
    HEIGHT,
    SLOPE,
    Model,
)
from floatref.values.arrays import FloatArray

LEAST_MEMORY_M = 32.0
"""One second difference over the longer distance; over less there is no mean."""

LEVELLED_LEAN = 1.0 / 3.0
"""Part of a lean's 1-σ that one wheel path has from the mean of all, where that is levelled."""


@dataclass(frozen=True)
class RoadPrior:
    """Constants with a physical meaning; densities are two-sided, per √Hz or √s.

    Attributes:
        acceleration: white noise of the accelerometer, in m/s²/√Hz.
        acceleration_bias: 1-σ of its bias at the start, in m/s².
        acceleration_walk: random walk of the bias, in m/s²/√s.
        walk_along: what longitudinal acceleration adds to that in quadrature, in 1/√s.
        missing_acceleration: takes the place of `acceleration` where samples are missing.
        reading_m: least 1-σ of a reading of the height sensor as one of the road, texture included.
        road: q, half of G_s of the spectrum G_s/(2πν)² of (2.2), in m.
        long_waves: half of G_a of the spectrum G_a/(2πν)⁴ that (2.4) adds to that, in 1/m.
        road_reach_m: distance after which elevation and slope of the road are forgotten, in m.
        road_memory_m: travel over which the run's own road replaces both.
        edge_sigmas: a reading at a standstill that is off by this number of sigma
            shows an edge of the road.
        lean_expected_rad, lean_sigma_rad: lean of the accelerometer's axis forward, and 1-σ.
        tilt_expected, tilt_sigma: pitch angle per longitudinal acceleration, in rad per m/s²,
            and 1-σ.
        pitch_hz, pitch_damping: natural frequency and damping ratio of the pitch response.
        height_m: 1-σ of a reading of the height sensor, for the 1-σ of the result alone.
        most_sigma_share: where the 1-σ of the result is a larger share of how far the road bends,
            it is flagged; that is the RMS second difference over 16 m, at least at the start.
    """

    acceleration: float = 1.5e-4
    acceleration_bias: float = 0.03
    acceleration_walk: float = 1e-4
    walk_along: float = 1.6e-3
    missing_acceleration: float = 0.3
    reading_m: float = 1e-4
    road: float = 4e-6
    long_waves: float = 2e-7
    road_reach_m: float = 150.0
    road_memory_m: float = 300.0
    edge_sigmas: float = 6.0
    lean_expected_rad: float = 0.0
    lean_sigma_rad: float = 0.03
    tilt_expected: float = 0.0
    tilt_sigma: float = 0.01
    pitch_hz: float = 1.6
    pitch_damping: float = 0.3
    height_m: float = 4e-5
    most_sigma_share: float = 0.3

    def __post_init__(self) -> None:
        """Refuse a pitch that does not swing, and no memory; InputError names the setting."""
        if not 0.0 <= self.pitch_damping < 1.0:
            raise InputError(f"setting pitch_damping: {self.pitch_damping:g} is not below 1")
        if self.road_memory_m < LEAST_MEMORY_M:
            least = f"give {LEAST_MEMORY_M:g} m or more"
            raise InputError(f"setting road_memory_m: {self.road_memory_m:g} m; {least}")

    def model(self, step: float, sub_block: int) -> Model:
        """Return what the kernels take of them: samples ``step`` in s apart, and of a sub-block."""
        return Model(
            step=step,
            sub_block=sub_block,
            white=_square(self.acceleration),
            walk=_square(self.acceleration_walk),
            walk_along=_square(self.walk_along),
            gap=_square(self.missing_acceleration),
            reading=_square(self.reading_m),
            road=float(self.road),
            slope=float(self.long_waves),
            reach=float(self.road_reach_m),
            lean=float(self.lean_expected_rad),
            tilt=float(self.tilt_expected),
            lean_prior=_square(self.lean_sigma_rad),
            tilt_prior=_square(self.tilt_sigma),
            edge=float(self.edge_sigmas**2),
        )

    def start(self) -> FloatArray:
        """Return the covariance before the first reading; the height is that of a flat road."""
        reach, half = self.road_reach_m, self.road_reach_m / 2.0
        road_m2 = self.road * half + self.long_waves * reach**3 / 4.0
        deviations = self.acceleration_bias, self.lean_sigma_rad, self.tilt_sigma
        bias, lean, tilt = np.square(deviations)
        found = np.diag([1.0, 1.0, bias, 1.0 + road_m2, self.long_waves * half, lean, tilt])
        found[CLEARANCE, HEIGHT] = found[HEIGHT, CLEARANCE] = 1.0
        found[CLEARANCE, SLOPE] = found[SLOPE, CLEARANCE] = -self.long_waves * half**2
        return found


def _square(value: float) -> float:
    return float(np.square(value))
