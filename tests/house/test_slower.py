"""What became slower: a line for each stage, whatever the tools; never a failure."""

import importlib
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
BENCHMARKS = ROOT / "tests" / "benchmarks"
TOOLS = {"machine": "x86_64", "cc": "cc 12.2.0"}
BEFORE = {"filter": 100.0, "integral": 20.0, "iri": 50.0}


@pytest.fixture(scope="module")
def slower():
    """Return the module, which is no package's."""
    with pytest.MonkeyPatch.context() as patched:
        patched.syspath_prepend(str(BENCHMARKS))
        yield importlib.import_module("slower")


@pytest.fixture(scope="module")
def instructions(slower: ModuleType) -> ModuleType:
    """Return the module that counts."""
    return slower.instructions


def lines(slower: ModuleType, now: dict[str, float], tools=None) -> list[str]:
    """Return what is said of counts ``now``, after `BEFORE`."""
    stored = {"stages": {"tools": TOOLS, "counts": BEFORE}}
    return slower.report(stored, {"stages": {"tools": tools or TOOLS, "counts": now}})


@pytest.mark.parametrize("factor", [1.0, 1.049, 0.951])
def test_what_is_within_five_percent_is_one_line(slower, factor):
    found = lines(slower, {name: factor * count for name, count in BEFORE.items()})
    assert found == ["nothing of 3 by more than 5%"]


@pytest.mark.parametrize("name", BEFORE)
def test_each_stage_that_is_slower_is_a_line_with_both_counts(slower, name):
    (found,) = lines(slower, BEFORE | {name: 1.051 * BEFORE[name]})
    assert found.startswith(f"{name} takes {1.051 * BEFORE[name]:.1f} ")
    assert f"{BEFORE[name]:.1f} before: +5.1%" in found


def test_what_is_faster_is_to_be_stored_lest_it_be_lost(slower):
    (found,) = lines(slower, BEFORE | {"filter": 90.0})
    assert found == "filter became faster: store it by .ci/slower --write"


@pytest.mark.parametrize("now", [BEFORE | {"new": 1.0}, {"filter": 100.0, "integral": 20.0}])
def test_stages_that_come_and_go_are_named(slower, now):
    (found,) = lines(slower, now)
    (changed,) = set(now) ^ set(BEFORE)
    assert found.startswith(f"{changed}: added or removed")


def test_another_compiler_is_one_line_whatever_the_counts(slower):
    (found,) = lines(slower, {"filter": 900.0}, TOOLS | {"cc": "cc 14.1.0"})
    assert found == (
        "stages cannot be compared, counted with x86_64, cc 12.2.0; now x86_64, cc 14.1.0"
    )


@pytest.mark.parametrize(
    ("problem", "said"),
    [
        (
            RuntimeError("cc ended with 1: x.c:1: expected ;\n 1 | x"),
            "skipped, cc ended with 1: x.c:1: expected ;",
        ),
        (subprocess.TimeoutExpired("cc", 60.0), "skipped, not counted in 60 s"),
    ],
)
def test_a_problem_is_a_line(slower, monkeypatch, problem, said):
    def fail(*_, **__):
        raise problem

    monkeypatch.setattr(slower, "count", fail)
    monkeypatch.setattr(slower.instructions, "missing_tools", list)
    assert slower.lines(write=False, pipelines=False) == [said]


def test_without_the_tools_it_is_skipped_and_no_failure(tmp_path):
    command = [sys.executable, str(BENCHMARKS / "slower.py")]
    found = subprocess.run(command, capture_output=True, text=True, env={"PATH": str(tmp_path)})
    assert found.returncode == 0, found.stderr
    assert found.stdout == "== slower: skipped, cc, valgrind is not installed\n"


def test_counts_are_stored_of_every_stage_and_of_no_other(slower, instructions):
    assert set(slower.stored()["stages"]["counts"]) == set(instructions.stages())


def test_start_up_is_no_part_of_a_sample(instructions):
    assert instructions.per_sample([(3000, 5000 + 7 * 3000), (1000, 5000 + 7 * 1000)]) == 7.0


@pytest.mark.slow
def test_a_stage_that_does_more_is_found_and_others_count_the_same(slower, tmp_path):
    instructions, names = slower.instructions, ["integral", "filter_high_pass_1", "road_prior"]
    if instructions.missing_tools():
        pytest.skip(", ".join(instructions.missing_tools()) + " is not installed")
    before = instructions.of_stages(names)
    library = tmp_path / "c"
    shutil.copytree(instructions.LIBRARY, library)
    source = library / "src" / "integral.c"
    text, done = source.read_text(encoding="utf-8"), "    *written = count;\n"
    more = "    for (volatile size_t k = 0; k < count; k++) {\n    }\n"
    source.write_text(text.replace(done, more + done, 1), encoding="utf-8")
    now = instructions.of_stages(names, library)
    (found,) = slower.differences(before, now)
    assert found.startswith("integral takes ")
    assert now["integral"] - before["integral"] >= 3.0
    assert {name: now[name] for name in names[1:]} == {name: before[name] for name in names[1:]}
