"""A practice of certification: its limits, the clause and the source of each."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

UNITS: Mapping[str, str] = MappingProxyType(
    {
        "runs": "",
        "repeatability": "",
        "accuracy": "",
        "distance_percent": "%",
        "height_percent": "%",
        "iri_bias_percent": "%",
        "long_wave_percent": "%",
        "quiescent_m_per_km": "m/km",
        "bounce_m_per_km": "m/km",
        "interval_m": "m",
        "iri_spread_m_per_km": "m/km",
        "cutoff_wave_m": "m",
        "elevation_precision_mm": "mm",
        "elevation_bias_mm": "mm",
        "vertical_resolution_mm": "mm",
    }
)
"""Unit of the limit of every quantity that a practice may name."""

JUDGED = tuple(UNITS)[:10]
"""Quantities that a worksheet measures and can judge."""

NOT_PUBLIC, NOT_FOUND, REPORTED = "not public", "not found", "reported"
"""Words in place of a limit: it is sold, it could not be opened, or no limit is meant."""


@dataclass(frozen=True)
class Source:
    """The document that was read for a limit, its section, and a public address of it."""

    document: str
    section: str = ""
    url: str = ""

    def __str__(self) -> str:
        return ", ".join(part for part in (self.document, self.section, self.url) if part)


@dataclass(frozen=True)
class Requirement:
    """One limit of a practice.

    Attributes:
        quantity: a key of `UNITS`, in whose unit ``limit`` is.
        limit: None where its place has words.
        word: `NOT_PUBLIC`, `NOT_FOUND` or `REPORTED`; empty with a limit.
        clause: what is asked, in words.
        basis: ``read`` in the source, ``cited`` by it, ``quoted`` commonly, ``ours`` or
            ``agency``; ``option`` if it was changed.
        source: the document.
        missing: what could not be had.
        device_class: the class that it is for; empty: every class.
        verdict: whether it is judged, if it has a limit.
    """

    quantity: str
    limit: float | None
    word: str
    clause: str
    basis: str
    source: Source
    missing: str = ""
    device_class: str = ""
    verdict: bool = True

    def limit_in_words(self) -> str:
        """Return the limit with its unit, or the word in its place."""
        if self.limit is None:
            return f"limit {self.word}"
        return f"limit {self.limit:.6g} {UNITS[self.quantity]}".strip()

    @property
    def is_open(self) -> bool:
        """Whether the practice asks for this, and a worksheet cannot judge it."""
        judged = self.limit is not None and self.verdict and self.quantity in JUDGED
        return not judged and self.word != REPORTED


@dataclass(frozen=True)
class Practice:
    """A practice as the file of digest ``sha256`` has it, but for limits that are ``changed``."""

    name: str
    title: str
    version: str
    requirements: tuple[Requirement, ...]
    sha256: str
    status: str = ""
    notes: tuple[str, ...] = ()
    changed: tuple[str, ...] = ()

    def of_class(self, device_class: str) -> "Practice":
        """Return the practice with those limits alone that hold for ``device_class``."""
        wanted = ("", device_class)
        kept = tuple(one for one in self.requirements if one.device_class in wanted)
        return replace(self, requirements=kept)

    def change(self, quantity: str, limit: float | None, setter: str) -> "Practice":
        """Return the practice with ``limit`` for ``quantity``; None: reported, not judged.

        Its clause names ``setter`` and what the practice has. A limit that it has is no change.
        """
        if limit == self.limit_of(quantity):
            return self
        found = self.find(quantity)
        clause = f"set by {setter}; the practice has: {_in_words(found)}"
        word = REPORTED if limit is None else ""
        made = Requirement(quantity, limit, word, clause, "option", Source(setter))
        kept = tuple(one for one in self.requirements if one.quantity != quantity)
        return replace(self, requirements=(*kept, made), changed=(*self.changed, quantity))

    def find(self, quantity: str) -> Requirement | None:
        """Return the first requirement for ``quantity``; None if the practice has no such."""
        return next((one for one in self.requirements if one.quantity == quantity), None)

    def limit_of(self, quantity: str) -> float | None:
        """Return the limit of ``quantity`` that is judged; None: reported, not judged."""
        found = self.find(quantity)
        return found.limit if found and found.verdict else None

    def clause_of(self, quantity: str) -> str:
        """Return where the limit of ``quantity`` comes from, or that there is no such limit."""
        found = self.find(quantity)
        return found.clause if found else f"{self.name} has no limit for this: reported only"

    def open_requirements(self) -> tuple[Requirement, ...]:
        """Return what the practice asks for and a worksheet cannot judge."""
        return tuple(one for one in self.requirements if one.is_open)


def _in_words(found: Requirement | None) -> str:
    """Return what a practice has for a quantity, in words."""
    if found is None or found.word == REPORTED:
        return "no limit"
    return found.limit_in_words() if found.verdict else f"{found.limit_in_words()}, not judged"
