"""Recorded stationary tests of AASHTO R 57-14: the IRI of a parked vehicle, wheel path by path.

The vehicle is stationary on a flat floor while an artificial encoder gives travel. R 57-14 limits
the IRI at rest to 0.047 m/km (3 in/mi) and with the body pushed to 0.126 m/km (8 in/mi). Which part
of the recording counts is ours: what is `END_M` from both ends, unless a stretch is given.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite, nan

import numpy as np

from floatref.errors import InputError
from floatref.measures import iri
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.contents import Criterion, Judged, StationarySheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.reasons import judge
from floatref_conformance.certify.plan.plan_document import StationaryPlan, Stretch
from floatref_conformance.checks.stretches import END_M, points

SHORTEST_M = 50.0
"""Least length that counts, ours: the IRI answers to waves of up to 30 m."""
TITLES = {
    "quiescent": "IRI of the parked vehicle at rest",
    "bounce": "IRI of the parked vehicle, its body pushed",
}


def stationary_sheet(
    id_: str,
    plan: StationaryPlan,
    profile: Profile | None,
    limits: CertificationLimits,
    notes: Sequence[str] = (),
    error: str = "",
) -> StationarySheet:
    """Return the sheet of test ``id_``, ``quiescent`` or ``bounce``.

    Without ``profile`` the test counts as missing, for the reason in ``error``; so does a profile
    that cannot be judged: too short, or with a point without elevation in what counts. Raises
    InputError for an invalid stretch.
    """
    if plan.stretch_m is not None:
        _check_stretch(id_, plan.stretch_m)
    if profile is None:
        return _missing(id_, plan, notes, limits, error or "no profile", None)
    try:
        start, end = _stretch(profile, plan.stretch_m)
        found = {track.name: _iri(profile, track.name, start, end) for track in profile.tracks}
    except InputError as refused:
        return _missing(id_, plan, notes, limits, str(refused), profile)
    criteria = tuple(_criterion(id_, value, limits, name) for name, value in found.items())
    text = (*notes, *_flags(profile, start, end))
    return StationarySheet(id_, str(plan.source), start, end, found, text, criteria, profile)


def _check_stretch(id_: str, stretch_m: Stretch) -> None:
    """Raise InputError unless ``stretch_m`` goes from a place to a later one."""
    start, end = stretch_m
    if not (isfinite(start) and isfinite(end) and start < end):
        raise InputError(f"{id_} {start:g}:{end:g}: give FROM:TO in m, the first below the second")


def _stretch(profile: Profile, given: Stretch | None) -> Stretch:
    """Return from and to, in m, of what counts; InputError if the profile does not hold it."""
    first, last = profile.start_m, profile.start_m + profile.length_m
    if profile.length_m < SHORTEST_M:
        raise InputError(
            f"the profile is {profile.length_m:.1f} m long, {SHORTEST_M:g} m are needed: a parked "
            "vehicle needs an encoder that gives travel, as an artificial one does"
        )
    start, end = given if given is not None else (first + END_M, last - END_M)
    if end - start < SHORTEST_M:
        raise InputError(
            f"{max(end - start, 0.0):.1f} m count, {SHORTEST_M:g} m are needed; "
            + (
                "give a longer stretch"
                if given is not None
                else f"the profile covers {first:g} to {last:g} m, of which {END_M:g} m are left "
                "out at both ends: record longer, or give the stretch that counts as @FROM:TO"
            )
        )
    margin = profile.interval_m
    if start < first - margin or end > last + margin:
        raise InputError(
            f"the stretch {start:g} to {end:g} m reaches beyond the profile, which covers "
            f"{first:g} to {last:g} m"
        )
    return start, end


def _iri(profile: Profile, name: str, start: float, end: float) -> float:
    """Return the IRI of a wheel path; InputError unless every point has an elevation."""
    elevation = profile.track(name).elevation[points(profile, start, end)]
    missing = int(np.isnan(elevation).sum())
    if missing:
        raise InputError(
            f"track {name}: {missing} of {elevation.size} points from {start:g} to {end:g} m have "
            "no elevation, and every point counts"
        )
    return iri(elevation, profile.interval_m)


def _flags(profile: Profile, start: float, end: float) -> list[str]:
    """Return one line per wheel path that flags points of the stretch that counts."""
    text = []
    for track in profile.tracks:
        doubted = np.count_nonzero(~track.valid[points(profile, start, end)])
        if doubted:
            length = profile.interval_m * float(doubted)
            text.append(f"track {track.name} flags {length:.1f} m of what counts as not valid")
    return text


def _missing(
    id_: str,
    plan: StationaryPlan,
    notes: Sequence[str],
    limits: CertificationLimits,
    reason: str,
    profile: Profile | None,
) -> StationarySheet:
    """Return the sheet of a test that was not judged."""
    start, end = plan.stretch_m or (nan, nan)
    criterion = replace(_criterion(id_, nan, limits, ""), judged=Judged.MISSING, reason=reason)
    return StationarySheet(
        id_, str(plan.source), start, end, {}, tuple(notes), (criterion,), profile
    )


def _criterion(id_: str, value: float, limits: CertificationLimits, track: str) -> Criterion:
    quantity = f"{id_}_m_per_km"
    limit, clause = limits.figures()[quantity], limits.clause(quantity)
    judged = judge(value, limit, limit is not None and value > limit)
    return Criterion(id_, TITLES[id_], clause, value, limit, "m/km", False, judged, track)
