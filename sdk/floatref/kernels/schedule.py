"""Cut-offs that follow the travel speed: (5.3), its wave number, and (A.11) of either.

Every loop here treats each sample alone, so it may be vectorized and split anywhere.
"""

import math

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

SMALL = 0.1
"""Largest angle for which the series of the tangent is used; its error is below rounding."""
BRIEF = 40.0
"""Exponents are held within this: further out the sum of 1 and the exponential is one of them."""


@compiled
def frequencies(
    speed: FloatArray,
    frequency: FloatArray,
    low_speed_hz: float,
    wavelength_m: float,
    transition_speed: float,
    steepness: float,
) -> None:
    """Write (5.3) in Hz of ``speed`` in m/s to ``frequency``; NaN stays NaN.

    It is v/λ_c + (f_ls - v/λ_c) / (1 + exp u), which cannot overflow. The exponential is the Taylor
    polynomial of u/64, squared six times. It is exact to rounding near u = 0; farther out its error
    is larger, but there it is negligible against 1, or 1 against it.
    """
    per_metre = 1.0 / wavelength_m
    for i in range(speed.size):
        u = max(min(steepness * (speed[i] - transition_speed), BRIEF), -BRIEF)
        z = u * 0.015625
        z2 = z * z
        even = 1.0 / 40320.0
        even = even * z2 + 1.0 / 720.0
        even = even * z2 + 1.0 / 24.0
        even = even * z2 + 0.5
        odd = 1.0 / 5040.0
        odd = odd * z2 + 1.0 / 120.0
        odd = odd * z2 + 1.0 / 6.0
        odd = odd * z2 + 1.0
        power = 1.0 + (even * z2 + odd * z)
        power *= power
        power *= power
        power *= power
        power *= power
        power *= power
        power *= power
        high = speed[i] * per_metre
        frequency[i] = high + (low_speed_hz - high) / (1.0 + power)


@compiled
def wave_numbers(speed: FloatArray, values: FloatArray, largest: float) -> None:
    """Turn ``values`` from frequencies in Hz into cycles/m, at most ``largest``, in place.

    A vehicle at rest, or moving backward, has ``largest``.
    """
    for i in range(speed.size):
        limit = largest * speed[i]
        reached = values[i] >= limit
        moving = speed[i] if speed[i] > 0.0 else 1.0
        value = values[i] / moving
        values[i] = largest if reached else value


@compiled
def tangents(cutoff: FloatArray, step: float, c: FloatArray) -> int:
    """Write c = tan(pi f_c dt) to ``c``; return how many cut-offs are out of range.

    c is the substitution (A.11), and half a step of the analog cut-off (A.7) in radians.
    Out of range is below zero, or half the sampling rate and above. NaN stays NaN.
    """
    angle = math.pi * step
    large = 0
    for i in range(cutoff.size):
        u = angle * cutoff[i]
        u2 = u * u
        series = 21844.0 / 6081075.0
        series = series * u2 + 1382.0 / 155925.0
        series = series * u2 + 62.0 / 2835.0
        series = series * u2 + 17.0 / 315.0
        series = series * u2 + 2.0 / 15.0
        series = series * u2 + 1.0 / 3.0
        c[i] = u + u * (u2 * series)
        large += 1 if u > SMALL or u < 0.0 else 0
    if large == 0:
        return 0
    wrong = 0
    for i in range(cutoff.size):
        u = angle * cutoff[i]
        if u > SMALL:
            c[i] = math.tan(u)
        if u < 0.0 or step * cutoff[i] >= 0.5:
            wrong += 1
    return wrong
