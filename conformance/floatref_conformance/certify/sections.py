"""A test section: reference and runs cut to it, compared with each other, and judged."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isnan

import numpy as np

from floatref.errors import InputError
from floatref.files.sources import naming
from floatref.measures import iri
from floatref.values.profile import Profile
from floatref_conformance.certify.causes import causes
from floatref_conformance.certify.comparing import (
    Comparison,
    compare,
    correlate_pairs,
    with_others,
)
from floatref_conformance.certify.criteria import judge_section
from floatref_conformance.certify.cutting import section_of, within
from floatref_conformance.certify.fit import fit
from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.plan import SectionPlan
from floatref_conformance.certify.scales import agrees
from floatref_conformance.certify.worksheet import RunSheet, RunTrack, SectionSheet


@dataclass(frozen=True, eq=False)
class Run:
    """One run as it was read and placed on the reference's axis, not yet cut to the section.

    Attributes:
        name: told apart from the section's other runs by it.
        source: the path that was given.
        said: what had to be done to it, and warnings.
        profile: with the reference's wheel paths; None if it could not be used.
        error: why it could not; empty otherwise.
    """

    name: str
    source: str
    said: tuple[str, ...] = ()
    profile: Profile | None = None
    error: str = ""


def section_sheet(
    plan: SectionPlan, reference: Profile, runs: Sequence[Run], limits: CertificationLimits
) -> SectionSheet:
    """Return what was measured at a section, and what became of its criteria.

    ``reference`` is the whole one; runs come in the natural order of their names, whatever their
    order here. Raises InputError for a stretch that the reference does not hold, or a reference
    that is not measured all along it.
    """
    with naming(f"section {plan.name}: {plan.reference}"):
        truth = section_of(reference, plan.stretch_m)
        truth_iri = {t.name: iri(t.elevation, truth.interval_m) for t in truth.tracks}
    measured = [_measured(truth, run) for run in sorted(runs, key=_place)]
    measured = _copies_named(measured)
    pairs = correlate_pairs([m.run.profile for m in measured], list(truth_iri))
    others = {name: with_others(pairs[name]) for name in truth_iri}
    sheets = tuple(
        _sheet(truth, one, {name: float(others[name][k]) for name in truth_iri}, limits)
        for k, one in enumerate(measured)
    )
    return SectionSheet(
        name=plan.name,
        reference_source=str(plan.reference),
        start_m=truth.start_m,
        end_m=truth.start_m + truth.length_m,
        reference_iri=truth_iri,
        runs=sheets,
        pairs=pairs,
        criteria=judge_section(truth, sheets, pairs, limits),
        reference=truth,
    )


@dataclass(frozen=True, eq=False)
class _Measured:
    """A run cut to the section, and its comparison by wheel path; none if it has an error."""

    run: Run
    tracks: Mapping[str, Comparison]


def _place(run: Run) -> tuple[list[tuple[int, str]], str]:
    """Return what sorts run-2 ahead of run-10."""
    parts = re.split(r"(\d+)", run.name)
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts], run.source


def _measured(truth: Profile, run: Run) -> _Measured:
    """Return ``run`` cut to the section and compared; one that cannot be says why."""
    if run.profile is None:
        return _Measured(run, {})
    try:
        cut = within(run.profile, truth.start_m, truth.start_m + truth.length_m)
        tracks = compare(truth, cut)
    except InputError as error:
        return _Measured(replace(run, profile=None, error=str(error)), {})
    errors = [c.error for c in tracks.values() if c.error]
    if len(errors) == len(tracks):
        return _Measured(replace(run, profile=None, error="; ".join(errors)), {})
    return _Measured(replace(run, profile=cut, said=(*run.said, *errors)), tracks)


def _copies_named(measured: Iterable[_Measured]) -> list[_Measured]:
    """Return ``measured``; a run with an earlier one's very elevations says so."""
    seen: dict[bytes, str] = {}
    told = []
    for one in measured:
        print_ = _print(one.run.profile)
        if print_ and print_ in seen:
            said = f"has the same elevations as {seen[print_]}, bit for bit: is it a copy?"
            one = replace(one, run=replace(one.run, said=(*one.run.said, said)))
        elif print_:
            seen[print_] = one.run.name
        told.append(one)
    return told


def _print(profile: Profile | None) -> bytes:
    """Return what two profiles with the same elevations share; nothing for no profile."""
    if profile is None:
        return b""
    from hashlib import sha256

    digest = sha256()
    for track in profile.tracks:
        digest.update(np.ascontiguousarray(track.elevation).tobytes())
    return digest.digest()


def _sheet(
    truth: Profile, measured: _Measured, others: Mapping[str, float], limits: CertificationLimits
) -> RunSheet:
    """Return the sheet of one run."""
    run = measured.run
    tracks = tuple(
        _track(truth, run.profile, name, found, others[name], limits)
        for name, found in measured.tracks.items()
        if run.profile is not None
    )
    return RunSheet(run.name, run.source, run.said, tracks, run.error, run.profile)


def _track(
    truth: Profile,
    run: Profile,
    name: str,
    found: Comparison,
    others: float,
    limits: CertificationLimits,
) -> RunTrack:
    """Return one wheel path of one run, with the causes if it does not agree."""
    told = fit(truth, run, name)
    track = RunTrack(
        track=name,
        accuracy=found.accuracy,
        offset_m=found.offset_m,
        iri_m_per_km=found.iri_m_per_km,
        bias_percent=found.bias_percent,
        with_others=others,
        distance_percent=told.distance_percent,
        distance_sigma=told.distance_sigma,
        height_percent=told.height_percent,
        height_sigma=told.height_sigma,
        flagged_m=found.flagged_m,
        missing_m=found.missing_m,
    )
    if isnan(found.accuracy) or agrees(track, limits):
        return track
    return replace(track, causes=causes(truth, run, name, told, limits))
