"""How a run is divided for a fixed lag: into sections of some nodes, a standstill being one."""

from collections.abc import Sequence
from typing import NamedTuple


class Sections(NamedTuple):
    """How a run is divided.

    Equation:
        See `divide`

    Attributes:
        ends: nodes at which sections end.
        composed: of each node whether it counts as one with the nodes before it.
    """

    ends: list[int]
    composed: list[bool]


def divide(points: Sequence[int], length: int, patience: int) -> Sections:
    """Divide a run into sections.

    Equation:
        A section ends with its node number ``length``. Where more than ``patience`` nodes in a row
        have brought no point, these further ones count as one.

    Args:
        points: points reached before each node.
        length: nodes of a section.
        patience: see above.

    Returns:
        The sections.
    """
    found, count, empty, composed = Sections([], []), 0, 0, False
    for k, reached in enumerate(points):
        empty = 0 if k > 0 and reached > points[k - 1] else empty + 1
        before, composed = composed, empty > patience and (composed or count + 2 <= length)
        found.composed.append(composed)
        if not (before and composed):
            count += 1
        if count == length and not composed:
            found.ends.append(k)
            count = 0
    return found
