"""Sensors of the IMU that are connected to nothing: constant while the vehicle moves."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from floatref.architectures.kinematic_readings import Readings
from floatref.architectures.kinematic_series import SWING_S, Motion, smoothed
from floatref.architectures.kinematic_witnesses import AXES, TILT_SMOOTH_S, Axis, attitudes
from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording

SMOOTH_S = 0.5
SPEEDS_UP, TURNS, SWINGS = 0.5, 2.0, 0.004
"""What a sensor that works does not miss: acceleration and that of a curve, beyond any bank of a
road, in m/s², and an angle in rad."""
CONSTANT = 1e-12
"""Means of identical samples differ by rounding alone."""


class Moved(NamedTuple):
    """A sensor's row, what another one shows of its motion, how much is enough, and what it is."""

    row: FloatArray
    shown: FloatArray
    enough: float
    what: str


def check_alive(recording: Recording, track: str, motion: Motion) -> None:
    """Raise InputError for a constant channel of the IMU, where others show what it should see.

    A perfect sensor on a straight, level road is constant, too, and is not blamed.
    """
    for name, moved in _moved(recording, motion).items():
        known = moved.row[~np.isnan(moved.row)]
        if not known.size or np.ptp(known) > CONSTANT * max(1.0, abs(known[0])):
            continue
        if np.nanmax(np.abs(moved.shown), initial=0.0) > moved.enough:
            raise InputError(
                f"channel {recording.channel(name, track).id}: every sample is "
                f"{known[0] + 0.0:.4g}, but {moved.what}; connect the sensor, and mark missing "
                "samples as NaN"
            )


def _moved(recording: Recording, motion: Motion) -> dict[str, Moved]:
    turning = motion.speed * motion.rates[2]
    told = attitudes(recording, motion)
    found = {
        "longitudinal_specific_force": Moved(
            motion.forces[0],
            smoothed(motion.acceleration, SMOOTH_S),
            SPEEDS_UP,
            "the vehicle speeds up or brakes",
        ),
        "lateral_specific_force": Moved(
            motion.forces[1], smoothed(turning, SMOOTH_S), TURNS, "the vehicle turns"
        ),
        "yaw_rate": Moved(
            motion.rates[2], smoothed(motion.forces[1], SMOOTH_S), TURNS, "the vehicle turns"
        ),
    }
    for axis in AXES:
        shown = _swing(motion, told, axis)
        found[axis.rate] = Moved(motion.rates[axis.row], shown, SWINGS, "the body swings")
    return found


def _swing(motion: Motion, told: Mapping[str, Readings], axis: Axis) -> FloatArray:
    """Return by how much GNSS, else gravity, leaves its own means over some seconds, in rad."""
    if axis.angle in told:
        angle = told[axis.angle].on_grid()
    else:
        angle = smoothed(motion.tilts[axis.row], TILT_SMOOTH_S)
    return np.asarray(angle - smoothed(angle, SWING_S))
