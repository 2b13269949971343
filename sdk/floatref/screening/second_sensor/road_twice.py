"""The road under the wheel and under the laser of a wheel path: one road, measured twice.

The laser and the accelerometer beside it give the road as a profiler has it: height of the sensor
less range. The wheel follows the same road below some 5 Hz, which the accelerometer on its carrier
measures. All are integrated over a band, and the wheel's is moved along the road to the laser. The
wheel follows late, by damping over the stiffness of the tyre: 5 to 25 ms. So the wheel's road is
the sensor's height less the range, and the ratio of their weights is the laser's scale.
"""

from dataclasses import dataclass

import numpy as np

from floatref.screening.second_sensor.fast_series import STEP_S, FastGrid, band, dilate
from floatref.screening.second_sensor.fitting import Fit, fit, shifted
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import STANDARD_GRAVITY

BAND_HZ = (0.8, 5.0)
"""Band in Hz in which a wheel follows the road, above the drift of two integrations."""
SLOWEST_MPS = 4.0
"""Below this speed the tilt of the body in a brake is as large as the road in the band."""
HARDEST = 0.4 * STANDARD_GRAVITY
"""Above this acceleration in m/s² a body that pitches by 3 degrees per g tilts its accelerometer by
0.08 m/s² where a brake begins or ends: 1 mm in the band, as a road of 2 m/km."""
BRAKE_S = 0.5
"""Time in s of the means of place and speed for it: a shorter brake hardly swings a body."""
WHEEL_LATE = -3
"""Usual lag of the wheel, in steps of the grid: 15 ms."""
WHEELS_LATE = range(-7, 2)
SEARCH = ((4, 14), (1, 3))
"""Lags of wheel and laser that are searched where the usual ones explain little: of the laser how
many steps apart, and how many to either side; 0.3 s in all."""
ROUNDS = 3
"""How often both lags are moved together by one step, if that explains more."""
SMALL_S, GOOD = 0.02, 0.9
"""Lag in s up to which the first derivative of a signal of 5 Hz or less makes up for it, and the
share that has to be explained then."""
EDGE_S = 1.5
"""Time in s at either end of a run in which the filter of the band settles."""
LEAST_ROAD = 0.25
"""Least share that the wheel's road has of what both sensors of the body measure: springs with a
third of the critical damping heave by twice the road where they resonate. A body that swings more
is moved by brakes, on a road too flat to be compared."""
COHERENT = 0.8
"""Least share of the wheel's road that laser and accelerometer explain."""


@dataclass(frozen=True, eq=False)
class TwoRoads:
    """One wheel path: height and range of its sensors, and the road by its wheel.

    Attributes:
        lift: height of the laser by the accelerometer, in the band, shape (n,), in m.
        height: its range, likewise.
        wheel: the road by the wheel, where the laser is at that time, likewise.
        known: points that count.
    """

    lift: FloatArray
    height: FloatArray
    wheel: FloatArray
    known: BoolArray

    @property
    def moves_the_body(self) -> bool:
        """Whether the road is what moves the body."""
        if not self.known.any():
            return False
        of_body = min(float(np.std(x[self.known])) for x in (self.lift, self.height))
        return float(np.std(self.wheel[self.known])) >= LEAST_ROAD * of_body

    def relate(
        self,
        wheel_late: int,
        laser_late: int = 0,
        least: float = 0.0,
    ) -> Fit | None:
        """Return the wheel's road as a sum of lift and range, both lags in steps of the grid.

        ``least`` is that of `fit`.
        """
        rows = np.stack([self.lift, -shifted(self.height, laser_late)])
        return fit(shifted(self.wheel, -wheel_late), rows, self.known, least)

    def lags(self) -> tuple[float, float] | None:
        """Return the lags of wheel and laser in s by their derivatives, None if they are large."""
        measured = self.height
        wheel = shifted(self.wheel, -WHEEL_LATE)
        rows = [self.lift, -measured, -np.gradient(measured, STEP_S), np.gradient(wheel, STEP_S)]
        found = fit(wheel, np.stack(rows), self.known, GOOD)
        if found is None or found.explained < GOOD:
            return None
        _, own, faster, turned = found.weights.tolist()
        lags = (WHEEL_LATE * STEP_S - turned, faster / own if own else np.inf)
        return lags if abs(turned) <= SMALL_S and abs(lags[1]) <= SMALL_S else None


@dataclass(frozen=True, eq=False)
class LaserFit:
    """How a laser follows from accelerometer and wheel.

    Attributes:
        fit: the wheel's road as their sum.
        late_s: lag of the laser, in s.
        on_time: the same without a lag of the laser.
    """

    fit: Fit
    late_s: float
    on_time: Fit

    @property
    def gain(self) -> float:
        """Range that the laser shows for one metre; NaN if it explains nothing."""
        lift, height = self.fit.weights.tolist()
        return lift / height if height else np.nan


def fit_laser(roads: TwoRoads) -> LaserFit | None:
    """Return how the laser follows, by the lags that explain most; None if too little is known."""
    lags = roads.lags()
    wheel, late_s, steps = _search(roads) if lags is None else _near(*lags)
    on_time = roads.relate(wheel, 0, COHERENT)
    best = roads.relate(wheel, steps, COHERENT) if steps else on_time
    return None if best is None or on_time is None else LaserFit(best, late_s, on_time)


def _near(wheel_s: float, late_s: float) -> tuple[int, float, int]:
    return round(wheel_s / STEP_S), late_s, round(late_s / STEP_S)


def _search(roads: TwoRoads) -> tuple[int, float, int]:
    """Return the lag of the wheel in steps, and that of the laser in s and in steps."""

    def explained(wheel: int, late: int) -> float:
        found = roads.relate(wheel, late)
        return -np.inf if found is None else found.explained

    late, wheel = 0, WHEEL_LATE
    for apart, many in SEARCH:
        steps = range(late - apart * many, late + apart * many + 1, apart)
        # The first of equals is the one that was best so far.
        late = max((late, *steps), key=lambda step: explained(wheel, step))
        wheel = max((wheel, *WHEELS_LATE), key=lambda step: explained(step, late))
    for _ in range(ROUNDS):
        both = [(wheel + a, late + b) for a in (0, -1, 1) for b in (0, -1, 1)]
        wheel, late = max(both, key=lambda pair: explained(*pair))
    return wheel, late * STEP_S, late


def wheel_road(
    carrier: FloatArray, distance: FloatArray, ahead_m: float, grid: FastGrid
) -> FloatArray:
    """Return the road by the accelerometer on the wheel, where the laser is at every time.

    ``ahead_m`` is how far the wheel is ahead of the laser; ``distance`` the encoder's, in m.
    """
    road = band(carrier, *BAND_HZ, integrals=2)
    forward = np.maximum.accumulate(distance) + 1e-9 * np.arange(distance.size)
    passed = np.interp(forward - ahead_m, forward, grid.times)
    return np.asarray(np.interp(passed, grid.times, road))


def lift_of(force: FloatArray, pitch_rate: FloatArray | None, ahead_m: float) -> FloatArray:
    """Return the height of the laser, ``ahead_m`` ahead of its accelerometer, in the band, in m.

    A body that pitches nose down lowers what is ahead. Without a gyro the pitch counts as 0.
    """
    lift = band(force, *BAND_HZ, integrals=2)
    return lift if pitch_rate is None else lift - ahead_m * band(pitch_rate, *BAND_HZ, integrals=1)


def is_moving(distance: FloatArray) -> BoolArray:
    """Return the points, shape (n,), at which the vehicle rolls: not slow, and not braking hard."""
    moving = np.asarray(_rate(distance, 1.0) > SLOWEST_MPS)
    edge = round(EDGE_S / STEP_S)
    moving[:edge] = moving[max(moving.size - edge, 0) :] = False
    gained = np.abs(_rate(_rate(distance, BRAKE_S), BRAKE_S))
    return moving & ~dilate(moving & (gained > HARDEST), EDGE_S)


def _rate(series: FloatArray, over_s: float) -> FloatArray:
    """Return the derivative of ``series``, shape (n,), by its means ``over_s``."""
    size = min(round(over_s / STEP_S), series.size)
    return np.gradient(np.convolve(series, np.ones(size) / size, "same"), STEP_S)
