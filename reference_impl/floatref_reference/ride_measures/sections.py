"""Sections of 0.1 mile, as the Highway Performance Monitoring System reports them."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.chapter_2.section_2_1_2_iri_scale import inches_per_mile, segment_iri
from floatref_reference.signals import Real

TENTH_OF_A_MILE = 160.9344


class Section(NamedTuple):
    """One section of a lane.

    Attributes:
        start: m from the first point.
        length: m.
        iri: mean IRI of its wheel paths, m/km.
        rating: "good", "fair" or "poor".
    """

    start: float
    length: float
    iri: np.longdouble
    rating: str


def rating(iri_m_per_km: Real) -> str:
    """Rate a section.

    Equation:
        23 CFR 490.313(b)(1): less than 95 in/mi is good, greater than 170 in/mi poor, else fair.

    Args:
        iri_m_per_km: IRI, m/km.

    Returns:
        "good", "fair" or "poor".
    """
    value = inches_per_mile(iri_m_per_km)
    if value < 95:
        return "good"
    return "poor" if value > 170 else "fair"


def sections(
    paths: list[npt.ArrayLike], dx: float, length: float = TENTH_OF_A_MILE
) -> list[Section]:
    """Divide a lane into sections.

    Equation: 23 CFR 490.309 to 490.313: the mean of the IRIs of the wheel paths (AASHTO R 43) over
    0.1 mile.

    Args:
        paths: elevation of one or two wheel paths, m, each of shape (N,).
        dx: constant interval Δx, m.
        length: nominal length of a section, m.

    Returns:
        The sections, in order; the last one may be shorter.
    """
    found = []
    for parts in zip(*(segment_iri(path, dx, length) for path in paths), strict=True):
        start, size, total = parts[0]
        for _, _, value in parts[1:]:
            total = total + value
        mean_iri = np.longdouble(total / len(parts))
        found.append(Section(start, size, mean_iri, rating(mean_iri)))
    return found
