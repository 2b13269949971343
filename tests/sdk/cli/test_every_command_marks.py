"""Every command that prints or draws figures of a profile marks those over invalid points.

The commands are those of the groups themselves. A new one fails here until it states in `CHECKS`
how it is held to this, or why it has no figure of a profile. The profiles have random spans that
are not valid, in which the elevation is wrong by metres.
"""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import click
import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from tests.sdk.cli.invalid_profiles import EXPLAINED, SPANS, Drawn, Span, drawn, hold, printed

from floatref import read_profile
from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Record
from floatref.batch.results.segments import measure_segments
from floatref.batch.results.totals import Tally
from floatref.cli.batch.batch_report import print_report
from floatref.cli.main import main
from floatref.engine.run import Result
from floatref_conformance.cli.main import main as conformance


def process(drawn: Drawn, name: str, *words: object) -> str:
    made = Result(getattr(drawn, name), (), SimpleNamespace(travel=None))
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("floatref.cli.process.recording_of", lambda *_: None)
        patched.setattr("floatref.cli.process.make_profile", lambda *_: made)
        out = drawn.folder / "made"
        return printed("process", drawn.folder / "run", "--out", out, "--overwrite", *words)


def check_process(drawn: Drawn) -> None:
    hold(drawn, lambda name, *words: process(drawn, name, *words))


def check_compare(drawn: Drawn) -> None:
    hold(drawn, lambda name, *words: compare(drawn, name, *words))


def compare(drawn: Drawn, name: str, *words: object) -> str:
    return printed("compare", drawn.folder / "good", drawn.folder / name, *words)


def check_convert(drawn: Drawn) -> None:
    """It has no figure but the length that is not valid, and the flags go with the points."""
    text = printed("convert", drawn.folder / "bad", "--out", drawn.folder / "bad.csv")
    converted = read_profile(drawn.folder / "bad.csv")
    for track in drawn.bad.tracks:
        row = next(line for line in text.splitlines() if line.startswith(f" {track.name}"))
        assert float(row.split()[-1]) == pytest.approx(0.25 * (~track.valid).sum(), abs=0.01)
        np.testing.assert_array_equal(converted[track.name].valid, track.valid)


def check_batch(drawn: Drawn) -> None:
    """Its report; what it ranks and draws is in `test_validity_in_every_figure`."""
    rows, _ = measure_segments(drawn.bad, 50.0)
    tally = Tally()
    record = Record("bad", "/run", rows=rows, length_m=drawn.bad.length_m)
    tally.add(Job(Path("/in"), "bad", Path("/out")), record)
    document = {
        "files": dict.fromkeys(("found", "done", "skipped", "failed"), 0),
        "this_run": {"wall_s": 1.0, "workers": 1, "processed": 0, "length_km": 0.0},
        "effort": {"cpu_s": 0.0, "peak_bytes": 0},
        "warnings": 0,
        "length_km": 0.1,
        "failures": [],
        "pipelines": {},
    }
    command = click.Command("show", callback=lambda: print_report(document, tally, Path("out")))
    lines = CliRunner().invoke(command, []).stdout.splitlines()
    ranked = [line for line in lines if line.startswith(" bad ")]
    for line, (_, _, row) in zip(ranked, tally.roughest, strict=True):
        assert (" * " in line) == (row.counted_share < 1.0)
    assert any(EXPLAINED in line for line in lines) == any(" * " in line for line in ranked)


def picture_of(show: Callable[..., str], drawn: Drawn) -> Figure:
    kept: list[Figure] = []

    def keep(figure: Figure, path: Path, **_: Any) -> None:
        kept.append(figure)
        Path(path).write_bytes(b"")

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Figure, "savefig", keep)
        show(drawn, "bad", "--plot", drawn.folder / "p.png")
    (figure,) = kept
    return figure


def of_profile(command: str, *words: object) -> Callable[[Drawn], None]:
    def check(drawn: Drawn) -> None:
        hold(drawn, lambda name, *more: printed(command, drawn.folder / name, *words, *more))

    return check


CHECKS: dict[str, Callable[[Drawn], None] | str] = {
    "floatref process": check_process,
    "floatref iri": of_profile("iri", "--segment", 50),
    "floatref roughness": of_profile("roughness", "--section", 50),
    "floatref straightedge": of_profile("straightedge", "--segment", 50),
    "floatref compare": check_compare,
    "floatref convert": check_convert,
    "floatref batch": check_batch,
    "floatref view": "its pages mark what is not valid: tests/sdk/viewer, in a browser",
    "floatref plot": "dotted where not valid, as the pictures of process: tests/sdk/plots",
    "floatref pipelines": "lists pipelines",
    "floatref adapters": "lists adapters and formats",
    "floatref channels": "shows channels of a recording",
    "floatref allan": "shows noise of sensors of a recording",
    "floatref tune": "shows settings; its profiles are compared where the reference is known",
    "floatref live": "sends points with their flags, and no figure",
    "floatref warm": "shows times; its profiles are thrown away",
    "floatref vehicle": "shows settings; a slip is that of stretches that two passes agree on",
    "conformance run": "judges a device on roads that are known, its flags among the quantities",
    "conformance replay": "as run",
    "conformance submit": "as run",
    "conformance verify": "compares figures with those of an archive",
    "conformance matrix": "shows what reports state, flagged lengths among the quantities",
    "conformance certify": "shows flagged m beside the IRI of every run",
    "conformance table": "judges pipelines on roads that are known, at all points by intention",
    "conformance faults": "as table; what is wrong and not flagged is its subject",
    "conformance list": "lists checks and devices",
    "conformance scenario": "lists keys",
    "conformance simulate": "writes a recording and its truth, all of it valid",
    "conformance export": "writes recordings",
    "conformance sample": "writes recordings and a reference",
    "conformance explain": "explains a check",
    "conformance selftest": "counts devices and checks",
}
PICTURES: dict[str, Callable[..., str] | str] = {
    "floatref process": process,
    "floatref compare": compare,
    "floatref batch": "its segments have signs: test_validity_in_every_figure.py",
    "floatref allan": "noise of sensors",
    "floatref tune": "settings",
    "conformance table": "cross correlations",
}
COMMANDS = [f"floatref {name}" for name in main.list_commands(None)]
COMMANDS += [f"conformance {name}" for name in conformance.list_commands(None)]
HELD = [name for name in COMMANDS if callable(CHECKS.get(name))]


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_states_how_it_marks_what_is_not_valid(command: str) -> None:
    assert command in CHECKS, (
        f"{command}: state in CHECKS of {Path(__file__).name} the check that its figures and "
        "pictures have a mark where points are not valid, or why it has none"
    )


def test_nothing_is_stated_of_a_command_that_is_gone() -> None:
    assert set(CHECKS) <= set(COMMANDS)


@pytest.mark.slow
@pytest.mark.parametrize("command", HELD)
def test_its_figures_have_a_mark(command: str) -> None:
    check = CHECKS[command]

    @settings(deadline=None, max_examples=3)
    @given(st.integers(0, 2**32 - 1), SPANS, SPANS)
    def law(seed: int, left: list[Span], right: list[Span]) -> None:
        with drawn(seed, left, right) as made:
            check(made)

    law()


def draws(command: str) -> bool:
    program, name = command.split()
    group = {"floatref": main, "conformance": conformance}[program]
    found = group.get_command(click.Context(group), name)
    assert found is not None
    return any("--plot" in option.opts for option in found.params)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_that_draws_states_how_it_marks_what_is_not_valid(command: str) -> None:
    assert draws(command) == (command in PICTURES), f"{command}: state its mark in PICTURES"


@pytest.mark.parametrize("command", [name for name, show in PICTURES.items() if callable(show)])
@pytest.mark.parametrize("lost", [[], [(150, 60)]])
def test_its_picture_is_shaded_where_points_are_not_valid(command: str, lost: list[Span]) -> None:
    with drawn(1, lost, lost) as made:
        axes = picture_of(PICTURES[command], made).axes
    assert [bool(ax.collections) for ax in axes] == [bool(lost)] * len(axes)
