"""A certification in words and marks, the same in the terminal and on the page."""

from collections.abc import Mapping, Sequence
from math import isnan

from floatref_conformance.certify.judging.asked import list_open
from floatref_conformance.certify.judging.contents import (
    Cause,
    Criterion,
    Judged,
    RunSheet,
    RunTrack,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.certify.judging.limits import CertificationLimits, falls_below
from floatref_conformance.certify.judging.scales import scales_agree

NOTHING = "–"
"""Text in place of a missing number."""
COUNTED = "runs"
"""The id of the criterion that is a number of runs."""
SIGNED = (
    *("distance", "distance-mean", "distance-readings", "distance-readings-mean"),
    *("height-scale", "iri-bias"),
)
"""The ids of criteria whose value has a sign, and whose limit is that of its magnitude."""


def criteria_of(worksheet: Worksheet) -> tuple[tuple[str, Criterion], ...]:
    """Return every criterion behind the name of what it was judged on; empty: of all."""
    return (
        *((sheet.name, one) for sheet in worksheet.sections for one in sheet.criteria),
        *((sheet.id, one) for sheet in worksheet.stationary for one in sheet.criteria),
        *(("", one) for one in worksheet.criteria),
    )


def verdict_line(worksheet: Worksheet) -> str:
    """Return the verdict in one line."""
    profiler = worksheet.profiler or "profiler without a name"
    return f"{worksheet.verdict}: {profiler}: {summary(worksheet)} (class {worksheet.device_class})"


def summary(worksheet: Worksheet) -> str:
    """Return how many criteria are met; what is missing is never called met."""
    judged = [one.judged for _, one in criteria_of(worksheet)]
    passed, failed, missing = (
        judged.count(kind) for kind in (Judged.PASS, Judged.FAIL, Judged.MISSING)
    )
    parts = [f"{passed} of {passed + failed} criteria that were judged are met"]
    if not passed + failed:
        parts = ["nothing was judged"]
    if missing:
        parts.append(f"{missing} could not be judged")
    return "; ".join(parts)


def value_in_words(criterion: Criterion) -> str:
    """Return what was measured, with its unit."""
    value = criterion.value
    if isnan(value):
        return NOTHING
    if criterion.id == COUNTED:
        return f"{value:.0f}"
    text = (
        with_sign(value, 3) if criterion.id in SIGNED else number(value, 3 if criterion.unit else 4)
    )
    return f"{text} {criterion.unit}".strip()


def title_of(criterion: Criterion) -> str:
    """Return the title as a line begins with it."""
    return criterion.title[:1].upper() + criterion.title[1:]


def clauses_of(worksheet: Worksheet) -> tuple[tuple[str, str], ...]:
    """Return every kind of criterion once, and where it comes from."""
    return tuple({one.id: one.clause for _, one in criteria_of(worksheet)}.items())


def limit_in_words(criterion: Criterion) -> str:
    """Return the limit of the value with its sign; "no limit" without one."""
    if criterion.limit is None:
        return "no limit"
    sign = "±" if criterion.id in SIGNED else "≥" if criterion.at_least else "≤"
    return f"{sign} {criterion.limit:.6g} {criterion.unit}".strip()


def number(value: float, digits: int) -> str:
    """Return ``value`` with ``digits`` decimals."""
    return NOTHING if isnan(value) else f"{value:.{digits}f}"


def with_sign(value: float, digits: int) -> str:
    """Return ``value`` with its sign and ``digits`` decimals."""
    return NOTHING if isnan(value) else f"{value:+.{digits}f}".replace("-", "−")


def correlation(value: float) -> str:
    """Return a correlation with three decimals, without the zero before the point."""
    return NOTHING if isnan(value) else f"{value:.3f}".replace("0.", ".", 1).replace("-", "−")


def with_error(value: float, sigma: float, digits: int) -> str:
    """Return ``value`` with twice its standard deviation, both in per cent."""
    if isnan(value) or isnan(sigma):
        return with_sign(value, digits)
    return f"{with_sign(value, digits)} ± {2 * sigma:.{digits}f}"


def figures(track: RunTrack) -> tuple[str, ...]:
    """Return the numbers of a run's wheel path, in the order of `FIGURES`."""
    return (
        number(track.accuracy, 4),
        number(track.with_others, 4),
        number(track.iri_m_per_km, 3),
        with_sign(track.bias_percent, 2),
        with_error(track.distance_percent, track.distance_sigma, 3),
        with_error(track.height_percent, track.height_sigma, 2),
        number(track.flagged_m, 1),
    )


FIGURES = (
    "accuracy",
    "with others",
    "IRI, m/km",
    "bias, %",
    "distance, % ± 2σ",
    "height, % ± 2σ",
    "flagged, m",
)


def cause_in_words(cause: Cause) -> str:
    """Return a cause, and its share of the loss of correlation."""
    if isnan(cause.explains):
        return cause.text
    return f"{cause.text}; explains {100 * cause.explains:.0f} % of what the correlation lacks"


def run_lines(run: RunSheet) -> tuple[str, ...]:
    """Return the lines about a run: its fault, what was done to it, why it does not agree."""
    fault = (f"not used: {run.error}",) if run.error else ()
    causes = tuple(
        f"{track.track}: {cause_in_words(cause)}" for track in run.tracks for cause in track.causes
    )
    return (*fault, *run.notes, *causes)


def tracks_of(section: SectionSheet) -> tuple[str, ...]:
    """Return the wheel paths of ``section``, as its reference has them."""
    return tuple(section.reference_iri)


def where(section: SectionSheet) -> str:
    """Return what ``section`` is cut from, and how rough that is."""
    iri = ", ".join(f"{name} {value:.3f} m/km" for name, value in section.reference_iri.items())
    return f"{stretch(section)} of {section.reference_source}; IRI {iri}"


def reference_lines(section: SectionSheet) -> tuple[str, ...]:
    """Return the lines about the reference of ``section``."""
    return tuple(f"the reference: {line}" for line in section.reference_notes)


def what_counts(sheet: StationarySheet) -> str:
    """Return what the numbers of a stationary test are of."""
    return sheet.source if isnan(sheet.start_m) else f"{stretch(sheet)} of {sheet.source}"


def stretch(sheet: SectionSheet | StationarySheet) -> str:
    """Return from where to where ``sheet`` reaches."""
    ends = (f"{round(end, 2):.10g} m" for end in (sheet.start_m, sheet.end_m))
    return " to ".join(ends)


def limits_in_words(limits: CertificationLimits) -> tuple[tuple[str, str], ...]:
    """Return every limit of the worksheet behind its name; the interval only if there is one."""
    interval = () if limits.interval_m is None else (limits.interval_m,)
    return (
        ("Runs at each section", _at_least(limits.runs)),
        ("Repeatability", _at_least(limits.repeatability)),
        ("Accuracy", _at_least(limits.accuracy)),
        ("Distance error", _at_most(limits.distance_percent, "%")),
        ("Height scale error", _at_most(limits.height_percent, "%")),
        ("IRI bias", _at_most(limits.iri_bias_percent, "%")),
        ("Long wave error", _at_most(limits.long_wave_percent, "%")),
        ("Quiescent IRI", _at_most(limits.quiescent_m_per_km, "m/km")),
        ("Bounce IRI", _at_most(limits.bounce_m_per_km, "m/km")),
        *(("Interval of points", _at_most(limits.interval_m, "m")) for _ in interval),
    )


def practice_in_words(limits: CertificationLimits) -> tuple[tuple[str, str], ...]:
    """Return which practice the limits are of, its digest, and what is changed or not judged."""
    practice = limits.practice
    named = f"{practice.name}: {practice.title}; {practice.version}"
    not_judged = (("Not judged", line) for line in list_open(limits))
    status = (("Status of the practice", practice.status),) if practice.status else ()
    digest = ("SHA-256 of the practice", practice.sha256)
    changed = (("Changed", f"{one}: {limits.clause(one)}") for one in practice.changed)
    return (("Practice", named), *status, digest, *changed, *not_judged)


def _at_least(limit: float | None) -> str:
    return "reported only" if limit is None else f"≥ {limit:g}"


def _at_most(limit: float | None, unit: str) -> str:
    return "reported only" if limit is None else f"≤ {limit:g} {unit}"


def list_pairs(values: Mapping[str, object]) -> tuple[tuple[str, str], ...]:
    """Return settings or versions as pairs of words; those not set are left out."""
    return tuple((name, _plain(value)) for name, value in values.items() if value is not None)


def _plain(value: object) -> str:
    if isinstance(value, Mapping):
        return ", ".join(f"{name} {_plain(item)}" for name, item in value.items())
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(map(_plain, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


DISAGREES, NOT_USED = "does not agree", "not used"
"""What marks a run."""


def is_bad(run: RunSheet, limits: CertificationLimits, track: str | None = None) -> bool:
    """Return whether a wheel path of ``run``, or any of them, does not agree."""
    judged = [one for one in run.tracks if track in (None, one.track)]
    return not judged or any(_disagrees(one, limits) for one in judged)


def _disagrees(track: RunTrack, limits: CertificationLimits) -> bool:
    """Return whether there is a cause, a low correlation, or a scale that is surely wrong."""
    low = isnan(track.accuracy) or falls_below(track.accuracy, limits.accuracy)
    return bool(track.causes) or low or not scales_agree(track, limits)


def mark(run: RunSheet, limits: CertificationLimits, track: str) -> str:
    """Return what marks a wheel path of ``run`` out of the others; nothing if it agrees."""
    if not any(one.track == track for one in run.tracks):
        return NOT_USED
    return DISAGREES if is_bad(run, limits, track) else ""
