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
    """The number of cases that a check draws; it does not depend on time."""

    QUICK = "quick"
    CERTIFICATION = "certification"

    @property
    def searched(self) -> int:
        """The number of cases that the search draws for each check."""
        return {Effort.QUICK: 3, Effort.CERTIFICATION: 30}[self]

    @property
    def shrunk(self) -> int:
        """The largest number of cases tried to simplify a failing one."""
        return {Effort.QUICK: 12, Effort.CERTIFICATION: 60}[self]


Limits = Mapping[DeviceClass, float]
"""The largest allowed value of each class, above zero; a class without an entry has no limit."""


def same_limit(nominal: float, reference: float) -> Limits:
    """Return limits where nominal and adequate profilers have the same one."""
    return {
        DeviceClass.NOMINAL: nominal,
        DeviceClass.ADEQUATE: nominal,
        DeviceClass.REFERENCE: reference,
    }


def write_limits(limits: Limits, unit: str = "") -> dict[DeviceClass, str]:
    """Return ``limits`` in words, with their unit."""
    return {c: f"{limit:.3g} {unit}".strip() for c, limit in limits.items()}


def lowest(classes: list[DeviceClass | None]) -> DeviceClass | None:
    """Return the easiest of ``classes``; None if the list is empty or contains None."""
    reached = [c for c in classes if c is not None]
    if not reached or len(reached) < len(classes):
        return None
    return min(reached, key=lambda c: c.rank)
