"""Three measurements of roll and pitch compared: rates, attitude of GNSS, and gravity."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from floatref.screening.explanations import RIGHT, Evidence, Look, weigh
from floatref.screening.gnss_readings import Readings
from floatref.screening.slow_series import Motion, smooth
from floatref.values.arrays import FloatArray
from floatref.values.recording import Recording

DEGREES = 180.0 / np.pi
ATTITUDE = Look(span_s=3.0, floor=2e-4)
"""Drift of a receiver and bias of a gyro are free."""
READINGS = 15
"""Fewest readings in a window, at any rate of the receiver."""
TILT = Look(span_s=10.0, floor=1e-3)
TILT_SMOOTH_S = 1.0
"""Above 0.3 Hz the accelerometers measure the body's own swing, not gravity."""
UPRIGHT = 0.5
"""Limit of the tilt of a road, in rad."""


@dataclass(frozen=True)
class Axis:
    """Roll or pitch: the row of its angle, its channels, its positive turn, and its tilt."""

    row: int
    rate: str
    angle: str
    positive: str
    tilt: str


AXES = (
    Axis(
        0,
        "roll_rate",
        "gnss_roll",
        "left side up is positive",
        "the roll that lateral_specific_force and yaw_rate show",
    ),
    Axis(
        1,
        "pitch_rate",
        "gnss_pitch",
        "nose down is positive",
        "the pitch that longitudinal_specific_force and distance show",
    ),
)


@dataclass(frozen=True)
class Witnesses:
    """Evidence from the three measurements of one axis.

    Attributes:
        attitude: of GNSS on the rate.
        rate: of the tilt on the rate.
        angle: of the tilt on GNSS.
    """

    attitude: Evidence
    rate: Evidence
    angle: Evidence


def read_attitudes(recording: Recording, motion: Motion) -> dict[str, Readings]:
    """Return the readings of gnss_roll and gnss_pitch during the run, without empty channels."""
    found = [recording.find(axis.angle) for axis in AXES]
    attitude_readings = {c.id.name: Readings.of(c, motion) for c in found if c is not None}
    return {name: readings for name, readings in attitude_readings.items() if readings.times.size}


def weigh_witnesses(
    motion: Motion, attitude_readings: Mapping[str, Readings]
) -> tuple[Witnesses, Witnesses]:
    """Return the evidence on roll and on pitch."""
    tilts = np.stack([smooth(row, TILT_SMOOTH_S) for row in motion.tilts])
    both = len(attitude_readings) == len(AXES)
    level = (
        [attitude_readings[a.angle].on_grid() for a in AXES] if both else list(np.nan_to_num(tilts))
    )
    angles = motion.turn(np.clip(level, -UPRIGHT, UPRIGHT))
    slow = [smooth(angle, TILT_SMOOTH_S) for angle in angles]
    calm = [smooth(row, TILT_SMOOTH_S) for row in level]
    roll, pitch = (
        Witnesses(
            _attitude(attitude_readings.get(axis.angle), angles, axis.row),
            _tilt(motion, tilts, slow, axis.row),
            _tilt(motion, tilts, calm, axis.row) if both else Evidence(),
        )
        for axis in AXES
    )
    return roll, pitch


def _attitude(readings: Readings | None, angles: FloatArray, row: int) -> Evidence:
    if readings is None:
        return Evidence()
    own, other, yaw = (readings.beside(angles[k]) for k in (row, 1 - row, 2))
    explained = {**axes(own, other, yaw), "deg": DEGREES * own, "-deg": -DEGREES * own}
    explained |= readings.delay(angles[row])
    apart = float(np.median(np.diff(readings.times))) if readings.times.size > 1 else 0.0
    span_s = max(ATTITUDE.span_s, READINGS * apart)
    look = Look(span_s, ATTITUDE.floor, factors={"deg": DEGREES, "-deg": DEGREES})
    return weigh(readings.times, readings.values, explained, look)


def _tilt(
    motion: Motion, tilts: FloatArray, angles: list[FloatArray] | FloatArray, row: int
) -> Evidence:
    explained = axes(angles[row], angles[1 - row])
    return weigh(motion.times, tilts[row], explained, TILT)


def axes(own: FloatArray, *others: FloatArray) -> dict[str, FloatArray]:
    """Return the angle expected for a right rate, a wrong sign or unit, or another axis."""
    explained = {RIGHT: own, "sign": -own, "unit": own / DEGREES, "-unit": -own / DEGREES}
    for name, other in zip(("first", "second"), others, strict=False):
        explained |= {name: other, f"-{name}": -other}
    return explained
