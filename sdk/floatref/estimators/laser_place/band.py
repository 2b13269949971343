"""Third-order Butterworth filters, forward and backward, in sections of second order.

`scipy.signal` has the same, but to load it takes half a second, more than a run of this filter
does; operations have its order, so that results are the same to the bit.
"""

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray

POLES = -np.exp(1j * np.pi * np.array([-2.0, 0.0, 2.0]) / 6.0)
"""Of the analog low-pass of third order at 1 rad/s: a pair, and between them a real one."""
EDGE = 12
"""Number of samples by which a signal is continued at both ends: three times that of the taps."""
RATE = 2.0
"""Rate of the bilinear transform, of which frequencies are a share."""


def sections_of(frequency_hz: float, step: float, high: bool) -> FloatArray:
    """Return the sections of a high-pass, or of a low-pass, shape (2, 6): b0, b1, b2, 1, a1, a2.

    ``step`` is the time between samples in s. Raises
    InputError unless ``frequency_hz`` is between 0 and half the rate.
    """
    share = 2.0 * frequency_hz / (1.0 / step)
    if not 0.0 < share < 1.0:
        raise InputError(f"filter: {frequency_hz:g} Hz at {1.0 / step:g} Hz; give less than half")
    warped = 2.0 * RATE * np.tan(np.pi * share / RATE)
    poles = warped / POLES if high else warped * POLES
    gain = np.real(1.0 / np.prod(-POLES)) if high else warped**3
    bilinear = 2.0 * RATE
    gain = gain * np.real((bilinear**3 if high else 1.0) / np.prod(bilinear - poles))
    poles = (bilinear + poles) / (bilinear - poles)
    zero, real = (1.0 if high else -1.0), poles[1].real
    pair = (poles[0] + poles[2].conjugate()) / 2.0
    size = pair.real * pair.real + pair.imag * pair.imag
    lone, double = (1.0, -zero, 0.0), (1.0, -2.0 * zero, 1.0)
    # The pair is nearer to the unit circle, and chooses first: both zeros, or one and the origin.
    first, second = (lone, double) if abs(pair - zero) < abs(pair) else (double, lone)
    return np.array(
        [
            [*(gain * b for b in first), 1.0, -real, 0.0],
            [*second, 1.0, -2.0 * pair.real, size],
        ]
    )


def filter_both_ways(sections: FloatArray, x: FloatArray) -> FloatArray:
    """Return ``x``, of shape (n,) with n above `EDGE`, filtered forward and then backward.

    Each end is continued by its mirror image about the last value; a run begins at rest there.
    Raises InputError for a shorter one.
    """
    from floatref.estimators.laser_place.kernel import filter_sections

    if x.size <= EDGE:
        raise InputError(f"filter: {x.size} samples; give more than {EDGE}")
    before, after = 2.0 * x[0] - x[EDGE:0:-1], 2.0 * x[-1] - x[-2 : -(EDGE + 2) : -1]
    found, rest = np.concatenate((before, x, after)), _at_rest(sections)
    for _ in range(2):
        filter_sections(sections, rest * found[0], found)
        found = np.ascontiguousarray(found[::-1])
    return found[EDGE:-EDGE]


def _at_rest(sections: FloatArray) -> FloatArray:
    """Return what the sections remember, shape (2, 2), of a constant input of 1."""
    rest, gain = np.empty((len(sections), 2)), 1.0
    for state, (b0, b1, b2, _, a1, a2) in zip(rest, sections, strict=True):
        past = np.array([[1.0 + a1, -1.0], [a2, 1.0]])
        state[:] = gain * np.linalg.solve(past, np.array([b1 - a1 * b0, b2 - a2 * b0]))
        gain *= np.sum([b0, b1, b2]) / np.sum([1.0, a1, a2])
    return rest
