"""3.3.5.1 Characterization of Speed Profiles, and of stops (3.3.7), as in Tables 5.1 and 5.2."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_3.section_3_2_3_speed import INTERVAL, averaged, differentiated
from floatref_reference.signals import STANDARD_GRAVITY, Real, Samples, mean, samples

KMH = 1 / np.longdouble("3.6")
BAND = (np.longdouble("70.5") * KMH, np.longdouble("0.5") * KMH)
"""Speeds between which section 5.2 averages the deceleration of a stop from 72 km/h, m/s."""
V_REST = np.longdouble("0.16") * KMH
"""Speed below which a vehicle is stationary, m/s: of section 6.6.3, since 3.3.7 has no figure."""
REJECTED = 0.1
"""Acceleration over any second past a brake above which a pass was rejected, g."""
WATCHED = 150.0
"""Travel past a brake over which that holds, m."""


class Pulse(NamedTuple):
    """Deceleration of a brake.

    Args:
        average: between two speeds, g.
        peak: greatest over any second between them, g; the average if that takes less.
        begin: time of the higher speed, s.
        end: time of the lower speed, s.
    """

    average: np.longdouble
    peak: np.longdouble
    begin: np.longdouble
    end: np.longdouble


class Stop(NamedTuple):
    """A standstill.

    Args:
        location: where, m.
        duration: for how long, s.
    """

    location: np.longdouble
    duration: np.longdouble


def crossings(v: npt.ArrayLike, dt: Real, v_0: Real, v_1: Real) -> tuple[np.longdouble, ...]:
    """Find when a brake passes two speeds.

    Equation:
        Section 5.2: v_1 is first reached when the speed, straight between samples, falls to it; v_0
        was last held before that. Without noise the two are the only ones.

    Args:
        v: speed, m/s, shape (N,).
        dt: sampling period Δt, s.
        v_0: higher speed, m/s.
        v_1: lower speed, m/s.

    Returns:
        Times of v_0 and v_1 from the first sample, s.

    Raises:
        ValueError: if the speed does not fall from v_0 to v_1.
    """
    v_k, high, low = samples(v), np.longdouble(v_0), np.longdouble(v_1)
    fast = [k for k in range(len(v_k)) if v_k[k] >= high]
    slow = [k for k in range(len(v_k)) if fast and k > fast[0] and v_k[k] <= low]
    if not high > low or not slow:
        raise ValueError(f"the speed does not fall from {float(high)} to {float(low)} m/s")
    last = max(k for k in fast if k < slow[0])
    return _falls_at(v_k, last, high, dt), _falls_at(v_k, slow[0] - 1, low, dt)


def _falls_at(v_k: Samples, k: int, level: np.longdouble, dt: Real) -> np.longdouble:
    """Return when the line from sample k to the next, lower one is at ``level``."""
    share = (v_k[k] - level) / (v_k[k] - v_k[k + 1])
    return (k + share) * np.longdouble(dt)


def deceleration(v: npt.ArrayLike, dt: Real, v_0: Real = BAND[0], v_1: Real = BAND[1]) -> Pulse:
    """Compute average and peak deceleration of a brake.

    Equation:
        Tables 5.1 and 5.2, section 5.2: (v_0 - v_1)/(t_1 - t_0), by default from 70.5 to 0.5 km/h.
        Section 3.3.5.1: the peak is the highest average over one second within the brake (3.2.3).

    Args:
        v: forward speed, m/s, shape (N,).
        dt: sampling period Δt, s.
        v_0: higher speed, m/s.
        v_1: lower speed, m/s.

    Returns:
        The pulse, decelerations positive and in g.

    Raises:
        ValueError: if the speed does not fall from v_0 to v_1.
    """
    begin, end = crossings(v, dt, v_0, v_1)
    average = (np.longdouble(v_0) - np.longdouble(v_1)) / (end - begin) / STANDARD_GRAVITY
    first, last = int(np.ceil(begin / dt)), int(np.floor(end / dt))
    within = samples(v)[first : last + 1]
    peak = average
    if len(within) > round(INTERVAL / float(dt)):
        peak = max(-a for a in averaged(differentiated(within, dt), dt)) / STANDARD_GRAVITY
    return Pulse(average, peak, begin, end)


def standstill(x: npt.ArrayLike, v: npt.ArrayLike, dt: Real, v_rest: Real = V_REST) -> Stop:
    """Find place and duration of the longest stop of a run.

    Equation:
        Table 5.1, section 3.3.7: "the location of the stop, the duration of the stop". The duration
        is from where the speed, straight between samples, falls to v_rest until it rises above; the
        place is the mean of the positions read meanwhile.

    Args:
        x: position along the section, m, shape (N,).
        v: speed, m/s, shape (N,).
        dt: sampling period Δt, s.
        v_rest: speed below which the vehicle is stationary, m/s.

    Returns:
        The stop.

    Raises:
        ValueError: if the vehicle is never stationary.
    """
    x_k, v_k, level = samples(x), samples(v), np.longdouble(v_rest)
    best: list[int] = []
    current: list[int] = []
    for k in range(len(v_k)):
        current = [*current, k] if v_k[k] < level else []
        if len(current) > len(best):
            best = current
    if not best:
        raise ValueError(f"the vehicle is never slower than {float(level)} m/s")
    begin, end = np.longdouble(best[0]), np.longdouble(best[-1])
    if best[0] > 0:
        begin = _falls_at(v_k, best[0] - 1, level, 1)
    if best[-1] < len(v_k) - 1:
        rise = v_k[best[-1] + 1] - v_k[best[-1]]
        end += (level - v_k[best[-1]]) / rise
    return Stop(mean([x_k[k] for k in best]), (end - begin) * np.longdouble(dt))


def place(x: npt.ArrayLike, dt: Real, t: Real) -> np.longdouble:
    """Interpolate where a vehicle was, as at the release of its brake.

    Equation:
        Table 5.2, section 3.3.5.1: "the longitudinal position of each transition", straight between
        samples.

    Args:
        x: position along the section, m, shape (N,).
        dt: sampling period Δt, s.
        t: time from the first sample, s.

    Returns:
        Position, m.
    """
    x_k, at = samples(x), np.longdouble(t) / np.longdouble(dt)
    k = min(int(np.floor(at)), len(x_k) - 2)
    return x_k[k] + (at - k) * (x_k[k + 1] - x_k[k])


def is_rejected(x: npt.ArrayLike, v: npt.ArrayLike, dt: Real, release: Real) -> bool:
    """Tell whether the driver sped up too much after a brake.

    Equation:
        Section 3.3.5.1: an acceleration above 0.1 g over any second within 150 m past the end of
        the brake.

    Args:
        x: position along the section, m, shape (N,).
        v: speed, m/s, shape (N,).
        dt: sampling period Δt, s.
        release: where the brake ended, m.

    Returns:
        Whether the pass is rejected.
    """
    past = [b for a, b in zip(samples(x), samples(v), strict=True) if 0 <= a - release <= WATCHED]
    if len(past) <= round(INTERVAL / float(dt)):
        return False
    return bool(max(averaged(differentiated(past, dt), dt)) > REJECTED * STANDARD_GRAVITY)
