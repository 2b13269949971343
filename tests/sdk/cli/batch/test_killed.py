"""`floatref batch` under signals: no file is lost, none is done twice, nobody is left behind."""

import csv
import os
import signal
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from shutil import which
from typing import Any

import pytest
from matplotlib.image import imread

pytestmark = [
    pytest.mark.slow,
    pytest.mark.posix,
    pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks at processes"),
]
COMMAND = which("floatref", path=os.pathsep.join([str(Path(sys.executable).parent), os.defpath]))
READY = {f"r{index}": ("ready", 900 - index) for index in range(6)}
WAITING = {"w": ("wait", 400)}
"""Smaller, so that it is begun last; with it a single worker is at work until the gate opens."""


def in_summary(out: Path) -> Counter[tuple[str, str]]:
    with (out / "summary.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return Counter((row["name"].removesuffix(".gate"), row["status"]) for row in rows)


def test_a_worker_killed_in_mid_file_costs_nothing(bench: Any) -> None:
    bench.put(**READY, held=("wait", 2000))
    process = bench.batch("--jobs", "2")
    bench.wait_until(lambda: "held" in bench.begun())
    os.kill(bench.begun()["held"][0], signal.SIGKILL)
    bench.open_gate()
    report = bench.report_of(process)
    assert in_summary(bench.out) == {(name, "done"): 1 for name in (*READY, "held")}
    assert report["files"]["done"] == report["files"]["found"] == 7
    # Once by the worker that was killed.
    assert len(bench.begun()["held"]) >= 2
    assert list(bench.out.rglob(".floatref-*")) == []
    assert list(bench.temporary.iterdir()) == []


@dataclass(frozen=True)
class Story:
    """A batch that is killed, resumed and interrupted, resumed and finished."""

    bench: Any
    leftover: Path
    survivors: list[int]
    records: dict[str, int]
    intruder: tuple[int, str, str]
    interrupted: tuple[int, str, str]
    survivors_of_interruption: list[int]
    report: dict[str, Any]


@pytest.fixture(scope="module")
def story(module_bench: Any) -> Story:
    bench = module_bench
    bench.put(**READY, **WAITING)

    def held() -> bool:
        return len(bench.records()) == len(READY) and bench.at_work() == len(WAITING)

    first = bench.batch("--jobs", "1")
    bench.wait_until(held)
    records = bench.records()
    first.kill()
    bench.wait_until(lambda: bench.processes_of(first.pid) == [])
    survivors = bench.processes_of(first.pid)
    leftover = bench.out / "profiles" / ".floatref-0123456789ab"
    leftover.mkdir()
    bench.forget_begun()
    second = bench.batch("--resume", "--jobs", "1")
    bench.wait_until(held)
    intruder = bench.ended(bench.batch("--resume"))
    os.killpg(second.pid, signal.SIGINT)
    interrupted = bench.ended(second)
    bench.wait_until(lambda: bench.processes_of(second.pid) == [])
    survivors_of_interruption = bench.processes_of(second.pid)
    bench.open_gate()
    report = bench.report_of(bench.batch("--resume", "--jobs", "1"))
    return Story(
        bench,
        leftover,
        survivors,
        records,
        intruder,
        interrupted,
        survivors_of_interruption,
        report,
    )


def test_killed_commands_leave_no_workers(story: Story) -> None:
    assert story.survivors == story.survivors_of_interruption == []


def test_what_is_done_is_never_done_again(story: Story) -> None:
    files = story.report["files"]
    assert (files["found"], files["done"], files["skipped"]) == (7, 7, 6)
    assert story.report["this_run"]["processed"] == len(WAITING)
    # What was begun after the kill are the files that were not done.
    assert set(story.bench.begun()) == set(WAITING)
    after = story.bench.records()
    assert {name: after[name] for name in READY} == story.records


def test_every_file_is_in_the_summary_once(story: Story) -> None:
    assert in_summary(story.bench.out) == {(name, "done"): 1 for name in (*READY, *WAITING)}


def test_leftovers_are_swept(story: Story) -> None:
    assert not story.leftover.exists()
    assert list(story.bench.out.rglob(".floatref-*")) == []


def test_an_interruption_is_one_line_and_130(story: Story) -> None:
    code, out, err = story.interrupted
    assert (code, out) == (130, "")
    assert err == "Interrupted: 6 of 7 files have a result; the same command with --resume goes on"


def test_a_second_command_stays_out_of_the_folder(story: Story) -> None:
    code, out, err = story.intruder
    assert (code, out) == (2, "")
    assert err == "Error: out: another batch works there; wait for it or choose another"


@pytest.mark.skipif(COMMAND is None, reason="the command is not installed")
def test_the_installed_command_starts_workers_as_well(bench: Any) -> None:
    bench.put(one=("ready", 10))
    arguments = ("batch", "in", "--out", "out", "--jobs", "1", "--plot", "out/map.png")
    code, out, err = bench.ended(bench.start(*arguments, program=(COMMAND,)))
    assert (code, err) == (0, "")
    assert "summary.parquet" in out
    assert imread(bench.out / "map.png").shape[0] > 400
