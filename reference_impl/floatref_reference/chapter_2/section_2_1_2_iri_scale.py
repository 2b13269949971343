"""2.1.2 The IRI Scale: segments, units and ratings."""

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_1_iri import iri_trace
from floatref_reference.signals import Real, mean

SEGMENT_LENGTH = 160.9
INCHES_PER_MILE = np.longdouble(63360)


def segment_iri(
    z: npt.ArrayLike, dx: float, length: float = SEGMENT_LENGTH
) -> list[tuple[float, float, np.longdouble]]:
    """Compute the IRI of consecutive segments.

    Equation:
        Step 4 of section 2.1.1 over each segment of one pass of the car over the whole
        profile. Segment m ends at the point nearest to m times the length; the last one may
        be shorter, but a rest of less than a tenth of the length belongs to the segment before it
        (23 CFR 490.309: sections of 0.1 mile are at most 0.11 mile long).

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        length: nominal segment length, m.

    Returns:
        Start, m from the first point, length, m, and IRI, m/km, of each segment.
    """
    trace = np.abs(iri_trace(z, dx))
    return [
        (begin * dx, (end - begin) * dx, mean(trace[begin:end]))
        for begin, end in segment_ends(len(trace), dx, length)
    ]


def segment_ends(count: int, dx: float, length: float = SEGMENT_LENGTH) -> list[tuple[int, int]]:
    """Divide a profile into segments.

    Equation:
        Segment m ends at round(m length / Δx); a rest of less than length/10 joins the one before.

    Args:
        count: number of intervals.
        dx: constant interval Δx, m.
        length: nominal segment length, m.

    Returns:
        The first interval of each segment, and the one behind its last.
    """
    segments: list[tuple[int, int]] = []
    begin = 0
    while begin < count:
        end = min(max(round((len(segments) + 1) * length / dx), begin + 1), count)
        segments.append((begin, end))
        begin = end
    # Nine digits decide whether it is exactly a tenth: Δx and length are rounded numbers.
    if len(segments) > 1 and (count - segments[-1][0]) * dx < length / 10 * (1 - 1e-9):
        rest = segments.pop()
        segments[-1] = (segments[-1][0], rest[1])
    return segments


def inches_per_mile(iri_m_per_km: Real) -> np.longdouble:
    """Convert an IRI to the unit used in the United States.

    Equation:
        Section 2.1.2: 1 m/km = 63360 in/mi / 1000.

    Args:
        iri_m_per_km: IRI, m/km.

    Returns:
        IRI, in/mi.
    """
    return np.longdouble(iri_m_per_km) * INCHES_PER_MILE / 1000


def tpm_rating(iri_m_per_km: Real) -> str:
    """Rate a pavement section.

    Equation:
        Table 2.1, TPM range: good below 1.50 m/km, fair up to 2.68 m/km, poor above.

    Args:
        iri_m_per_km: IRI, m/km.

    Returns:
        "good", "fair" or "poor".
    """
    if iri_m_per_km < 1.5:
        return "good"
    return "fair" if iri_m_per_km <= 2.68 else "poor"


def pre_tpm_rating(iri_m_per_km: Real, interstate: bool) -> str:
    """Rate a pavement section as was done before the TPM system.

    Equation:
        Table 2.1, pre-TPM ranges for Interstate and non-Interstate. A limit that two ranges share
        belongs to the worse one, as 0.95 and in the TPM range 1.50 m/km do; poor is above its own.

    Args:
        iri_m_per_km: IRI, m/km.
        interstate: whether the section is of an Interstate highway.

    Returns:
        "very good", "good", "fair", "mediocre" or "poor".
    """
    fair, mediocre = (1.89, 2.68) if interstate else (2.68, 3.47)
    for limit, rating in ((0.95, "very good"), (1.5, "good"), (fair, "fair")):
        if iri_m_per_km < limit:
            return rating
    return "mediocre" if iri_m_per_km <= mediocre else "poor"
