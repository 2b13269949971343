"""The worst numbers of a worksheet, measured again by the reference implementation.

At every section these are the lowest accuracy and the IRI that is farthest off; at a stationary
test, the highest IRI. The reference works in plain loops, 18 µs a point: it takes 2 s for a
section of 0.1 mile at 5 mm. Of more than `MOST_POINTS` points the SDK and the reference both
measure the first ones only: that still finds a wrong measure, and costs 2 s.
"""

from math import isnan

import numpy as np

from floatref.measures import agreement, iri, on_common_grid
from floatref.measures.locating.placing import MAX_OFFSET_M
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.contents import (
    RunTrack,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.checks.evidence import CorrelationLoss, Evidence, Pair, Roughness
from floatref_conformance.checks.stretches import points
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.judge.oracle import confirm

MOST_POINTS = 40_000
"""Points that the reference is given: 200 m at 5 mm."""


def confirm_worksheet(worksheet: Worksheet) -> None:
    """Raise SuiteError unless the reference gives the worst numbers of ``worksheet`` too."""
    for section in worksheet.sections:
        _confirm_section(section)
    for stationary in worksheet.stationary:
        _confirm_stationary(stationary)


def _confirm_section(sheet: SectionSheet) -> None:
    """Measure the lowest accuracy and the IRI that is farthest off again."""
    where = f"certify, section {sheet.name}"
    measured = [
        (run.name, run.profile, track)
        for run in sheet.runs
        if run.profile is not None
        for track in run.tracks
    ]
    agreed = [one for one in measured if not isnan(one[2].accuracy)]
    if agreed:
        name, profile, track = min(agreed, key=lambda one: one[2].accuracy)
        pair = _common(sheet.reference, profile, track)
        confirm(f"{where}, run {name}", _accuracy(pair, track.accuracy, track.track))
    rough = [one for one in measured if not isnan(one[2].bias_percent)]
    if rough:
        name, profile, track = max(rough, key=lambda one: abs(one[2].bias_percent))
        elevation = _common(sheet.reference, profile, track).result
        found = _iri(elevation, sheet.reference.interval_m, track.iri_m_per_km, track.track)
        confirm(f"{where}, run {name}", found)


def _confirm_stationary(sheet: StationarySheet) -> None:
    """Measure the highest IRI again."""
    if sheet.profile is None or not sheet.iri_m_per_km:
        return
    track, value = max(sheet.iri_m_per_km.items(), key=lambda item: item[1])
    part = points(sheet.profile, sheet.start_m, sheet.end_m)
    elevation = sheet.profile.track(track).elevation[part]
    confirm(f"certify, {sheet.id}", _iri(elevation, sheet.profile.interval_m, value, track))


def _accuracy(pair: Pair, value: float, track: str) -> Measurement:
    """Return the loss of correlation: of all points ``value``, or else of the first ones."""
    pair, shortened = _first(pair)
    found = agreement(pair.truth, pair.result, pair.interval_m, "iri", MAX_OFFSET_M)
    score = found.cross_correlation if shortened else value
    lag = round(found.offset_m / pair.interval_m)
    return _measurement("loss of accuracy", track, 1.0 - score, "", CorrelationLoss(pair, lag))


def _iri(elevation: FloatArray, interval_m: float, value: float, track: str) -> Measurement:
    """Return the IRI: of all points ``value``, or else of the first ones."""
    first = elevation[:MOST_POINTS]
    found = iri(first, interval_m) if first.size < elevation.size else value
    return _measurement("IRI", track, found, "m/km", Roughness(first, interval_m))


def _measurement(
    quantity: str, track: str, value: float, unit: str, evidence: Evidence
) -> Measurement:
    return Measurement(quantity, track, value, unit, {}, evidence)


def _first(pair: Pair) -> tuple[Pair, bool]:
    """Return as many points of ``pair`` as the reference is given, and whether there were more."""
    if pair.truth.size <= MOST_POINTS:
        return pair, False
    truth, result = pair.truth[:MOST_POINTS], pair.result[:MOST_POINTS]
    return Pair(truth, result, pair.interval_m, pair.counted[: MOST_POINTS - 1]), True


def _common(reference: Profile, run: Profile, track: RunTrack) -> Pair:
    """Return what both measured of a wheel path, on the reference's points, without gaps."""
    expected, found = on_common_grid(reference, run)
    p, q = (profile.track(track.track).elevation for profile in (expected, found))
    both = np.flatnonzero(np.isfinite(p) & np.isfinite(q))
    part = slice(int(both[0]), int(both[-1]) + 1)
    truth, result = _bridge_gaps(p[part]), _bridge_gaps(q[part])
    return Pair(truth, result, expected.interval_m, np.ones(truth.size - 1, dtype=np.bool_))


def _bridge_gaps(elevation: FloatArray) -> FloatArray:
    """Return ``elevation`` with straight lines over its gaps, as the measures take it."""
    measured = np.isfinite(elevation)
    places = np.arange(elevation.size)
    return np.interp(places, places[measured], elevation[measured])
