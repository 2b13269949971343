"""The IRI of the valid points of a profile, by segment, with the share of the road it is over."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_1_iri import START_LENGTH, iri_trace
from floatref_reference.chapter_2.section_2_1_2_iri_scale import segment_ends
from floatref_reference.signals import ZERO, Samples, samples


class ValidSegment(NamedTuple):
    """The IRI of the valid points of one segment.

    Args:
        iri: m/km; None where no stretch counts.
        share: part of its intervals that count, 0 to 1.
        invalid: length of the points that are not valid, m.
    """

    iri: np.longdouble | None
    share: float
    invalid: float


def stretches(valid: list[bool], dx: float) -> list[tuple[int, int]]:
    """Find the stretches of valid points that are longer than the car needs to start.

    Equation:
        Points a … b-1 are valid, a-1 and b are not or do not exist, and b - a > round(11 m / Δx).

    Args:
        valid: whether each point is valid, N values.
        dx: constant interval Δx, m.

    Returns:
        a and b of each, in order.
    """
    needed = max(round(START_LENGTH / dx), 1)
    found, first = [], 0
    for k in range(len(valid) + 1):
        if k == len(valid) or not valid[k]:
            if k - first > needed:
                found.append((first, k))
            first = k + 1
    return found


def trace_of_valid(z: npt.ArrayLike, valid: list[bool], dx: float) -> list[np.longdouble | None]:
    """Run the car over each stretch as over a profile of its own.

    Equation:
        Steps 1 to 3 of section 2.1.1 for points a … b-1 of every stretch.

    Args:
        z: elevation, m, N values; those that are not valid do not matter.
        valid: whether each point is valid, N values.
        dx: constant interval Δx, m.

    Returns:
        Signed output, m/km, of each of the N-1 intervals; None where no stretch counts.
    """
    elevation = list(np.asarray(z, dtype=np.longdouble))
    trace: list[np.longdouble | None] = [None] * (len(elevation) - 1)
    for first, end in stretches(valid, dx):
        trace[first : end - 1] = samples(iri_trace(elevation[first:end], dx))
    return trace


def valid_segment_iri(
    z: npt.ArrayLike, valid: list[bool], dx: float, length: float
) -> list[ValidSegment]:
    """Compute the IRI of the valid points of consecutive segments.

    Equation:
        Step 4 of section 2.1.1 over those intervals of a segment that lie in a stretch. A point
        that is not valid stands for one interval, and for no more than the segment has.

    Args:
        z: elevation, m, N values; those that are not valid do not matter.
        valid: whether each point is valid, N values.
        dx: constant interval Δx, m.
        length: nominal segment length, m.

    Returns:
        The figures of each segment, in order.
    """
    trace = trace_of_valid(z, valid, dx)
    found = []
    for first, end in segment_ends(len(trace), dx, length):
        counted: Samples = [y for y in trace[first:end] if y is not None]
        total = ZERO
        for y in counted:
            total += abs(y)
        value = total / len(counted) if counted else None
        last = end + 1 if end == len(trace) else end
        invalid = min(valid[first:last].count(False), end - first)
        found.append(ValidSegment(value, len(counted) / (end - first), invalid * dx))
    return found
