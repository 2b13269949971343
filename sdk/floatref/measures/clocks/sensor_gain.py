"""How many times a height moves as its accelerometer says: 1, unless unit, scale or sign is wrong.

A vehicle that has stopped still swings on its springs, and over a road that does not move the
height is the body's own motion: its ratio to the twice integrated acceleration is a number that
no road has a part in.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from floatref.measures.clocks.skew_series import RATE_HZ, STEP_S, on_grid, standing, stretches
from floatref.measures.clocks.skew_windows import SkewWindow, skew_window
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.recording import Channel

WINDOW_S, STANDS_S = 1.5, 0.7
"""A window, and the least of one."""
STANDS_M = 0.002
"""A vehicle that moves by less in `STANDS_S` stands."""
LEAST_COHERENCE = 0.99
LEAST_MOTION_M = 2e-4
"""Motion that the accelerometer has to feel."""
LARGEST_SKEW_S = 0.02
"""With a greater one an axle that hops has the other sign."""
SLOWEST_HZ = 100.0
STRANGE = 0.25
"""A gain that is off by more is no tolerance of a sensor."""


def sensor_gain(force: Channel, height: Channel, distance: Channel) -> float:
    """Return how many times ``height`` moves as the vertical ``force`` says; NaN if that is open.

    Windows of a second and a half count where the vehicle stands by its ``distance`` and both
    sensors see one motion. Of them the one with the most motion tells; a negative gain is a height
    of the wrong sign.
    """
    begin = max(force.span_s[0], height.span_s[0])
    end = min(force.span_s[1], height.span_s[1])
    if min(force.mean_rate_hz, height.mean_rate_hz) < SLOWEST_HZ or end - begin < WINDOW_S:
        return np.nan
    grid: FloatArray = begin + STEP_S * np.arange(int((end - begin) * RATE_HZ) + 1.0)
    stands = standing(distance, grid, STANDS_M, STANDS_S)
    if not stands.any():
        return np.nan
    force_series, height_series = on_grid(force, grid), on_grid(height, grid)
    for sign in (1.0, -1.0):
        told = [w for w in _windows(force_series, sign * height_series, stands) if _tells(w)]
        if told:
            return sign * max(told, key=lambda window: window.motion_m / window.gain).gain
    return np.nan


def gain_warning(gain: float, height: Channel) -> str | None:
    """Return a line that says what may be wrong if ``height`` has a strange ``gain``, else None."""
    if not abs(gain - 1.0) > STRANGE:
        return None
    wrong = "sign" if gain < 0 else "unit or scale, or the accelerometer's,"
    return (
        f"channel {height.id}: moves {gain:.3g} times as the accelerometer says, where the "
        f"vehicle stands and swings; its {wrong} is wrong, so correct it in the map"
    )


def _windows(force: FloatArray, height: FloatArray, stands: BoolArray) -> Iterator[SkewWindow]:
    for first, end in stretches(stands):
        many = max(1, round((end - first) * STEP_S / WINDOW_S))
        for a, b in pairwise(np.linspace(first, end, many + 1).astype(int).tolist()):
            window = skew_window(force, height, a, b - a) if b - a >= STANDS_S * RATE_HZ else None
            if window is not None:
                yield window


def _tells(window: SkewWindow) -> bool:
    moves = window.motion_m >= LEAST_MOTION_M * window.gain
    one = 1.0 - window.rest**2 >= LEAST_COHERENCE
    return moves and one and abs(window.skew_s) <= LARGEST_SKEW_S
