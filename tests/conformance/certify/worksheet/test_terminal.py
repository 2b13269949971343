"""The worksheet in the terminal: legible in 80 columns, and every number and reason is there."""

import re
from dataclasses import replace
from io import StringIO
from math import nan

import numpy as np
import pytest
from rich.console import Console

from floatref_conformance.certify.judging.contents import Cause, Judged
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.worksheet.page import as_html
from floatref_conformance.certify.worksheet.terminal import MOST_RUNS, print_worksheet
from floatref_conformance.certify.worksheet.wording import is_bad


def shown(worksheet, width=80, terminal=True):
    file = StringIO()
    console = Console(file=file, width=width, force_terminal=terminal, no_color=True)
    print_worksheet(worksheet, console)
    return re.sub(r"\x1b\[[0-9;]*m", "", file.getvalue())


def row_of(text, name):
    return next(line for line in text.splitlines() if re.match(rf" *\d+[* ] {name}", line))


def test_the_verdict_is_first_and_last(certified):
    lines = shown(certified()).splitlines()
    assert lines[0] == lines[-1]
    assert lines[0].startswith("FAIL: Van 7: 2 of 3 criteria that were judged are met; 1 could")


def test_tables_fit_80_columns_and_no_number_is_cut(certified, run_of):
    make, numbers = run_of
    wide = [numbers(t, distance_percent=-12.34, height_percent=-56.78, height_sigma=4.9,
                    iri_m_per_km=15.123, bias_percent=-98.76, flagged_m=1234.5)
            for t in ("left", "right")]  # fmt: skip
    made = certified()
    section = replace(made.sections[0], runs=(make(1, wide, name="a-very-long-name-of-a-run"),))
    text = shown(replace(made, sections=(section,)))
    figures = "0.9700 0.9600 15.123 −98.76 −12.340 ± 0.020 −56.78 ± 9.80 1234.5"
    row = row_of(text, "a-very-lo…")
    assert " ".join(row.split()).endswith(figures)
    assert len(row) <= 80


def test_a_run_that_does_not_agree_bears_a_star_and_its_cause(certified):
    text = shown(certified())
    assert re.findall(r" *(\d)\* run-\d", text) == ["3"] * 2
    assert "left: takes the section 1.00 % longer; explains 93 % of what" in text
    assert "not used: holds no profile" in text
    assert "reversed: driven from the other end" in text


@pytest.mark.parametrize(
    ("changes", "bad"),
    [
        ({}, False),
        ({"causes": [Cause("noise", "noise", nan)]}, True),
        ({"accuracy": 0.89}, True),
        ({"accuracy": nan}, True),
        ({"distance_percent": -0.3, "distance_sigma": 0.01}, True),
        ({"distance_percent": -0.3, "distance_sigma": 0.2}, False),
        ({"height_percent": 1.5, "height_sigma": 0.1}, True),
        ({"height_percent": nan, "height_sigma": nan}, False),
    ],
)
def test_a_run_agrees_unless_something_is_surely_wrong(run_of, changes, bad):
    make, numbers = run_of
    run = make(1, [numbers("left", **changes), numbers("right")])
    assert is_bad(run, CertificationLimits()) is is_bad(run, CertificationLimits(), "left") is bad
    assert not is_bad(run, CertificationLimits(), "right")


def test_every_criterion_stands_with_its_limit_and_its_reason(certified):
    text = " ".join(shown(certified(), 120).split())
    for part in (
        "Accuracy left 0.9500 ≥ 0.9 pass",
        "Distance left +1.000 % ± 0.15 % fail",
        "Distance left: run-3 takes the section 1.00 % longer",
        "Iri-Bias left +0.400 % no limit reported",
        "Bounce left – ≤ 0.126 m/km missing",
    ):
        assert part in text


def test_pairs_below_the_limit_bear_a_star(certified, section_of, run_of):
    make, numbers = run_of
    runs = [make(n, [numbers("left")]) for n in (1, 2, 3)]
    pairs = np.array([[nan, 0.9196, 0.95], [nan, nan, nan], [nan, nan, nan]])
    made = section_of(runs, tracks=("left",), pairs={"left": pairs})
    text = shown(certified(sections=(made,)))
    assert re.search(r"^ *1 +\.920\* +\.950 *$", text, re.M)
    assert re.search(r"^ *2 +– *$", text, re.M)


@pytest.mark.parametrize("runs", [1, MOST_RUNS, MOST_RUNS + 1])
def test_the_matrix_is_shown_as_long_as_it_fits(certified, section_of, run_of, runs):
    make, numbers = run_of
    made = section_of([make(n + 1, [numbers("left")]) for n in range(runs)], tracks=("left",))
    text = shown(certified(sections=(made,)))
    assert ("Pairs of runs" in text) == (1 < runs <= MOST_RUNS)
    assert (f"The pairs of {runs} runs" in text) == (runs > MOST_RUNS)
    assert all(len(line) <= 80 for line in text.splitlines() if ".960" in line)


def test_what_a_file_said_is_text(certified, hostile, run_of):
    make, numbers = run_of
    run = make(1, [numbers("left")], name="[red]x[/red]", notes=(hostile,))
    made = certified(profiler="[bold]" + hostile)
    section = replace(made.sections[0], runs=(run,), name=hostile, reference_source=hostile)
    text = shown(replace(made, sections=(section,)), terminal=False)
    assert "[bold]" in text
    assert "1  [red]x[/r…" in text
    assert not {"\x00", "\x1b", "\u202e", "\ud800"} & set(text)


def test_without_criteria_nothing_is_called_met(certified, judged):
    missing = judged("runs", 0.0, 10.0, Judged.MISSING)
    made = certified(sections=(), stationary=(), criteria=(missing,))
    assert "nothing was judged; 1 could not" in shown(made)


def test_what_is_said_of_the_reference_is_told_in_the_terminal_and_on_the_page(
    certified, section_of, run_of
):
    make, numbers = run_of
    said = ("processed by temporal-basic", "a gap of 3 m")
    section = section_of([make(1, [numbers("left")])], tracks=("left",), reference_notes=said)
    made = certified(sections=(section,))
    for line in said:
        assert f"the reference: {line}" in shown(made)
        assert f"the reference: {line}" in as_html(made)
