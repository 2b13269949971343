"""What a level accelerometer and a laser in its place would read."""

from typing import NamedTuple

import numpy as np

from floatref_reference.road_slope.symbols import Vector


class Levelled(NamedTuple):
    """Readings of a level accelerometer: a_z in m/s² and h in m, shape (n,) each."""

    vertical: Vector
    height: Vector


class Samples(NamedTuple):
    """What one wheel path recorded in the stretch.

    Equation:
        a_z, a and h

    Attributes:
        t: time, s, shape (n,).
        vertical: a_z, vertical specific force less 1 g, m/s², shape (n,).
        along: a along the road, m/s², shape (n,).
        height: h, m, shape (n,).
    """

    t: Vector
    vertical: Vector
    along: Vector
    height: Vector


class Found(NamedTuple):
    """What least squares found of the body and the road.

    Equation:
        θ_k, λ and s̄

    Attributes:
        t: times of the nodes, s, increasing, shape (K,).
        pitch: θ_k, rad, shape (K,).
        lean: λ, rad.
        grade: s̄, mean of s_j.
    """

    t: Vector
    pitch: Vector
    lean: float
    grade: float


def levelled(samples: Samples, found: Found, lever: float, g: float) -> Levelled:
    """Take the pitch out of what was recorded.

    Equation:
        a_z + a (P - s̄) + g (P² - λ²)/2 and h - l θ, P = θ + λ, θ linear between nodes

    Args:
        samples: what was recorded.
        found: pitch, lean and grade.
        lever: l, m.
        g: gravity, m/s².
    """
    theta = np.interp(samples.t, found.t, found.pitch)
    leaning = theta + found.lean
    added = samples.along * (leaning - found.grade) + g / 2 * (leaning**2 - found.lean**2)
    return Levelled(samples.vertical + added, samples.height - lever * theta)
