"""What a failing device resembles: flaws of the catalogue, and how much each has in common."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any


@dataclass(frozen=True)
class Likeness:
    """A flaw that a device resembles.

    Attributes:
        mutant: the device that has the flaw.
        flaw: its name in the catalogue.
        alike: 1 for a device with the same errors, 0 for one with nothing in common.
    """

    mutant: str
    flaw: str
    alike: float


@dataclass(frozen=True)
class Resemblance:
    """The flaws that a failing device resembles most. An indication, no proof.

    Attributes:
        found_by: "probes", a fixed set of recordings, or "report", the faults of the run itself.
        flaws: at most three, the nearest first; empty where no flaw is near.
        least: how much a flaw has to have in common to be named.
        features: the errors on the probes, by which the flaws are compared; None where a probe
            gives no value.
        note: why there are no features, where they are missing.
    """

    found_by: str
    flaws: tuple[Likeness, ...] = ()
    least: float = 0.0
    features: Mapping[str, float | None] = field(default_factory=lambda: MappingProxyType({}))
    note: str = ""


def resemblance_document(found: Resemblance) -> dict[str, Any]:
    """Return ``found`` as the object `resemblance` of a report."""
    return {
        "found_by": found.found_by,
        "flaws": [
            {"mutant": one.mutant, "flaw": one.flaw, "alike": one.alike} for one in found.flaws
        ],
        "least": found.least,
        "features": dict(found.features),
        "note": found.note,
    }
