"""The worksheet: what was measured at every section, against which limit, and why it failed."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import nan

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass


class Judged(StrEnum):
    """What became of a criterion; ``MISSING`` makes the verdict INCOMPLETE."""

    PASS = "pass"
    FAIL = "fail"
    REPORTED = "reported"
    MISSING = "missing"


@dataclass(frozen=True)
class Criterion:
    """One line of the worksheet.

    Attributes:
        id: such as ``repeatability``.
        title: in words.
        clause: where it comes from.
        value: as measured; NaN if it could not be.
        limit: None if it is reported only.
        unit: "" for a correlation.
        at_least: whether the value has to reach the limit, or its magnitude to stay within it.
        judged: the outcome.
        track: the wheel path; empty: of all.
        reason: in one line why it failed or is missing, or what is to be known though it passed.
    """

    id: str
    title: str
    clause: str
    value: float
    limit: float | None
    unit: str
    at_least: bool
    judged: Judged
    track: str = ""
    reason: str = ""


@dataclass(frozen=True)
class Cause:
    """Why a run does not agree, such as ``distance`` or ``height-scale``, and by how much.

    ``explains`` is the part of the correlation that is lost, from 0 to 1, which comes back once
    the cause is undone; NaN if that was not tried.
    """

    id: str
    text: str
    explains: float


@dataclass(frozen=True)
class RunTrack:
    """One wheel path of one run at one section.

    Attributes:
        track: as the reference calls it.
        accuracy: cross correlation with the reference, as `floatref compare` gives it.
        offset_m: at which that was found.
        iri_m_per_km: of the run, on the reference's points.
        bias_percent: of that against the reference's IRI.
        with_others: average cross correlation with the other runs; NaN without other runs.
        distance_percent, distance_sigma: how much longer the run takes the section, and 1-sigma.
        height_percent, height_sigma: how much higher it takes the road, and 1-sigma.
        flagged_m: length of its points within the section that are not valid, or missing.
        long_percent, long_sigma: how far waves of 4 to 25 m are off in height and place, in the
            band that is farthest off, and 1-sigma.
        bias_sigma: 1-sigma of bias_percent; 0 if it was not estimated.
        causes: why it does not agree; empty if it does.
        missing_m: length within the section for which it has no elevation; a part of flagged_m.
    """

    track: str
    accuracy: float
    offset_m: float
    iri_m_per_km: float
    bias_percent: float
    with_others: float
    distance_percent: float
    distance_sigma: float
    height_percent: float
    height_sigma: float
    flagged_m: float
    causes: tuple[Cause, ...] = ()
    missing_m: float = 0.0
    long_percent: float = nan
    long_sigma: float = nan
    bias_sigma: float = 0.0


@dataclass(frozen=True, eq=False)
class RunSheet:
    """One run at one section.

    Attributes:
        name: unique among the section's runs.
        source: the path that was given.
        notes: what had to be done to the run before it could be compared, and warnings.
        tracks: empty if the run could not be used.
        error: why it could not; empty otherwise.
        profile: within the section, on the reference's axis; None after an error.
    """

    name: str
    source: str
    notes: tuple[str, ...]
    tracks: tuple[RunTrack, ...]
    error: str = ""
    profile: Profile | None = None


@dataclass(frozen=True)
class LateralPair:
    """Two runs, or the reference and a run, in one wheel path.

    Attributes:
        first, second: the names of the runs; ``first`` may be ``reference``.
        separation_m: mean distance between the lines that were driven, to the side.
        left_m: by how far the second lies left of the first, on average.
        agreement: cross correlation.
        iri_percent: by how much the IRI of the second is larger.
    """

    first: str
    second: str
    track: str
    separation_m: float
    left_m: float
    agreement: float
    iri_percent: float


@dataclass(frozen=True, eq=False)
class SectionSheet:
    """One test section.

    Attributes:
        start_m, end_m: on the reference's axis.
        reference_iri: in m/km, by wheel path.
        pairs: by wheel path, the cross correlation of run j with run i in row i and column j > i,
            shape (runs, runs) in the order of ``runs``; NaN elsewhere.
        reference: within the section.
        reference_notes: how the reference was made, and warnings.
        lateral: agreement by lateral separation; empty unless all runs have positions.
    """

    name: str
    reference_source: str
    start_m: float
    end_m: float
    reference_iri: Mapping[str, float]
    runs: tuple[RunSheet, ...]
    pairs: Mapping[str, FloatArray]
    criteria: tuple[Criterion, ...]
    reference: Profile
    reference_notes: tuple[str, ...] = ()
    lateral: tuple[LateralPair, ...] = ()


@dataclass(frozen=True, eq=False)
class StationarySheet:
    """One stationary test: ``quiescent`` or ``bounce``."""

    id: str
    source: str
    start_m: float
    end_m: float
    iri_m_per_km: Mapping[str, float]
    notes: tuple[str, ...]
    criteria: tuple[Criterion, ...]
    profile: Profile | None = None


@dataclass(frozen=True, eq=False)
class Worksheet:
    """All of a certification; ``criteria`` are those that belong to no section."""

    profiler: str
    device_class: DeviceClass
    limits: CertificationLimits
    verdict: Verdict
    sections: tuple[SectionSheet, ...]
    stationary: tuple[StationarySheet, ...] = ()
    criteria: tuple[Criterion, ...] = ()
    settings: Mapping[str, object] = field(default_factory=dict)
    versions: Mapping[str, str] = field(default_factory=dict)
