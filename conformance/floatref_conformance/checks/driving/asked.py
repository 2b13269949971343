"""The quantities of a stretch of profile that a rule limits."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from floatref_conformance.checks import scoring
from floatref_conformance.checks.evidence import Pair
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits, write_limits
from floatref_conformance.editions.edition import Table

LOSS, ERROR = "correlation loss", "IRI error"


@dataclass(frozen=True)
class Requirement:
    """A limited quantity of a stretch.

    Attributes:
        quantity: its name.
        words: the text of each class's limit, if it has one.
        measure: measures it, from a pair of truth and result and the name of the wheel path.
    """

    quantity: str
    words: Mapping[DeviceClass, str]
    measure: Callable[[Pair, str], Measurement]


def read_requirement(entry: Table, in_m_per_km: str, in_percent: str = ERROR) -> Requirement:
    """Return the requirement of an ``entry`` of the edition, with its limits by class.

    ``in_m_per_km`` and ``in_percent`` are the names of an IRI error in these units.
    """
    kind, by_class = entry["kind"], {c: entry[c.value] for c in DeviceClass if c.value in entry}
    if kind == "loss":
        return loss(by_class)
    if kind == "percent":
        return percent(by_class, in_percent)
    ((device_class, limit),) = by_class.items()
    if kind == "either":
        return either(device_class, limit["loss"], limit["percent"])
    return within(in_m_per_km, device_class, limit["percent"], limit["m_per_km"])


def limits_of(table: Table) -> Limits:
    """Return the limits of a table of the edition by class."""
    return {DeviceClass(name): limit for name, limit in table.items()}


def loss(limits: Limits) -> Requirement:
    """Return the requirement on one minus (2.16), the agreement of the IRI filter's outputs."""
    words = write_limits(limits)
    return Requirement(LOSS, words, lambda pair, track: scoring.correlation(pair, track, limits))


def percent(limits: Limits, quantity: str = ERROR) -> Requirement:
    """Return the requirement on the IRI's error in percent of the road's IRI."""

    def measure(pair: Pair, track: str) -> Measurement:
        return replace(scoring.roughness_percent(pair, track, limits), quantity=quantity)

    return Requirement(quantity, write_limits(limits, "%"), measure)


def either(device_class: DeviceClass, loss_limit: float, error_percent: float) -> Requirement:
    """Return the requirement that either quantity is within its limit, for one class."""

    def measure(pair: Pair, track: str) -> Measurement:
        return scoring.better(
            scoring.correlation(pair, track, {device_class: loss_limit}),
            scoring.roughness_percent(pair, track, {device_class: error_percent}),
            device_class,
        )

    words = {device_class: f"{loss_limit:g}, or the IRI within {error_percent:g} %"}
    return Requirement(LOSS, words, measure)


def within(
    quantity: str, device_class: DeviceClass, error_percent: float, m_per_km: float
) -> Requirement:
    """Return the requirement on the IRI's error: percent of the road's, or m/km if larger."""
    limits = {device_class: (error_percent, m_per_km)}

    def measure(pair: Pair, track: str) -> Measurement:
        return scoring.roughness_within(pair, track, quantity, limits)

    words = {device_class: f"{error_percent:g} % of the road's or {m_per_km:g} m/km"}
    return Requirement(quantity, words, measure)
