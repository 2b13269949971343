"""The classes of profilers, from the easiest limits to the strictest."""

from collections.abc import Mapping
from enum import StrEnum


class DeviceClass(StrEnum):
    """A class of profilers; members are ordered from the easiest limits to the strictest."""

    NOMINAL = "nominal"
    ADEQUATE = "adequate"
    REFERENCE = "reference"

    @property
    def rank(self) -> int:
        """Position from the easiest, 0, to the strictest."""
        return list(DeviceClass).index(self)


class Effort(StrEnum):
    """How many cases a check draws: a number, never a time."""

    QUICK = "quick"
    CERTIFICATION = "certification"

    @property
    def searched(self) -> int:
        """How many cases the search draws for each check."""
        return {Effort.QUICK: 3, Effort.CERTIFICATION: 30}[self]

    @property
    def shrunk(self) -> int:
        """How many cases at most are tried to make a failing one simpler."""
        return {Effort.QUICK: 12, Effort.CERTIFICATION: 60}[self]


Limits = Mapping[DeviceClass, float]
"""The largest value allowed in each class, above zero; a class that is missing has no limit."""


def same_limit(nominal: float, reference: float) -> Limits:
    """Return the limits of a check that nominal and adequate profilers share."""
    return {
        DeviceClass.NOMINAL: nominal,
        DeviceClass.ADEQUATE: nominal,
        DeviceClass.REFERENCE: reference,
    }


def lowest(classes: list[DeviceClass | None]) -> DeviceClass | None:
    """Return the easiest of ``classes``; None if there are none or one of them is None."""
    reached = [c for c in classes if c is not None]
    if not reached or len(reached) < len(classes):
        return None
    return min(reached, key=lambda c: c.rank)
