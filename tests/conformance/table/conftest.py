"""Tables made by hand, so that what is made of them is tested apart from any simulation."""

import json
from collections.abc import Callable, Mapping

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from floatref_conformance import table as table_package
from floatref_conformance.cli.main import main
from floatref_conformance.schemas import read_schema
from floatref_conformance.table import Cell, ComparisonTable, Scores, TableSettings
from floatref_conformance.table.published import published_figures

Figures = Mapping[tuple[str, str], Scores]


@pytest.fixture
def hand_table() -> Callable[..., ComparisonTable]:
    """Return a function that makes a table of scores by pipeline and run, one pass each."""

    def make(scores: Figures, settings: TableSettings | None = None) -> ComparisonTable:
        figures = published_figures()
        cells = tuple(Cell(*key, (value,), figures.get(key)) for key, value in scores.items())
        return ComparisonTable(settings or TableSettings(), cells)

    return make


@pytest.fixture
def small() -> TableSettings:
    """Settings of one pipeline in print and two runs: a stop and a brake."""
    return TableSettings(
        roads=1, seeds=1, runs=("sg_5.7s_0.20g", "brk_49-20_0.25g"), pipelines=("temporal-basic",)
    )


@pytest.fixture
def command_making(monkeypatch):
    """Return a function that lets the command make tables by hand instead of the drives.

    ``maker`` of ``package`` becomes one that calls ``make`` with the settings and says that it
    drives ``watched``. Returned are a function that calls the command, and what it was to make.
    """

    def replace_maker(package, maker, make, watched):
        made = []

        def quick(settings, watch):
            made.append(settings)
            watch(watched)
            return make(settings)

        # What would take a quarter of an hour if options went astray.
        monkeypatch.setattr(table_package, "make_table", lambda *_: made.append("runs"))
        monkeypatch.setattr(package, maker, quick)
        return (lambda *words: CliRunner().invoke(main, ["table", *map(str, words)])), made

    return replace_maker


@pytest.fixture
def assert_refused():
    """Return what checks that ``words`` are refused in one line that has ``said``, before work."""

    def check(call, words, said):
        command, made = call
        answer = command(*words)
        assert answer.exit_code == 2
        assert said in answer.stderr.splitlines()[-1]
        assert sum(line.startswith("Error") for line in answer.stderr.splitlines()) == 1
        assert "Traceback" not in answer.output
        assert made == []

    return check


@pytest.fixture
def assert_json():
    """Return what checks that one object of ``form`` is all on stdout, and returns it."""

    def check(answer, form, watched):
        assert answer.exit_code == 0, answer.output
        made = json.loads(answer.stdout)
        Draft202012Validator(read_schema(form.replace("/", "-"))).validate(made)
        assert made["format"] == form
        assert answer.stderr.splitlines() == [f"{watched} …"]
        return made

    return check
