"""`floatref batch`: what is refused before any work, and what is said of it."""

import signal
import sys
from collections.abc import Callable
from dataclasses import replace
from io import StringIO
from pathlib import Path
from threading import Event
from time import monotonic, sleep

import click
import pytest
from rich.console import Console

from floatref.batch.jobs.inputs import Found
from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Record, write_record
from floatref.batch.results.totals import Tally
from floatref.cli.batch.batch_report import (
    FAILURES,
    count_names,
    describe_progress,
    print_report,
    progress,
)
from floatref.cli.batch.interruption import interruptible


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder of the working directory with something in it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs" / "a.mf4").write_bytes(b"nothing of the kind")
    (tmp_path / "given.json").write_text('{"cutoff": 3}', encoding="ascii")
    (tmp_path / "others").mkdir()
    (tmp_path / "others" / "letter.txt").touch()
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["runs"], "Missing option '-o' / '--out'"),
        (["--out", "out"], "Missing argument 'IN...'"),
        (["runs", "--out", "out", "--jobs", "0"], "0 is not in the range"),
        (
            ["runs", "--out", "out", "--jobs", "2", "--cluster", "tcp://a:1"],
            "omit it or --cluster",
        ),
        (
            ["runs", "--out", "out", "--settings", "given.json"],
            "settings cutoff: no pipeline of `auto`",
        ),
        (["runs", "--out", "out", "--segment", "-5"], "segment -5.0 m"),
        (["runs", "--out", "out", "--plot", "a.txt"], "a.txt: not the name of a drawing"),
        (["runs", "--out", "none/out"], "its folder does not exist"),
        (["runs", "--out", "others", "--resume"], "others: holds other files and no batch"),
        (["runs", "--out", "out", "--cluster", "far away"], "no scheduler answers there"),
    ],
)
def test_wrong_usage_is_one_line_and_leaves_nothing(
    runs: Path, arguments: list[str], text: str, refused
) -> None:
    before = sorted(runs.rglob("*"))
    assert text in refused("batch", *arguments)
    assert sorted(runs.rglob("*")) == before


def test_a_missing_extra_is_named(runs: Path, monkeypatch: pytest.MonkeyPatch, refused) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert 'pip install -e ".[batch]"' in refused("batch", "runs", "--out", "out")
    assert not (runs / "out").exists()


def tallied(done: int, failed: int) -> Tally:
    names = [f"f{index}" for index in range(done + failed)]
    jobs = [Job(Path("/in", name), name, Path("/out")) for name in names]
    tally = Tally()
    tally.begin([*jobs, jobs[0]], 0.0)
    for index, job in enumerate(jobs):
        error = "" if index < done else f"damaged at byte {index}"
        tally.add(job, Record(job.name, str(job.source), error, length_m=500.0))
    return tally


def test_progress_tells_files_failures_and_rate() -> None:
    text = describe_progress(tallied(3, 2))
    assert text.startswith("5 of 6 files, 2 failed, ")
    assert text.index(" left, ") < text.index(" files/min, ") < text.index(" km/h")


def test_where_nobody_watches_progress_is_plain_lines() -> None:
    stream = StringIO()
    tally = tallied(1, 0)
    with progress(tally, stream, lambda: 4, every_s=0.001):
        while "\n" not in stream.getvalue():
            pass
    assert "\x1b" not in stream.getvalue()
    line = stream.getvalue().splitlines()[0]
    assert line.startswith("1 of 2 files, 0 failed")
    assert line.endswith(", 4 workers")


def test_a_terminal_has_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    # rich takes this for a terminal.
    monkeypatch.setenv("FORCE_COLOR", "1")
    stream = StringIO()
    assert Console(file=stream).is_terminal
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setattr("floatref.cli.batch.batch_report.REFRESH_S", 0.001)
    tally, over = tallied(2, 1), Event()
    answers = iter([7])

    def workers() -> int:
        # Asked once more, it does not answer before the end.
        return next(answers, 0) or int(over.wait(600.0))

    def drawn(start: str) -> bool:
        return any(start in f and "7 workers" in f for f in stream.getvalue().split("━"))

    with progress(tally, stream, workers) as tell:
        wait_until(lambda: drawn("3 of 4 files, 1 failed"))
        tally.failed["late"] = "damaged"
        tell()
        wait_until(lambda: drawn("4 of 4 files, 2 failed"))
        over.set()


def wait_until(is_so: Callable[[], bool]) -> None:
    end = monotonic() + 600.0
    while not is_so():
        assert monotonic() < end, "it never came to that"
        sleep(0.01)


def test_failures_are_listed_up_to_a_number(capsys: pytest.CaptureFixture[str]) -> None:
    tally = tallied(1, FAILURES + 3)
    failures = [{"name": name, "error": why} for name, why in tally.failed.items()]
    files = {"found": 24, "done": 1, "failed": 23, "skipped": 0}
    run = {"wall_s": 60.0, "workers": 2, "processed": 24, "length_km": 0.5}
    effort = {"cpu_s": 1.0, "peak_bytes": 1_000_000}
    document = {"files": files, "this_run": run, "effort": effort, "failures": failures}
    document["pipelines"] = {"best": 20, "other": 1}
    print_report({**document, "warnings": 0, "length_km": 0.5}, tally, Path("out"))
    text = capsys.readouterr().out
    assert text.count("damaged at byte") == FAILURES
    assert "and 3 more, in the summary" in text
    assert "\nMade by: best 20 files, other 1 file\n" in text


@pytest.mark.parametrize(
    ("names", "text"),
    [
        (["a"], "1 file (a)"),
        (list("abc"), "3 files (a, b, c)"),
        (list("abcd"), "4 files (a, b, c,"),
    ],
)
def test_names_are_told_up_to_a_number(names: list[str], text: str) -> None:
    assert count_names(names).startswith(text)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_work_once(
    number: signal.Signals, capsys: pytest.CaptureFixture[str]
) -> None:
    before = signal.getsignal(number)
    steps = []

    def work() -> None:
        try:
            signal.raise_signal(number)
        finally:
            # Impatience does not hinder what has to be tidied up.
            signal.raise_signal(number)
            steps.append("tidied")

    with pytest.raises(click.exceptions.Exit) as ended, interruptible(lambda: "so far"):
        work()
    assert ended.value.exit_code == 130
    assert (steps, capsys.readouterr().err) == (["tidied"], "so far\n")
    assert signal.getsignal(number) is before


@pytest.mark.parametrize(
    ("written", "line"),
    [
        ([], "Interrupted before any file was done\n"),
        (
            ["a.mf4"],
            "Interrupted: 1 of 2 files have a result; the same command with --resume goes on\n",
        ),
    ],
)
def test_what_is_on_disk_counts_although_the_command_has_not_heard_of_it(
    runs: Path, monkeypatch: pytest.MonkeyPatch, invoke, written: list[str], line: str
) -> None:
    (runs / "runs" / "b.mf4").write_bytes(b"another one")

    def interrupted(found: Found, *_: object) -> None:
        for job in found.jobs:
            if job.name in written:
                write_record(Record(job.name, str(job.source)), job.record)
        # Of a file that is no longer given.
        write_record(Record("z", "z"), replace(found.jobs[0], name="z").record)
        raise KeyboardInterrupt

    monkeypatch.setattr("floatref.cli.batch.command.work_through", interrupted)
    ended = invoke("batch", "runs", "--out", "out")
    assert (ended.exit_code, ended.stdout, ended.stderr) == (130, "", line)


def test_a_signal_that_was_ignored_stays_so() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interruptible(lambda: "never"):
            signal.raise_signal(signal.SIGINT)
    finally:
        signal.signal(signal.SIGINT, before)
