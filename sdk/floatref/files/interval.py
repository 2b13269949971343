"""The constant interval of a column of distances that were rounded on writing."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.profile import FARTHEST_M


def constant_interval(distance_m: FloatArray, decimals: int) -> tuple[float, float]:
    """Return start and interval in m of ``distance_m``, shape (N,), given to ``decimals``.

    The interval is the one with the fewest digits that explains every distance within its
    rounding. Raises InputError with the row (the header is row 1) where there is none.
    """
    if distance_m.size < 2:
        raise InputError("one point only; a profile needs two for its interval")
    missing = ~np.isfinite(distance_m)
    if missing.any():
        raise InputError(f"row {_row(missing)}: distance_m is missing; every row needs one")
    beyond = np.abs(distance_m) > FARTHEST_M
    if beyond.any():
        raise InputError(
            f"row {_row(beyond)}: distance_m is {distance_m[_row(beyond) - 2]:.10g}, beyond "
            f"{FARTHEST_M:g} m; give it in m, less an origin"
        )
    backward = np.diff(distance_m, prepend=-np.inf) <= 0
    if backward.any():
        raise InputError(f"row {_row(backward)}: distance_m does not increase; sort the rows")
    mean = float((distance_m[-1] - distance_m[0]) / (distance_m.size - 1))
    bits = 4 * float(np.spacing(np.abs(distance_m).max()))
    unit = _unit(decimals, mean)
    for tolerance in (bits, max(bits, unit)):
        interval = _shortest(distance_m, mean, tolerance)
        if interval is not None:
            return float(distance_m[0]), interval
    raise InputError(_complaint(distance_m, mean, max(bits, unit)))


def _unit(decimals: int, interval_m: float) -> float:
    """Return how far ``decimals`` may move a distance from the line through the first, in m.

    Each of the two is off by half a unit. A unit above two fifths of the interval would hide a
    lost row, so such distances have to be exact.
    """
    unit = 1.001 * 10.0 ** -min(max(decimals, 0), 300)
    return unit if unit <= 0.4 * interval_m else 0.0


def _shortest(distance_m: FloatArray, mean: float, tolerance: float) -> float | None:
    for digits in range(1, 18):
        interval = float(f"{mean:.{digits - 1}e}")
        if interval > 0 and _deviation(distance_m, interval).max() <= tolerance:
            return interval
    return None


def _deviation(distance_m: FloatArray, interval: float) -> FloatArray:
    line = distance_m[0] + interval * np.arange(distance_m.size)
    deviation: FloatArray = np.abs(distance_m - line)
    return deviation


def _complaint(distance_m: FloatArray, mean: float, tolerance: float) -> str:
    typical = float(np.median(np.diff(distance_m)))
    odd = np.abs(np.diff(distance_m, prepend=distance_m[0] - typical) - typical) > 2 * tolerance
    row = _row(odd) if odd.any() else int(np.argmax(_deviation(distance_m, mean))) + 2
    return (
        f"row {row}: distance_m is {float(distance_m[row - 2])!r}, off the interval of "
        f"{typical:.6g} m; resample the profile to a constant interval"
    )


def _row(bad: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> int:
    return int(np.argmax(bad)) + 2
