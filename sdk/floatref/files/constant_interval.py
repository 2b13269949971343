"""The constant interval of a column of distances, from the digits that it was written with."""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.profile import FARTHEST_M

DISTANCE = "distance_m"
"""Name of the column of distances in our own tables."""
RESAMPLE = "resample the profile to a constant interval"


def constant_interval(
    distance_m: FloatArray, decimals: int, name: str = DISTANCE, unit: str = "m"
) -> tuple[float, float]:
    """Return start and interval in m of ``distance_m``, shape (N,), given to ``decimals``.

    The interval has the fewest digits that fit every distance within its rounding. The start
    and interval of a column in another ``unit`` are in that unit. Raises InputError with the row
    (the header is row 1) and the ``name`` of the column if no interval fits.
    """
    if distance_m.size < 2:
        raise InputError("one point only; a profile needs two for its interval")
    missing = ~np.isfinite(distance_m)
    if missing.any():
        raise InputError(f"row {_row(missing)}: {name} is missing; every row needs one")
    beyond = np.abs(distance_m) > FARTHEST_M
    if beyond.any():
        raise InputError(
            f"row {_row(beyond)}: {name} is {distance_m[_row(beyond) - 2]:.10g}, beyond "
            f"{FARTHEST_M:g} {unit}; give it in {unit}, less an origin"
        )
    backward = np.diff(distance_m, prepend=-np.inf) <= 0
    if backward.any():
        raise InputError(f"row {_row(backward)}: {name} does not increase; sort the rows")
    mean = float((distance_m[-1] - distance_m[0]) / (distance_m.size - 1))
    bits = 4 * float(np.spacing(np.abs(distance_m).max()))
    rounding = _unit(decimals, mean)
    for tolerance in (bits, max(bits, rounding)):
        interval = _shortest(distance_m, mean, tolerance)
        if interval is not None:
            return float(distance_m[0]), interval
    raise InputError(
        f"{_complaint(distance_m, mean, max(bits, rounding), name)} {unit}; {RESAMPLE}"
    )


def _unit(decimals: int, interval_m: float) -> float:
    """Return the largest deviation in m that ``decimals`` allow from the line through the first.

    The distance and the first one are each rounded by half a unit. A unit above two fifths of the
    interval could hide a lost row, so such distances must be exact.
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


def _complaint(distance_m: FloatArray, mean: float, tolerance: float, name: str) -> str:
    typical = float(np.median(np.diff(distance_m)))
    odd = np.abs(np.diff(distance_m, prepend=distance_m[0] - typical) - typical) > 2 * tolerance
    row = _row(odd) if odd.any() else int(np.argmax(_deviation(distance_m, mean))) + 2
    return f"row {row}: {name} is {float(distance_m[row - 2])!r}, off the interval of {typical:.6g}"


def _row(bad: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> int:
    return int(np.argmax(bad)) + 2


def count_decimals(text: str) -> int:
    """Return the number of decimals of ``text``, with its exponent taken into account."""
    mantissa, _, exponent = text.strip().lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(exponent or 0)
