"""A certification from its plan to its worksheet: read, place, compare, judge."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from floatref.errors import InputError
from floatref.files.sources import real_path
from floatref.measures.locating.placing import MAX_OFFSET_M, apply_placement, place
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.asked import report_open
from floatref_conformance.certify.judging.contents import (
    Criterion,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.certify.judging.criteria import verdict_of
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.scales import judge_readings
from floatref_conformance.certify.judging.second_opinion import confirm_worksheet
from floatref_conformance.certify.judging.sections import Run, section_sheet, truth_of
from floatref_conformance.certify.judging.stationary import stationary_sheet
from floatref_conformance.certify.plan.converting import PROCESSED, Converted, convert_all
from floatref_conformance.certify.plan.plan_document import (
    Plan,
    Processing,
    SectionPlan,
    StationaryPlan,
)
from floatref_conformance.certify.plan.run_paths import names_of
from floatref_conformance.certify.plan.trails import place_trail
from floatref_conformance.classes import DeviceClass
from floatref_conformance.editions import EDITION

MEASURED_BY = ("floatref", "numpy", "scipy", "numba")
"""Distributions on whose versions the numbers depend."""

NO_TRUTH = (
    "is another run, no truth: accuracy is the agreement of two runs, and an error of distance, "
    "height or IRI may be of either; the estimates treat both alike"
)
"""What a worksheet says of a reference that is a recording, or is stated to be a run."""

Progress = Callable[[str, float], None]
"""Called with what is being done and the part of all that is done, from 0 to 1."""


def certify(
    plan: Plan,
    processing: Processing,
    limits: CertificationLimits,
    device_class: DeviceClass,
    progress: Progress = lambda doing, done: None,
) -> Worksheet:
    """Return the worksheet of ``plan``.

    A run that cannot be used is an error of that run alone. Raises InputError for a reference
    that cannot be used, a run that is the reference itself, and where no run can be used at all;
    SuiteError where the reference implementation does not give the worst numbers too.
    """
    for section in plan.sections:
        _check_apart(section)
    steps = _Steps(plan, progress)
    read = convert_all(_references(plan), processing, steps.count_read)
    _check_true(read)
    sources = convert_all(_sources(plan), processing, steps.count_read)
    _check_usable(plan, sources)
    sections = tuple(
        replace(
            _section(section, read[section.reference], sources, limits, steps),
            reference_notes=(*read[section.reference].notes, *_no_truth(read, section, processing)),
        )
        for section in plan.sections
    )
    stationary = tuple(
        _stationary(name, test, sources[test.source], limits) for name, test in _tests(plan)
    )
    readings = () if plan.distance is None else judge_readings(plan.distance, limits)
    criteria = (*readings, *report_open(limits))
    worksheet = Worksheet(
        plan.profiler,
        device_class,
        limits,
        verdict_of(
            _all_criteria(sections, stationary, criteria),
            bool(limits.practice.open_requirements()),
        ),
        sections,
        stationary,
        criteria,
        settings=_settings(processing),
        versions=dict(_versions()),
    )
    confirm_worksheet(worksheet)
    return worksheet


class _Steps:
    """Counts what is done of a plan: every source that is read, and every run that is placed."""

    def __init__(self, plan: Plan, progress: Progress) -> None:
        placed_runs = sum(len(section.runs) for section in plan.sections)
        self._total = len(_references(plan)) + len(_sources(plan)) + placed_runs
        self._done = 0
        self._progress = progress
        progress("reading", 0.0)

    def count_read(self, path: Path) -> None:
        """Report that ``path`` was read."""
        self._report(f"read {path.name}")

    def count_placed(self, name: str) -> None:
        """Report that the run ``name`` was found on its section."""
        self._report(f"placed {name}")

    def _report(self, doing: str) -> None:
        self._done += 1
        self._progress(doing, self._done / self._total)


def _section(
    plan: SectionPlan,
    reference: Converted,
    sources: Mapping[Path, Converted],
    limits: CertificationLimits,
    steps: _Steps,
) -> SectionSheet:
    """Return the sheet of a section, its runs placed on the reference's axis."""
    assert reference.profile is not None
    truth, runs = truth_of(plan, reference.profile), []
    for name, path in zip(names_of(plan.runs), plan.runs, strict=True):
        runs.append(_run(name, path, sources[path], truth))
        steps.count_placed(name)
    return section_sheet(plan, truth, runs, limits, reference.trail)


def _run(name: str, path: Path, source: Converted, truth: Profile) -> Run:
    if source.profile is None:
        return Run(name, str(path), source.notes, None, source.error)
    try:
        placement = place(truth, source.profile)
        profile = apply_placement(source.profile, placement)
    except InputError as error:
        return Run(name, str(path), source.notes, None, f"{path}: {error}")
    notes, trail = (*source.notes, *placement.notes), source.trail
    placed = trail and place_trail(trail, source.profile, placement)
    return Run(name, str(path), notes, profile, trail=placed)


def _no_truth(
    read: Mapping[Path, Converted], section: SectionPlan, processing: Processing
) -> tuple[str, ...]:
    """Return the line on a reference that is another run, and so is no truth; else nothing."""
    recorded = any(line.startswith(PROCESSED) for line in read[section.reference].notes)
    return (NO_TRUTH,) if recorded or processing.reference_is_run else ()


def _stationary(
    name: str, plan: StationaryPlan, source: Converted, limits: CertificationLimits
) -> StationarySheet:
    return stationary_sheet(name, plan, source.profile, limits, source.notes, source.error)


def _check_apart(section: SectionPlan) -> None:
    """Raise InputError for a run that is the reference: it would agree with it, of course."""
    for run in section.runs:
        if real_path(run) == real_path(section.reference):
            raise InputError(f"{run}: is the reference itself; leave it out of the runs")


def _check_true(references: Mapping[Path, Converted]) -> None:
    """Raise InputError for a reference that cannot be used."""
    for source in references.values():
        if source.profile is None:
            raise InputError(f"reference {source.error}")


def _check_usable(plan: Plan, sources: Mapping[Path, Converted]) -> None:
    """Raise InputError with the first reason if no run of any section can be read."""
    runs = [sources[run] for section in plan.sections for run in section.runs]
    if all(run.profile is None for run in runs):
        what = f"not one of the {len(runs)} runs" if len(runs) > 1 else "the only run"
        verb = "can be used, first" if len(runs) > 1 else "cannot be used:"
        raise InputError(f"{what} {verb} {runs[0].error}")


def _references(plan: Plan) -> Sequence[Path]:
    return tuple(dict.fromkeys(section.reference for section in plan.sections))


def _sources(plan: Plan) -> Sequence[Path]:
    """Return every run and every recorded test, each once."""
    runs = [run for section in plan.sections for run in section.runs]
    return tuple(dict.fromkeys([*runs, *(test.source for _, test in _tests(plan))]))


def _tests(plan: Plan) -> Iterator[tuple[str, StationaryPlan]]:
    for name, test in (("quiescent", plan.quiescent), ("bounce", plan.bounce)):
        if test is not None:
            yield name, test


def _all_criteria(
    sections: Sequence[SectionSheet],
    stationary: Sequence[StationarySheet],
    criteria: Sequence[Criterion],
) -> Iterator[Criterion]:
    yield from criteria
    for section in sections:
        yield from section.criteria
    for test in stationary:
        yield from test.criteria


def _settings(processing: Processing) -> dict[str, object]:
    """Return how the numbers were made, beside the limits."""
    given = {name: str(value) for name, value in asdict(processing).items() if value}
    return {"filter": "iri", "max_offset_m": MAX_OFFSET_M, **given}


def _versions() -> Iterator[tuple[str, str]]:
    yield "edition", EDITION
    for name in MEASURED_BY:
        try:
            yield name, version(name)
        except PackageNotFoundError:
            yield name, "not installed"
