"""What a profiler has to reach: the limits of a practice, by class."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from floatref_conformance.certify.practice.practice_document import DEFAULT, read_own
from floatref_conformance.certify.practice.requirements import Practice
from floatref_conformance.classes import DeviceClass

_OURS = read_own(DEFAULT).of_class(DeviceClass.NOMINAL.value)


def _limit(quantity: str) -> float | None:
    return _OURS.limit_of(quantity)


@dataclass(frozen=True)
class CertificationLimits:
    """The limits of a worksheet, those of the default practice unless given; None: not judged.

    Attributes:
        runs: repeated runs at each test section, at least.
        repeatability: cross correlation of the runs, averaged over all pairs.
        accuracy: cross correlation with the reference, averaged over the runs.
        distance_percent: error of the distance, in magnitude.
        height_percent: error of the scale of heights, in magnitude.
        iri_bias_percent: mean error of the IRI against the reference's, in magnitude.
        long_wave_percent: error of waves of 4 to 25 m, beyond the scale of heights.
        quiescent_m_per_km, bounce_m_per_km: IRI of the stationary tests.
        interval_m: between the points of a run, at most.
        practice: where they come from.
    """

    runs: int | None = int(_limit("runs") or 0)
    repeatability: float | None = _limit("repeatability")
    accuracy: float | None = _limit("accuracy")
    distance_percent: float | None = _limit("distance_percent")
    height_percent: float | None = _limit("height_percent")
    iri_bias_percent: float | None = _limit("iri_bias_percent")
    long_wave_percent: float | None = _limit("long_wave_percent")
    quiescent_m_per_km: float | None = _limit("quiescent_m_per_km")
    bounce_m_per_km: float | None = _limit("bounce_m_per_km")
    interval_m: float | None = _limit("interval_m")
    practice: Practice = field(default=_OURS, repr=False)

    def figures(self) -> dict[str, float | None]:
        """Return every limit by its name."""
        return {name: getattr(self, name) for name in LIMITED}

    def clause(self, quantity: str) -> str:
        """Return where the limit of ``quantity`` comes from."""
        return self.practice.clause_of(quantity)


LIMITED = tuple(one.name for one in fields(CertificationLimits) if one.name != "practice")
"""The quantities that have a limit."""


def limits_of(device_class: DeviceClass, practice: Practice | None = None) -> CertificationLimits:
    """Return the limits of ``practice``, the default one without it, for ``device_class``."""
    chosen = (practice or read_own(DEFAULT)).of_class(device_class.value)
    found = {name: chosen.limit_of(name) for name in LIMITED}
    runs = found.pop("runs")
    return CertificationLimits(None if runs is None else int(runs), **found, practice=chosen)


def change_limits(
    limits: CertificationLimits, given: Mapping[str, float | None], setters: Mapping[str, str]
) -> CertificationLimits:
    """Return ``limits`` with those ``given`` by quantity, and their practice changed likewise.

    ``setters`` has the name of what set each, for its clause.
    """
    practice = limits.practice
    for quantity, limit in given.items():
        practice = practice.change(quantity, limit, setters[quantity])
    changes: dict[str, Any] = dict(given)
    return replace(limits, **changes, practice=practice)


def falls_below(value: float, limit: float | None) -> bool:
    """Return whether ``value`` is below ``limit``; nothing is below no limit, and NaN never is."""
    return limit is not None and value < limit
