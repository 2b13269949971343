"""The position of the GNSS antenna, from the swing of its height with pitch and roll."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from floatref.screening.explanations import detrend, windows
from floatref.screening.gnss_readings import fixed_readings
from floatref.screening.slow_series import Motion, integrate
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.recording import ORIGIN, Recording, TrackSetup, Vector

SPAN_S = 5.0
DEGREE = 3
"""Degree of the free polynomial: bias, initial speed and height, and a changing slope."""
FEWEST_READINGS = 40
FEWEST_WINDOWS = 6
KNOWN_M = 0.3
"""Largest standard deviation in m of a lever arm that is reported."""
OFF_M, OFF = 0.5, 4.0
"""The arm contradicts the setup beyond both limits: in m and in standard deviations."""
NO_ARM_M = 0.1
"""Rates in deg/s make every arm shorter than this, in m."""


@dataclass(frozen=True)
class Antenna:
    """The position of the antenna in body X and Y, measured by its swing.

    Attributes:
        place_m: from the vehicle point, in m.
        arm_m: from the reference point of the track, in m.
        sigma_m: standard deviations of both, in m.
    """

    place_m: tuple[float, float]
    arm_m: tuple[float, float]
    sigma_m: tuple[float, float]


def check_antenna(
    recording: Recording, track: str, motion: Motion, faults: IndexArray
) -> Iterator[str]:
    """Yield a warning if the antenna's offset is missing, or contradicts its swing."""
    given = recording.setup.gnss_antenna_offset_m
    found = locate_antenna(recording, track, motion, faults)
    if given == ORIGIN:
        hint = ""
        if found is not None:
            hint = f" (its swing shows {_place(found, 0)}, {_place(found, 1)})"
        yield (
            "setup.gnss_antenna_offset_m: 0, 0, 0, so the antenna is taken to sit at the vehicle "
            f"point; measure where it is and give it{hint}"
        )
        return
    if found is None:
        return
    off = [axis for axis in (0, 1) if _is_off(found, given, axis)]
    if off and max(np.abs(found.arm_m)) < NO_ARM_M:
        yield (
            "channels roll_rate, pitch_rate: the antenna swings a fraction of what they show; if "
            "they are in deg/s, multiply by 0.0174533, else measure setup.gnss_antenna_offset_m "
            "again"
        )
        return
    for axis in off:
        yield (
            f"setup.gnss_antenna_offset_m: {'XY'[axis]} is {given[axis]:.4g} m, but the antenna "
            f"swings as at {_place(found, axis)}; measure it again"
        )


def _is_off(found: Antenna, given: Vector, axis: int) -> bool:
    off_m = abs(found.place_m[axis] - given[axis])
    return off_m > max(OFF_M, OFF * found.sigma_m[axis])


def _place(antenna: Antenna, axis: int) -> str:
    return f"{'XY'[axis]} = {antenna.place_m[axis]:.1f} m ± {2 * antenna.sigma_m[axis]:.1f} m"


def locate_antenna(
    recording: Recording, track: str, motion: Motion, faults: IndexArray
) -> Antenna | None:
    """Return the antenna's position, None if the body swings too little to measure it.

    (6.39) minus the integrated accelerometers, window by window, is -θ·l_x + φ·l_y.
    """
    parts = list(_normal_equations(recording, motion, faults))
    if len(parts) < FEWEST_WINDOWS:
        return None
    matrix, right = sum(p[0] for p in parts), sum(p[1] for p in parts)
    if not np.linalg.cond(matrix) < 1e8:
        return None
    arm = np.linalg.solve(matrix, right)
    inverse = np.linalg.inv(matrix)
    left = sum(p[2] for p in parts) - right @ arm
    off = np.stack([p[1] - p[0] @ arm for p in parts])
    white = np.diag(inverse) * left / sum(p[3] for p in parts)
    together = np.diag(inverse @ (off.T @ off) @ inverse)
    sigma = np.sqrt(np.maximum(white, together))
    if not (sigma < KNOWN_M).all():
        return None
    point = recording.setup.tracks.get(track, TrackSetup()).reference_point_m
    x, y = arm.tolist()
    return Antenna((x + point[0], y + point[1]), (x, y), (float(sigma[0]), float(sigma[1])))


def _normal_equations(
    recording: Recording, motion: Motion, faults: IndexArray
) -> Iterator[tuple[FloatArray, FloatArray, float, int]]:
    """Yield matrix, right-hand side, square and degrees of freedom of every window."""
    times, table, free = _columns(recording, motion, faults)
    for part in list(windows(times, SPAN_S))[::2]:
        rows = np.column_stack([table[part], free[part]])
        if rows.shape[0] < FEWEST_READINGS or np.isnan(rows).any():
            continue
        left = detrend(times[part], rows, DEGREE)
        basis, _ = np.linalg.qr(left[:, 3:] / np.maximum(np.abs(left[:, 3:]).max(axis=0), 1e-12))
        left = left[:, :3] - basis @ (basis.T @ left[:, :3])
        angles, height = left[:, 1:], left[:, 0]
        freedom = rows.shape[0] - DEGREE - 3
        yield angles.T @ angles, angles.T @ height, float(height @ height), freedom


def _columns(
    recording: Recording, motion: Motion, faults: IndexArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return times; height, -pitch and roll; and the effect of an unknown tilt on the height."""
    channel = recording.channel("gnss_height")
    sound = fixed_readings(recording)
    for first, behind in faults:
        sound[first:behind] = False
    times = channel.times_s
    sound &= (times >= motion.times[0]) & (times <= motion.times[-1])
    times = times[sound]

    def read(row: FloatArray) -> FloatArray:
        return np.interp(times, motion.times, row)

    lifted, along, across = (
        read(integrate(integrate(row))) for row in (motion.lift, motion.forces[0], motion.forces[1])
    )
    roll, pitch = (read(row) for row in motion.swing)
    table = np.stack([channel.values[sound] - lifted, -pitch, roll], axis=1)
    return times, table, np.stack([along, across], axis=1)
