"""Run `floatref batch`, watch its workers, and end it or one of them in mid-run."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import psutil

WORKER = "spawn_main"
"""Of the command line of a process that a nanny started."""
EVERY_S = 0.1
LONGEST_S = 1800


@dataclass
class Run:
    """A run of the command: its exit code, report, wall time in s, and memory of its workers."""

    code: int = 0
    report: dict[str, Any] = field(default_factory=dict)
    stderr: str = ""
    seconds: float = 0.0
    peaks: dict[int, int] = field(default_factory=dict)
    """Largest resident memory in bytes that was seen of each worker, by process id."""


def command(*arguments: str | Path) -> list[str]:
    """Return the command line of `floatref batch`."""
    return [sys.executable, "-m", "floatref", "batch", *map(str, arguments)]


def workers_of(process: int) -> list[psutil.Process]:
    """Return the workers that the process started, those of their own children left out."""
    try:
        children = psutil.Process(process).children()
        return [c for c in children if WORKER in " ".join(c.cmdline())]
    except psutil.Error:
        return []


def batch(
    arguments: Sequence[str | Path],
    watch: Callable[[subprocess.Popen[str]], bool] | None = None,
    helpers: Sequence[int] = (),
) -> Run:
    """Run the command to its end and return how it went.

    ``watch`` is called again and again with the process until it returns True. ``helpers`` are
    workers that were started elsewhere, whose memory counts.
    """
    run = Run()
    begin = time.perf_counter()
    process = subprocess.Popen(
        command(*arguments, "--json"),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    done = threading.Event()
    watcher = threading.Thread(target=_watched, args=(process, watch, helpers, run, done))
    watcher.start()
    try:
        printed, run.stderr = process.communicate(timeout=LONGEST_S)
    finally:
        done.set()
        watcher.join()
    run.seconds = time.perf_counter() - begin
    run.code = process.returncode
    run.report = json.loads(printed) if printed.strip() else {}
    return run


def _watched(
    process: subprocess.Popen[str],
    watch: Callable[[subprocess.Popen[str]], bool] | None,
    helpers: Sequence[int],
    run: Run,
    done: threading.Event,
) -> None:
    watching = watch
    while not done.wait(EVERY_S):
        for worker in [*workers_of(process.pid), *map(psutil.Process, helpers)]:
            try:
                resident = worker.memory_info().rss
            except psutil.Error:
                continue
            run.peaks[worker.pid] = max(resident, run.peaks.get(worker.pid, 0))
        if watching is not None and watching(process):
            watching = None


def records_in(out: Path) -> list[Path]:
    folder = out / "records"
    if not folder.is_dir():
        return []
    return [p for p in folder.rglob("*.json") if not any(x.startswith(".") for x in p.parts)]


def end_worker(out: Path, after: int) -> Callable[[subprocess.Popen[str]], bool]:
    """Return what sends SIGKILL to one worker when there are ``after`` records."""

    def watch(process: subprocess.Popen[str]) -> bool:
        found = workers_of(process.pid)
        if len(records_in(out)) < after or not found:
            return False
        os.kill(found[0].pid, signal.SIGKILL)
        return True

    return watch


def end_all(out: Path, after: int) -> Callable[[subprocess.Popen[str]], bool]:
    """Return what sends SIGKILL to the command and all that it started, after so many records."""

    def watch(process: subprocess.Popen[str]) -> bool:
        if len(records_in(out)) < after:
            return False
        started = psutil.Process(process.pid).children(recursive=True)
        for each in [psutil.Process(process.pid), *started]:
            try:
                each.kill()
            except psutil.NoSuchProcess:
                continue
        return True

    return watch


@contextmanager
def cluster(workers: int, folder: Path) -> Iterator[tuple[str, list[int], int]]:
    """Start a scheduler and workers on loopback; yield address and process ids of both kinds."""
    file, started = folder / "scheduler.json", []
    dask = [sys.executable, "-m", "distributed.cli.dask_"]
    scheduler = [*dask[:2], f"{dask[2]}scheduler", "--host", "127.0.0.1", "--port", "0"]
    worker = [*dask[:2], f"{dask[2]}worker", "--nthreads", "1", "--no-dashboard"]
    try:
        with (folder / "cluster.log").open("w") as log:
            started.append(_started([*scheduler, "--no-dashboard"], file, log))
            started += [_started([*worker, "--no-nanny"], file, log) for _ in range(workers)]
        yield _address(file), [each.pid for each in started[1:]], started[0].pid
    finally:
        for each in reversed(started):
            each.terminate()
            each.wait(30)


def _started(line: list[str], file: Path, log: Any) -> subprocess.Popen[bytes]:
    return subprocess.Popen([*line, "--scheduler-file", str(file)], stdout=log, stderr=log)


def _address(file: Path) -> str:
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        try:
            return str(json.loads(file.read_text())["address"])
        except (OSError, ValueError, KeyError):
            time.sleep(EVERY_S)
    raise TimeoutError("no scheduler within 60 s")
