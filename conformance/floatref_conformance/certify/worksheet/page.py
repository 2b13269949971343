"""`worksheet.html`: one file that needs nothing else, to be read, signed and filed."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from floatref.files.atomic import replace_file
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.contents import (
    Criterion,
    Judged,
    RunSheet,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.worksheet import lateral_parts, wording
from floatref_conformance.certify.worksheet.figures import of_section, of_test
from floatref_conformance.render.failures import Picture
from floatref_conformance.render.text import fill_template, needs_jinja

Pairs = tuple[tuple[str, str], ...]
SIGNED_BY = ("Operator of the profiler", "Certified by", "Agency")


@dataclass(frozen=True)
class CriterionRow:
    """One criterion; ``of`` is what it was judged on."""

    of: str
    title: str
    track: str
    value: str
    limit: str
    outcome: str
    reason: str


@dataclass(frozen=True)
class RunRow:
    """The numbers of a run's wheel path; ``mark`` where it does not agree or was not used."""

    number: int
    name: str
    mark: str
    figures: tuple[str, ...]


@dataclass(frozen=True)
class RunNote:
    """Notes on a run; ``fault`` if it could not be used."""

    number: int
    name: str
    source: str
    fault: str
    lines: tuple[str, ...]


@dataclass(frozen=True)
class TrackPart:
    """One wheel path of a section."""

    name: str
    rows: tuple[RunRow, ...]


@dataclass(frozen=True)
class SectionPart:
    """One test section, or one stationary test, which has no ``reference`` and no ``tracks``."""

    anchor: str
    title: str
    where: str
    reference: tuple[str, ...]
    criteria: tuple[CriterionRow, ...]
    tracks: tuple[TrackPart, ...]
    notes: tuple[RunNote, ...]
    pictures: tuple[Picture, ...]
    lateral: tuple[tuple[str, ...], ...] = ()


@dataclass(frozen=True)
class Page:
    """All that the template needs."""

    verdict: str
    device: str
    summary: str
    facts: Pairs
    criteria: tuple[CriterionRow, ...]
    sections: tuple[SectionPart, ...]
    tests: tuple[SectionPart, ...]
    heads: tuple[str, ...]
    lateral_heads: tuple[str, ...]
    title: str
    practice: Pairs
    limits: Pairs
    clauses: Pairs
    settings: Pairs
    versions: Pairs
    inputs: Pairs
    signed_by: tuple[str, ...]


def page_of(worksheet: Worksheet) -> Page:
    """Return the page of ``worksheet``."""
    return Page(
        verdict=worksheet.verdict.value,
        device=worksheet.profiler or "profiler without a name",
        summary=wording.summary(worksheet),
        facts=_facts(worksheet),
        criteria=tuple(
            _criterion(of, one)
            for of, one in wording.criteria_of(worksheet)
            if one.judged is not Judged.REPORTED or not of
        ),
        sections=tuple(
            _section(sheet, worksheet.limits, f"section-{n}")
            for n, sheet in enumerate(worksheet.sections, start=1)
        ),
        tests=tuple(_test(s, f"test-{n}") for n, s in enumerate(worksheet.stationary, start=1)),
        heads=wording.FIGURES,
        lateral_heads=lateral_parts.HEADS,
        title=worksheet.limits.practice.title,
        practice=wording.practice_in_words(worksheet.limits),
        limits=wording.limits_in_words(worksheet.limits),
        clauses=wording.clauses_of(worksheet),
        settings=wording.list_pairs(worksheet.settings),
        versions=wording.list_pairs(worksheet.versions),
        inputs=tuple(_inputs(worksheet)),
        signed_by=SIGNED_BY,
    )


def _facts(worksheet: Worksheet) -> Pairs:
    runs = [run for section in worksheet.sections for run in section.runs]
    length = sum(section.end_m - section.start_m for section in worksheet.sections)
    tests = ", ".join(sheet.id for sheet in worksheet.stationary)
    return (
        ("Class", worksheet.device_class.value),
        ("Sections", f"{len(worksheet.sections)}, {round(length, 1):.10g} m together"),
        ("Runs", f"{len(runs)}, {sum(not run.error for run in runs)} of them used"),
        ("Stationary tests", tests or "not tested"),
    )


def _criterion(of: str, one: Criterion) -> CriterionRow:
    return CriterionRow(
        of or "all",
        wording.title_of(one),
        one.track or "all",
        wording.value_in_words(one),
        wording.limit_in_words(one),
        one.judged.value,
        one.reason,
    )


def _section(sheet: SectionSheet, limits: CertificationLimits, anchor: str) -> SectionPart:
    return SectionPart(
        anchor,
        f"Section {sheet.name}",
        wording.where(sheet),
        wording.reference_lines(sheet),
        tuple(_criterion(sheet.name, one) for one in sheet.criteria),
        tuple(
            TrackPart(track, tuple(_rows(sheet, track, limits)))
            for track in wording.tracks_of(sheet)
        ),
        tuple(_note(n, run) for n, run in enumerate(sheet.runs, start=1)),
        of_section(sheet, limits, anchor),
        lateral_parts.rows(sheet),
    )


def _rows(sheet: SectionSheet, track: str, limits: CertificationLimits) -> Iterator[RunRow]:
    nothing = (wording.NOTHING,) * len(wording.FIGURES)
    for number, run in enumerate(sheet.runs, start=1):
        found = [wording.figures(one) for one in run.tracks if one.track == track]
        mark = wording.mark(run, limits, track)
        yield RunRow(number, run.name, mark, found[0] if found else nothing)


def _note(number: int, run: RunSheet) -> RunNote:
    return RunNote(number, run.name, run.source, run.error, wording.run_lines(run))


def _test(sheet: StationarySheet, anchor: str) -> SectionPart:
    note = RunNote(1, sheet.id, sheet.source, "", sheet.notes)
    return SectionPart(
        anchor,
        f"Test {sheet.id}",
        wording.what_counts(sheet),
        (),
        tuple(_criterion(sheet.id, one) for one in sheet.criteria),
        (),
        (note,),
        of_test(sheet, anchor),
    )


def _inputs(worksheet: Worksheet) -> Iterator[tuple[str, str]]:
    """Yield the SHA-256 of every file that a profile was made of, as its provenance has them."""
    for source, profile in _profiles(worksheet):
        hashes = profile.provenance.get("sha256") if profile else None
        if isinstance(hashes, Mapping):
            yield from ((f"{source}: {file}", str(value)) for file, value in hashes.items())


def _profiles(worksheet: Worksheet) -> Iterator[tuple[str, Profile | None]]:
    for section in worksheet.sections:
        yield section.reference_source, section.reference
        yield from ((run.source, run.profile) for run in section.runs)
    yield from ((sheet.source, sheet.profile) for sheet in worksheet.stationary)


NAME = "worksheet.html"
TEMPLATE = "worksheet.html.j2"


def write_page(worksheet: Worksheet, path: Path) -> None:
    """Write the page of ``worksheet`` beside ``path`` and rename it.

    Raises InputError where the package that fills in the page is not installed, or ``path``
    cannot be written.
    """
    needs_jinja(NAME)
    with replace_file(path, overwrite=True) as beside:
        beside.write_text(as_html(worksheet), encoding="utf-8")


def as_html(worksheet: Worksheet) -> str:
    """Return the page that shows ``worksheet``.

    All text from a file is escaped, and the page has no link to another file.
    """
    return fill_template(TEMPLATE, __package__, page=page_of(worksheet))
