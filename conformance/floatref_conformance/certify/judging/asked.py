"""What a practice asks beside agreement: the interval of points, the spread of IRI, and the rest.

What a worksheet does not measure, or whose limit could not be had, is a line without a verdict.
"""

from collections.abc import Iterator, Sequence
from math import nan

import numpy as np

from floatref_conformance.certify.judging.contents import Criterion, RunSheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.reasons import (
    join_reasons,
    judge,
    list_in_words,
    of_track,
    report_value,
)
from floatref_conformance.certify.practice.requirements import JUDGED, UNITS

SPREAD = "iri_spread_m_per_km"
TITLES = {
    "cutoff_wave_m": "cut-off wavelength of the profiler's filter",
    "elevation_precision_mm": "standard deviation of elevations of repeated runs",
    "elevation_bias_mm": "difference of elevations from the reference",
    "vertical_resolution_mm": "vertical resolution",
}
"""Quantities that a worksheet does not measure."""
ROUNDING = 1.0 + 1e-9
"""3 in and 76.2 mm are one interval."""


def judge_asked(
    runs: Sequence[RunSheet], names: Sequence[str], limits: CertificationLimits
) -> Iterator[Criterion]:
    """Yield what the practice asks of the ``runs`` of a section with wheel paths ``names``."""
    if limits.interval_m is not None or limits.practice.find("interval_m") is not None:
        yield _interval(runs, limits)
    if limits.practice.find(SPREAD) is not None:
        yield from (_spread(runs, name, limits) for name in names)


def report_open(limits: CertificationLimits) -> tuple[Criterion, ...]:
    """Return a line without a verdict for what the practice asks and a worksheet cannot measure."""
    return tuple(
        report_value(
            one.quantity.rpartition("_")[0].replace("_", "-"),
            TITLES[one.quantity],
            one.clause,
            nan,
            UNITS[one.quantity],
            "",
            join_reasons("not measured by a worksheet", one.limit_in_words(), one.missing),
        )
        for one in limits.practice.requirements
        if one.quantity in TITLES
    )


def list_open(limits: CertificationLimits) -> tuple[str, ...]:
    """Return one line for each limit that is asked for, measured, and cannot be judged."""
    return tuple(
        f"{one.quantity}: {join_reasons(one.limit_in_words(), one.missing)}"
        for one in limits.practice.open_requirements()
        if one.quantity in (*JUDGED, SPREAD)
    )


def _interval(runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return the largest interval of a run; in m."""
    found = [(run.profile.interval_m, run.name) for run in runs if run.profile is not None]
    value, limit = max((interval for interval, _ in found), default=nan), limits.interval_m
    above = [] if limit is None else [one for one in found if one[0] > limit * ROUNDING]
    return Criterion(
        "interval",
        "interval between the points of a run, the largest",
        limits.clause("interval_m"),
        value,
        limit,
        "m",
        False,
        judge(value, limit, bool(above)),
        "",
        list_in_words([f"{name}: {interval:.6g} m" for interval, name in above]),
    )


def _spread(runs: Sequence[RunSheet], name: str, limits: CertificationLimits) -> Criterion:
    """Return the standard deviation of the runs' IRI in m/km, n - 1 in its denominator."""
    found = [track.iri_m_per_km for _, track in of_track(runs, name)]
    known = [value for value in found if value == value]
    value = float(np.std(known, ddof=1)) if len(known) > 1 else nan
    title, clause = "standard deviation of the IRI of the runs", limits.clause(SPREAD)
    return report_value("iri-spread", title, clause, value, "m/km", name)
