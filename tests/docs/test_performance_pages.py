"""The pages on performance: tables follow from what benchmarks print, and aims from figures."""

import importlib
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCS, BENCHMARKS = ROOT / "docs", ROOT / "tests" / "benchmarks"
PAGES = sorted(DOCS.glob("performance*.md"))
PLACE = r"<!-- figures: (\w+) -->"
QUICK = {
    "filters": ["2000"],
    "varying": ["70000"],
    "iri": ["0.5"],
    "joint": ["50"],
    "retrofit": ["160"],
    "startup": [],
}
"""Arguments with which benchmarks take seconds."""


@pytest.fixture(scope="module")
def load():
    """Return a module of the benchmarks, which are no package."""
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(BENCHMARKS))
        yield importlib.import_module


@pytest.fixture(scope="module")
def figures(load):
    """Return the rows."""
    return load("figures")


@pytest.fixture(scope="module")
def commands(load):
    """Return the commands of the rows."""
    return load("figure_rows").COMMANDS


def test_the_tables_are_written_from_the_measurements():
    command = [sys.executable, "tests/benchmarks/performance_pages.py", "--check"]
    found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert found.returncode == 0, found.stderr


def test_every_table_stands_in_one_page(load):
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert sorted(re.findall(PLACE, text)) == sorted(load("performance_pages").PARTS)


def test_every_benchmark_that_is_named_exists():
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    named = set(re.findall(r"\b(?:bench_\w+|write_figures|instructions)\.py", text))
    assert len(named) > 10
    assert not [name for name in named if not (BENCHMARKS / name).is_file()]


def test_every_command_exists_with_its_options(commands):
    for command in commands.values():
        script, *words = command.split()
        text = (BENCHMARKS / script).read_text(encoding="utf-8")
        assert not [w for w in words if w.startswith("--") and f'"{w}"' not in text], command


def test_every_row_has_a_command_and_every_command_a_row(figures, commands):
    # Growth writes files of its own.
    assert {row.command for row in figures.ROWS} == set(commands) - {"growth"}


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_every_row_is_printed_by_its_benchmark(figures, commands, name):
    script = BENCHMARKS / commands[name].split()[0]
    command = [sys.executable, str(script), *QUICK[name]]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    printed = run.stdout
    rows = [row for row in figures.ROWS if row.command == name]
    found = [row for row in rows if row.found(printed)]
    assert found
    assert [row.what for row in rows if row not in found and not figures.peer(row)] == []
    for row in found:
        assert all(float(group) >= 0.0 for group in row.found(printed))


@pytest.mark.parametrize(("ratio", "met"), [("0.59", "yes"), ("0.60", "yes"), ("0.61", "**no**")])
def test_whether_an_aim_is_met_follows_from_the_figure(figures, ratio, met):
    row = figures.ROWS[0]
    printed = f"  floatref       9.00 ns/point\n  sosfilt       15.00 ns/point    ratio {ratio}\n"
    _, ours, peer, shown, aim, found, command = row.line(printed)
    assert (ours, peer) == ("9.00 ns/point", "`sosfilt, twice`, 15.00 ns/point")
    assert (shown, aim, found) == (ratio, "≤ 0.6", met)
    assert command == "`bench_filters.py`"


def test_a_benchmark_that_prints_something_else_is_refused(figures):
    with pytest.raises(ValueError, match=r"bench_startup\.py does not print"):
        figures.table({"startup": "floatref --help: quick"})
    # A peer that is not installed is no such thing.
    only_numpy = (
        "  floatref     9000 ns/step\n  numpy, steps (a)-(c)   99000 ns/step   ratio 0.090\n"
    )
    assert len(figures.table({"joint": only_numpy})) == 1


def test_a_machine_that_is_not_idle_is_refused(load, monkeypatch, capsys):
    write = load("write_figures")
    monkeypatch.setattr(write, "load", lambda: 0.51)
    monkeypatch.setattr(write, "run", lambda *_: pytest.fail("it ran"))
    monkeypatch.setattr(sys, "argv", ["write_figures.py"])
    assert write.main() == 2
    assert "load average 0.51: not idle" in capsys.readouterr().out


def test_others_are_what_all_did_without_us(load, monkeypatch):
    machine = load("machine")
    clock = iter([(100.0, 50.0, 7.0), (110.0, 68.0, 17.0)])
    now = {}

    def tick():
        now["wall"], now["busy"], now["own"] = next(clock)

    monkeypatch.setattr(machine.time, "perf_counter", lambda: now["wall"])
    monkeypatch.setattr(machine, "busy_s", lambda: now["busy"])
    monkeypatch.setattr(machine, "own_s", lambda: now["own"])
    tick()
    others = machine.Others()
    tick()
    assert others.processors() == pytest.approx((18.0 - 10.0) / 10.0)


@pytest.mark.parametrize("power", [0.9, 1.0, 1.1])
def test_the_exponent_is_that_of_the_time_without_the_start(load, power):
    runs = load("growth_runs")
    lengths = [60.0 * m for m in (1, 2, 4, 8, 16, 30, 60, 120, 240, 480, 720)]
    made = [runs.Run(s, 2, 1.5 + 0.01 * s**power, 0.0, 300.0, 10.0, 1.0, 0.0) for s in lengths]
    assert runs.exponent(made) == pytest.approx(power, abs=1e-3)


def test_runs_are_read_as_they_were_written(load):
    runs = load("growth_runs")
    found = {"lengths": {"a": [runs.Run(60.0, 2, 1.0, 2.0, 300.0, 10.0, 1.0, 0.0)]}, "paths": {}}
    assert runs.from_json(runs.as_json({"cores": 2}, found)) == ({"cores": 2}, found)
