"""4.5.2 Agreement to the Reference and 4.5.3 Repeatability: scores against lateral tracking."""

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_5_comparison import agreement, filtered
from floatref_reference.chapter_6.section_6_2_frames import direction_cosines
from floatref_reference.signals import mean, samples

REFERENCE_QUALITY = 0.98
"""Score of "reference quality" agreement (section 4.5.2)."""


class Scored(NamedTuple):
    """A point of figure 4.9 or 4.10.

    Args:
        offset: leftward tracking bias, or average lateral separation, m.
        score: agreement or repeatability score (2.16).
    """

    offset: np.longdouble
    score: np.longdouble


class Pass(NamedTuple):
    """A pass over a segment, or the reference's profile of it.

    Args:
        leftward: lateral position of its wheel path, m, shape (M,), at the same places in each.
        z: elevation, m, shape (N,).
    """

    leftward: npt.ArrayLike
    z: npt.ArrayLike


def footprint(
    antenna: npt.ArrayLike, psi: float, theta: float, phi: float, lever: npt.ArrayLike
) -> npt.NDArray[np.float64]:
    """Compute where a laser footprint is from the place and attitude of the GPS antenna.

    Equation:
        Section 4.5.2: position of the master antenna plus C_nb of (6.23) times the lever arm to the
        footprint.

    Args:
        antenna: forward, leftward and upward in the section's axes, m, shape (3,).
        psi: yaw from the direction of the section, rad.
        theta: pitch θ, rad.
        phi: roll φ, rad.
        lever: footprint from the antenna in body axes, m, shape (3,).

    Returns:
        Forward, leftward and upward place of the footprint, m, shape (3,).
    """
    turned = direction_cosines(psi, theta, phi) @ np.asarray(lever, np.float64)
    return np.add(antenna, turned, dtype=np.float64)


def tracking_bias(leftward: npt.ArrayLike, reference: npt.ArrayLike) -> np.longdouble:
    """Compute the leftward tracking bias of a pass.

    Equation:
        Section 4.5.2: mean of the lateral position relative to the reference trace.

    Args:
        leftward: lateral position of the pass, m, shape (M,).
        reference: that of the reference at the same places, m, shape (M,).

    Returns:
        Bias, m, positive to the left.
    """
    pairs = zip(samples(leftward), samples(reference), strict=True)
    return mean([p - q for p, q in pairs])


def lateral_separation(p: npt.ArrayLike, q: npt.ArrayLike) -> np.longdouble:
    """Compute the average lateral separation of two passes.

    Equation:
        Section 4.5.3: "the average absolute difference in lateral position".

    Args:
        p: lateral position of one, m, shape (M,).
        q: that of the other at the same places, m, shape (M,).

    Returns:
        Separation, m.
    """
    return mean([abs(a - b) for a, b in zip(samples(p), samples(q), strict=True)])


def agreement_by_bias(
    passes: Sequence[Pass], reference: Pass, dx: float, max_offset: float = 1.0
) -> list[Scored]:
    """Score passes against the reference, each with its leftward tracking bias.

    Equation:
        Figure 4.9 of section 4.5.2: (2.16) of profiles filtered by the IRI.

    Args:
        passes: passes over the segment.
        reference: what the reference measured, and where.
        dx: constant interval Δx of all elevations, m.
        max_offset: largest longitudinal offset to either side, m.

    Returns:
        Bias and score of each pass.
    """
    trace = filtered(reference.z, dx)
    return [
        Scored(
            tracking_bias(p.leftward, reference.leftward),
            agreement(trace, filtered(p.z, dx), dx, max_offset).score,
        )
        for p in passes
    ]


def repeatability_by_separation(
    passes: Sequence[Pass], dx: float, max_offset: float = 1.0
) -> list[Scored]:
    """Score every two passes against each other, each pair with its average separation.

    Equation:
        Figure 4.10 of section 4.5.3: n passes have n (n - 1)/2 pairs, 378 of 28.

    Args:
        passes: passes over the segment.
        dx: constant interval Δx of all elevations, m.
        max_offset: largest longitudinal offset to either side, m.

    Returns:
        Separation and score of each pair, in the order of the passes.
    """
    traces = [(p.leftward, filtered(p.z, dx)) for p in passes]
    return [
        Scored(lateral_separation(y_p, y_q), agreement(p, q, dx, max_offset).score)
        for (y_p, p), (y_q, q) in combinations(traces, 2)
    ]


def within(points: Sequence[Scored], offset: float) -> list[Scored]:
    """Select the points that tracked closely.

    Equation:
        Sections 4.5.2 and 4.5.3: tracking error below 6.5 cm, separation of 3 cm or less.

    Args:
        points: points of figure 4.9 or 4.10.
        offset: largest magnitude, m.

    Returns:
        Those within it.
    """
    return [point for point in points if abs(point.offset) <= offset]
