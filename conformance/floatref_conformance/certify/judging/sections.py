"""A test section: reference and runs cut to it, compared with each other, and judged."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from math import isnan, nan

import numpy as np

from floatref.errors import InputError
from floatref.files.sources import name_errors
from floatref.measures import iri
from floatref.values.profile import Profile
from floatref_conformance.certify.fitting.fit import fit
from floatref_conformance.certify.judging.causes import causes
from floatref_conformance.certify.judging.comparing import (
    Comparison,
    compare,
    correlate_pairs,
    with_others,
)
from floatref_conformance.certify.judging.contents import RunSheet, RunTrack, SectionSheet
from floatref_conformance.certify.judging.criteria import judge_section
from floatref_conformance.certify.judging.lateral import Stretch, pair_runs
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.scales import agrees
from floatref_conformance.certify.plan.cutting import section_of, within
from floatref_conformance.certify.plan.plan_document import SectionPlan
from floatref_conformance.certify.plan.trails import Trail

LEAST_IRI = 0.01
"""IRI in m/km below which a reference is level or in other units; the best roads have 0.3."""


@dataclass(frozen=True, eq=False)
class Run:
    """One run as it was read and placed on the reference's axis, not yet cut to the section.

    Attributes:
        name: unique among the section's runs.
        source: the path that was given.
        notes: what had to be done to it, and warnings.
        profile: with the reference's wheel paths; None if it could not be used.
        error: why it could not; empty otherwise.
        trail: where it was, on the reference's axis; None if nobody knows.
    """

    name: str
    source: str
    notes: tuple[str, ...] = ()
    profile: Profile | None = None
    error: str = ""
    trail: Trail | None = None


def truth_of(plan: SectionPlan, reference: Profile) -> Profile:
    """Return ``reference`` within the section of ``plan``.

    Raises InputError for a stretch that it does not hold, one that it did not measure all along,
    and a wheel path that is too even for a road.
    """
    with name_errors(f"section {plan.name}: {plan.reference}"):
        truth = section_of(reference, plan.stretch_m)
        for name, value in _roughness(truth).items():
            if value < LEAST_IRI:
                raise InputError(
                    f"track {name} of the reference has an IRI of {value:.2g} m/km: no road is so "
                    "even, and no run agrees with it; check the file"
                )
    return truth


def section_sheet(
    plan: SectionPlan,
    truth: Profile,
    runs: Sequence[Run],
    limits: CertificationLimits,
    trail: Trail | None = None,
) -> SectionSheet:
    """Return what was measured at a section, and what became of its criteria.

    ``truth`` is that of `truth_of`; runs come in the natural order of their names, whatever their
    order here. ``trail`` is where the reference was.
    """
    truth_iri = _roughness(truth)
    measured = _without_copies(truth, [_measure(truth, run) for run in sorted(runs, key=_place)])
    pairs = correlate_pairs([m.run.profile for m in measured], list(truth_iri))
    others = {name: with_others(pairs[name]) for name in truth_iri}
    sheets = tuple(
        _sheet(truth, one, {name: float(others[name][k]) for name in truth_iri}, limits)
        for k, one in enumerate(measured)
    )
    stretch = Stretch(truth.start_m, truth.start_m + truth.length_m)
    trails = {run.name: run.trail for run in runs}
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
        lateral=pair_runs(stretch, sheets, pairs, trails, trail),
    )


@dataclass(frozen=True, eq=False)
class _Measured:
    """A run cut to the section, and its comparison by wheel path; empty if it has an error."""

    run: Run
    tracks: Mapping[str, Comparison]


def _roughness(truth: Profile) -> dict[str, float]:
    """Return the IRI of every wheel path in m/km."""
    return {track.name: iri(track.elevation, truth.interval_m) for track in truth.tracks}


def _place(run: Run) -> tuple[list[tuple[int, str]], str]:
    """Return what sorts run-2 ahead of run-10."""
    parts = re.split(r"(\d+)", run.name)
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts], run.source


def _measure(truth: Profile, run: Run) -> _Measured:
    """Return ``run`` cut to the section and compared; one that cannot be has an error."""
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
    return _Measured(replace(run, profile=cut, notes=(*run.notes, *errors)), tracks)


def _without_copies(truth: Profile, measured: Iterable[_Measured]) -> list[_Measured]:
    """Return ``measured``; one with the very elevations of another, or of ``truth``, is no run."""
    seen = {_digest(truth, truth): "the reference"}
    kept = []
    for one in measured:
        profile = one.run.profile
        digest = b"" if profile is None else _digest(truth, profile)
        if digest in seen:
            error = f"has the same elevations as {seen[digest]}, bit for bit: a copy is no run"
            one = _Measured(replace(one.run, profile=None, error=error), {})
        elif profile is not None:
            seen[digest] = one.run.name
        kept.append(one)
    return kept


def _digest(truth: Profile, profile: Profile) -> bytes:
    """Return what two profiles share that have the same elevations in the wheel paths of truth."""
    digest = sha256()
    for track in truth.tracks:
        digest.update(np.ascontiguousarray(profile.track(track.name).elevation).tobytes())
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
    return RunSheet(run.name, run.source, run.notes, tracks, run.error, run.profile)


def _track(
    truth: Profile,
    run: Profile,
    name: str,
    found: Comparison,
    others: float,
    limits: CertificationLimits,
) -> RunTrack:
    """Return one wheel path of one run, with the causes if it does not agree."""
    estimate = fit(truth, run, name)
    track = RunTrack(
        track=name,
        accuracy=found.accuracy,
        offset_m=found.offset_m,
        iri_m_per_km=found.iri_m_per_km,
        bias_percent=found.bias_percent,
        with_others=others,
        distance_percent=estimate.distance_percent,
        distance_sigma=estimate.distance_sigma,
        height_percent=estimate.height_percent,
        height_sigma=estimate.height_sigma,
        flagged_m=found.flagged_m,
        missing_m=found.missing_m,
        long_percent=nan if estimate.long_waves is None else estimate.long_waves.error_percent,
        long_sigma=nan if estimate.long_waves is None else estimate.long_waves.error_sigma,
        bias_sigma=found.bias_sigma,
    )
    if isnan(found.accuracy) or agrees(track, limits):
        return track
    return replace(track, causes=causes(truth, run, name, estimate, limits))
