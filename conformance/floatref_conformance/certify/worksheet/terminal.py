"""A certification in the terminal: the verdict, then every number that it rests on."""

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.judging.contents import (
    Criterion,
    Judged,
    RunSheet,
    SectionSheet,
    StationarySheet,
    Worksheet,
)
from floatref_conformance.certify.worksheet import lateral_parts, wording
from floatref_conformance.render.terminal import PLAIN_WIDTH
from floatref_conformance.render.text import printable

COLOURS = {Judged.PASS: "green", Judged.FAIL: "red", Judged.MISSING: "yellow"}
HEADS = (
    "accu-\nracy",
    "with\nothers",
    "IRI\nm/km",
    "bias\n%",
    "distance\n% ± 2σ",
    "height\n% ± 2σ",
    "flag-\nged, m",
)
MOST_RUNS = 12
"""With more, only the page and the document have the matrix of pairs."""
LONGEST_NAME = 10
NARROW = (0, 0, 0, 0)


def print_worksheet(worksheet: Worksheet, console: Console) -> None:
    """Print the verdict, every section, the stationary tests, the limits, the verdict again."""
    if not console.is_terminal:
        console.width = max(console.width, PLAIN_WIDTH)
    _say(console, wording.verdict_line(worksheet))
    for section in worksheet.sections:
        _print_section(section, worksheet, console)
    for sheet in worksheet.stationary:
        _print_stationary(sheet, console)
    if worksheet.criteria:
        _print_criteria("All sections together", worksheet.criteria, console)
    _say(console, "")
    for line in closing_lines(worksheet):
        _say(console, line)
    _say(console, wording.verdict_line(worksheet))


def closing_lines(worksheet: Worksheet) -> tuple[str, ...]:
    """Return practice, limits, settings and versions, then where criteria come from."""
    rows = (
        ("Limits", wording.limits_in_words(worksheet.limits)),
        ("Settings", wording.list_pairs(worksheet.settings)),
        ("Versions", wording.list_pairs(worksheet.versions)),
    )
    lines = [
        f"{title}: {'; '.join(f'{name} {value}' for name, value in pairs)}."
        for title, pairs in rows
        if pairs
    ]
    practice = (f"{name}: {value}." for name, value in wording.practice_in_words(worksheet.limits))
    clauses = (f"{id_}: {clause}." for id_, clause in wording.clauses_of(worksheet))
    return (*practice, *lines, *clauses)


def _print_section(section: SectionSheet, worksheet: Worksheet, console: Console) -> None:
    _say(console, "")
    _say(console, f"Section {section.name}: {wording.where(section)}")
    for line in wording.reference_lines(section):
        _say(console, f"  {line}")
    _print_criteria("Criteria", section.criteria, console)
    for track in wording.tracks_of(section):
        title = f"Runs, wheel path {track} (*: {wording.DISAGREES})"
        _show(title, _runs(section, track, worksheet), console)
    if 1 < len(section.runs) <= MOST_RUNS:
        limit = worksheet.limits.repeatability or 0.0
        below = f" (*: below {limit:g})" if limit else ""
        for track, pairs in section.pairs.items():
            title = f"Pairs of runs, wheel path {track}{below}"
            _show(title, _pairs(pairs, limit), console)
    elif section.runs[MOST_RUNS:]:
        _say(console, f"The pairs of {len(section.runs)} runs are on the page and in the document.")
    if section.lateral:
        _show("Agreement by lateral separation", _lateral(section), console)
    for index, run in enumerate(section.runs, start=1):
        _print_run(index, run, console)


def _print_run(index: int, run: RunSheet, console: Console) -> None:
    """Print the notes on a run, if there are any."""
    lines = wording.run_lines(run)
    if lines:
        _say(console, f"Run {index}, {run.name}:")
    for line in lines:
        _say(console, f"  {line}")


def _print_stationary(sheet: StationarySheet, console: Console) -> None:
    _say(console, "")
    _say(console, f"Test {sheet.id}: {wording.what_counts(sheet)}")
    _print_criteria("Criteria", sheet.criteria, console)
    for line in sheet.notes:
        _say(console, f"  {line}")


def _print_criteria(title: str, criteria: tuple[Criterion, ...], console: Console) -> None:
    """Print a table of ``criteria``, and below it why they are not met."""
    table = _empty()
    for head in ("criterion", "path"):
        table.add_column(head, overflow="fold")
    for head in ("value", "limit"):
        table.add_column(head, justify="right", no_wrap=True)
    table.add_column("outcome", no_wrap=True)
    for one in criteria:
        word = Text(one.judged.value, COLOURS.get(one.judged, ""))
        value, limit = wording.value_in_words(one), wording.limit_in_words(one)
        cells = (wording.title_of(one), one.track or "all", value, limit)
        table.add_row(*map(_text, cells), word)
    _show(title, table, console)
    for one in criteria:
        if one.reason:
            of = f" {one.track}" if one.track else ""
            _say(console, f"  {wording.title_of(one)}{of}: {one.reason}")


def _runs(section: SectionSheet, track: str, worksheet: Worksheet) -> Table:
    """Return one row for each run, with a star where the run does not agree."""
    table = _empty(NARROW)
    table.add_column("run", no_wrap=True)
    for head in HEADS:
        table.add_column(head, justify="right", no_wrap=True, vertical="bottom")
    for index, run in enumerate(section.runs, start=1):
        found = [wording.figures(one) for one in run.tracks if one.track == track]
        bad = wording.mark(run, worksheet.limits, track) == wording.DISAGREES
        star = "*" if bad else " "
        numbers = found[0] if found else (wording.NOTHING,) * len(HEADS)
        table.add_row(_text(f"{index:>2}{star} {_short(run.name)}"), *map(_text, numbers))
    return table


def _pairs(pairs: FloatArray, limit: float) -> Table:
    """Return the cross correlations of all pairs; those below ``limit`` bear a star."""
    table = _empty(NARROW)
    table.add_column("")
    for column in range(2, len(pairs) + 1):
        table.add_column(f"{column} ", justify="right", no_wrap=True)
    for row in range(len(pairs) - 1):
        cells = [""] * row + [_pair(value, limit) for value in pairs[row, row + 1 :]]
        table.add_row(f"{row + 1:>2}", *cells)
    return table


def _lateral(section: SectionSheet) -> Table:
    table = _empty(NARROW)
    for head in lateral_parts.HEADS:
        table.add_column(head, overflow="fold")
    for row in lateral_parts.short_rows(section):
        table.add_row(*map(_text, row))
    return table


def _pair(value: float, limit: float) -> str:
    return wording.correlation(value) + ("*" if value < limit else " ")


def _short(name: str) -> str:
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"


def _empty(padding: tuple[int, int, int, int] = (0, 1, 0, 0)) -> Table:
    return Table(
        box=SIMPLE_HEAD,
        padding=padding,
        pad_edge=False,
        show_edge=False,
    )


def _show(title: str, table: Table, console: Console) -> None:
    """Print ``table`` below a title, which may be wider."""
    _say(console, "")
    console.print(Text(printable(title), "bold"), soft_wrap=True)
    console.print(table)


def _text(words: str) -> Text:
    return Text(printable(words))


def _say(console: Console, line: str) -> None:
    console.print(printable(line), markup=False, highlight=False, soft_wrap=True)
