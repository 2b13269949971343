"""The rate at which an estimator runs, tied to the speed: section 4.3 of Zhu."""

from math import isfinite

from floatref.errors import InputError

POINTS_PER_M = 20.0
"""Samples per metre of road: half of them, 10 cycles/m, is the highest wave number seen."""


def calculation_rate(speed_mps: float) -> float:
    """Return the rate f = 20·v in Hz for a speed in m/s, section 4.3 of Zhu.

    The spacing of the estimate over distance is then 0.05 m at every speed. Raises InputError
    unless the speed is a finite number above zero.
    """
    if not (isfinite(speed_mps) and speed_mps > 0):
        raise InputError(
            f"the calculation rate follows the speed, which is {speed_mps:g} m/s; "
            "give the part of the drive that has a speed above zero"
        )
    return POINTS_PER_M * speed_mps
