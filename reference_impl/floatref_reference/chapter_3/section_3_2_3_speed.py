"""3.2.3 Speed and Acceleration: what GPS readings of speed and heading say of a drive."""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_3.section_3_2_2_coordinates import OnEarth, OnSection, along
from floatref_reference.signals import Real, Signal, samples, signal

RATE = 20.0
"""GPS readings per second (section 3.1.4)."""
INTERVAL = 1.0
"""Length of the moving average of accelerations, s."""


def resolved(speed: Real, heading: Real, psi: Real) -> OnSection:
    """Resolve horizontal speed and heading to components along and across the section.

    Equation:
        Section 3.2.3, by (3.3): v sin(heading) east and v cos(heading) north, turned by ψ.

    Args:
        speed: horizontal speed, m/s.
        heading: rad, 0 north and positive to the east, as a receiver gives it.
        psi: direction ψ of the section (3.4), rad.

    Returns:
        Forward and leftward speed, m/s.
    """
    v, angle = np.longdouble(speed), np.longdouble(heading)
    return along(OnEarth(v * np.sin(angle), v * np.cos(angle)), psi)


def differentiated(v: npt.ArrayLike, dt: Real = 1 / RATE) -> Signal:
    """Differentiate a speed in time.

    Equation:
        Section 3.2.3: (v_{k+1} - v_k)/Δt, half a step after sample k.

    Args:
        v: speed, m/s, shape (N,), N ≥ 2.
        dt: sampling period Δt, s.

    Returns:
        Acceleration, m/s², shape (N-1,).
    """
    v_k = samples(v)
    return signal([(v_k[k + 1] - v_k[k]) / np.longdouble(dt) for k in range(len(v_k) - 1)])


def averaged(a: npt.ArrayLike, dt: Real = 1 / RATE, interval: Real = INTERVAL) -> Signal:
    """Average an acceleration over one second.

    Equation:
        Section 3.2.3: "a 1-second moving average". Sample k is the mean of a_k to a_{k+n-1}, with
        n = round(1 s/Δt); of differences that is the change of speed within the second.

    Args:
        a: acceleration, m/s², shape (N,).
        dt: sampling period Δt, s.
        interval: what the average is over, s.

    Returns:
        Averaged acceleration, m/s², shape (N-n+1,): whole intervals alone.

    Raises:
        ValueError: if the signal is shorter than the interval.
    """
    a_k, n = samples(a), max(round(float(interval) / float(dt)), 1)
    if len(a_k) < n:
        raise ValueError(f"{len(a_k)} samples are shorter than the average over {n} samples")
    return signal([np.sum(np.array(a_k[k : k + n])) / n for k in range(len(a_k) - n + 1)])
