"""Gain of a height against its accelerometer: 1, unless unit, scale or sign is wrong.

A vehicle that has stopped still swings on its springs, and over a road that does not move the
height is the body's own motion: its ratio to the twice integrated acceleration does not depend on
the road.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from floatref.measures.clocks.skew_series import RATE_HZ, STEP_S, find_standing, on_grid, stretches
from floatref.measures.clocks.skew_windows import SkewWindow, skew_window
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.recording import Channel

WINDOW_S, STANDS_S = 1.5, 0.7
"""Length of a window in s, and the least length of one."""
STANDS_M = 0.002
"""Travel in m during `STANDS_S` below which a vehicle is stationary."""
LEAST_COHERENCE = 0.99
LEAST_MOTION_M, STILL_SEEN_M = 2e-4, 2e-5
"""Least motion by the accelerometer, in m, of a window that gives a gain, and of one that denies
it."""
RIGHT = 0.1
"""Largest deviation from 1 of a gain that denies a strange one."""
LARGEST_SKEW_S = 0.02
"""Largest skew in s: with a greater one an axle that hops has the other sign."""
SLOWEST_HZ = 100.0
STRANGE = 0.25
"""Largest deviation of a gain from 1 by the tolerances of sensors."""


def sensor_gain(force: Channel, height: Channel, distance: Channel) -> float:
    """Return the gain of ``height`` against the vertical ``force``; NaN if it is unknown.

    Windows of 1.5 s count where the vehicle is stationary by its ``distance`` and both sensors
    measure one motion. The window with the most motion gives the gain; a negative gain is a height
    of the wrong sign. A wrong unit is wrong in every window: where another one is right, that one
    gives the gain. On a hump the jolt of a stop pitches the body, and its laser's spot goes up or
    down the slope; a second later it does no more.
    """
    begin = max(force.span_s[0], height.span_s[0])
    end = min(force.span_s[1], height.span_s[1])
    if min(force.mean_rate_hz, height.mean_rate_hz) < SLOWEST_HZ or end - begin < WINDOW_S:
        return np.nan
    grid: FloatArray = begin + STEP_S * np.arange(int((end - begin) * RATE_HZ) + 1.0)
    stands = find_standing(distance, grid, STANDS_M, STANDS_S)
    if not stands.any():
        return np.nan
    force_series, height_series = on_grid(force, grid), on_grid(height, grid)
    for sign in (1.0, -1.0):
        alike = [w for w in _windows(force_series, sign * height_series, stands) if _is_one(w)]
        if any(_moved_m(window) >= LEAST_MOTION_M for window in alike):
            return sign * _choose(alike).gain
    return np.nan


def _choose(alike: Sequence[SkewWindow]) -> SkewWindow:
    """Return the window with the most motion, or one that denies its gain."""
    most = max(alike, key=_moved_m)
    if abs(most.gain - 1.0) <= STRANGE:
        return most
    right = min(alike, key=lambda window: abs(window.gain - 1.0))
    return right if abs(right.gain - 1.0) <= RIGHT else most


def _moved_m(window: SkewWindow) -> float:
    """Return the motion by the accelerometer, in m."""
    return window.motion_m / window.gain


def gain_warning(gain: float, height: Channel) -> str | None:
    """Return a warning with the probable cause if ``height`` has a strange ``gain``, else None."""
    if not abs(gain - 1.0) > STRANGE:
        return None
    wrong = "sign" if gain < 0 else "unit or scale, or the accelerometer's,"
    return (
        f"channel {height.id}: moves {gain:.3g} times as far as the accelerometer, where the "
        f"stationary vehicle swings; its {wrong} is wrong, so correct it in the map"
    )


def _windows(force: FloatArray, height: FloatArray, stands: BoolArray) -> Iterator[SkewWindow]:
    for first, end in stretches(stands):
        many = max(1, round((end - first) * STEP_S / WINDOW_S))
        for a, b in pairwise(np.linspace(first, end, many + 1).astype(int).tolist()):
            window = skew_window(force, height, a, b - a) if b - a >= STANDS_S * RATE_HZ else None
            if window is not None:
                yield window


def _is_one(window: SkewWindow) -> bool:
    """Return whether both sensors measure one motion there."""
    moves = _moved_m(window) >= STILL_SEEN_M
    one = 1.0 - window.rest**2 >= LEAST_COHERENCE
    return moves and one and abs(window.skew_s) <= LARGEST_SKEW_S
