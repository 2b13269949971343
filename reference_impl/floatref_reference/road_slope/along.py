"""Acceleration along the road as sharp as the encoder's counts allow, and its jolts."""

from math import exp

import numpy as np

from floatref_reference.road_slope.middles import bent, mean, middles
from floatref_reference.road_slope.symbols import Stretch, Vector, is_cut

COARSE = 0.1
"""ν in m/s² of which half of the encoder's own difference is taken."""
MOVING = 0.5
"""V_k in m/s from which ν is taken."""
TO_SIGMA = 1.4826
"""1-σ of a normal law over its median magnitude."""
FADES = 0.5
"""Seconds in which a jolt fades to a part of 1/e."""
BESIDE = 3
"""Nodes on both sides that a jolt reaches."""


def sharper(stretch: Stretch) -> Vector:
    """Return what the encoder's places have of acceleration that a_k, being smooth, has not.

    Equation:
        D_k(x) - ⟨a⟩_k at the middles

    Args:
        stretch: what is known.

    Returns:
        m/s², shape (K,), NaN at nodes that are no middles.
    """
    run, interval = stretch.readings, stretch.constants.interval_s
    more = np.full(len(run.place), np.nan)
    for k in middles(stretch):
        more[k] = bent(run.place, k, interval) - mean(run.along, k)
    return more


def share_of_encoder(stretch: Stretch) -> float:
    """Return how much of the encoder's own difference is taken.

    Equation:
        w = 1/(1 + (ν/0.1 m/s²)²), ν = 1.4826 median |D_k(x) - ⟨a⟩_k| over middles with
        V_k ≥ 0.5 m/s; w = 1 without any

    Args:
        stretch: what is known.
    """
    more, speed = sharper(stretch), stretch.readings.speed
    moving = [abs(more[k]) for k in middles(stretch) if speed[k] >= MOVING]
    if not moving:
        return 1.0
    return float(1 / (1 + (TO_SIGMA * np.median(moving) / COARSE) ** 2))


def sharp_acceleration(stretch: Stretch) -> Vector:
    """Return the acceleration along the road that the pitch answers.

    Equation:
        ã_k = ⟨a⟩_k + w (D_k(x) - ⟨a⟩_k)

    Args:
        stretch: what is known.

    Returns:
        m/s², shape (K,), NaN at nodes that are no middles.
    """
    more, share = sharper(stretch), share_of_encoder(stretch)
    sharp = np.full(len(more), np.nan)
    for k in middles(stretch):
        sharp[k] = mean(stretch.readings.along, k) + share * more[k]
    return sharp


def fading(stretch: Stretch) -> Vector:
    """Return the sum of all changes of acceleration, which fades.

    Equation:
        S_k = S_{k-1} e^{-Δ/0.5 s} + |a_k - a_{k-1}|, S = 0 at the first node of each piece

    Args:
        stretch: what is known.

    Returns:
        S_k, m/s², shape (K,).
    """
    a, fade = stretch.readings.along, exp(-stretch.constants.interval_s / FADES)
    S = np.zeros(len(a))
    for k in range(1, len(a)):
        if not is_cut(stretch, k):
            S[k] = S[k - 1] * fade + abs(a[k] - a[k - 1])
    return S


def jolts(stretch: Stretch) -> Vector:
    """Return how hard the acceleration changed about each node.

    Equation:
        J_k = max S_i over |i - k| ≤ 3, also beyond a cut

    Args:
        stretch: what is known.

    Returns:
        J_k, m/s², shape (K,).
    """
    S = fading(stretch)
    return np.array([max(S[max(k - BESIDE, 0) : k + BESIDE + 1]) for k in range(len(S))])
