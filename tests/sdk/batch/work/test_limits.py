"""No wait of a batch is without end, and no signal disturbs a cluster that starts."""

import os
import signal
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

from floatref.batch import Job
from floatref.batch.results.folder import is_worked_in, mark_working
from floatref.batch.work import worker_patience
from floatref.batch.work.held_signals import hold_signals
from floatref.batch.work.limited_calls import call_until, call_within
from floatref.batch.work.running import LOST, _record
from floatref.batch.work.worker_patience import patient


class Silent:
    """A client whose workers are there, and a task that never ends."""

    status = "pending"
    futures: tuple[str, ...] = ()

    def __init__(self) -> None:
        self.over = threading.Event()
        self.cancelled = threading.Event()

    def nthreads(self) -> dict[str, int]:
        return {"tls://here:1": 1}

    def cancel(self, futures: list[Any]) -> None:
        self.cancelled.set()

    def result(self) -> Any:
        self.over.wait(600.0)


@pytest.fixture
def silent() -> Any:
    client = Silent()
    yield client
    client.over.set()


def test_what_answers_is_passed_on() -> None:
    assert call_within(lambda: 3, 600.0) == 3
    with pytest.raises(KeyError):
        call_within(lambda: {}["missing"], 600.0)


@pytest.mark.slow
def test_what_never_answers_is_given_up(silent: Silent) -> None:
    with pytest.raises(TimeoutError):
        call_within(silent.result, 0.01)
    with pytest.raises(TimeoutError):
        call_until(silent.result, lambda: True)


@pytest.mark.slow
def test_a_file_whose_result_never_comes_has_a_row(tmp_path: Path, silent: Silent) -> None:
    job, lost = Job(tmp_path / "a", "a", tmp_path), threading.Event()
    lost.set()
    assert _record(job, silent, False, lost).error == LOST
    assert _record(job, None, False, lost).error == LOST


@pytest.mark.parametrize("busy", [False, True])
def test_workers_without_a_task_are_given_up(
    silent: Silent, busy: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Workers are there all the time; what counts is that a task is being done."""
    monkeypatch.setattr(worker_patience, "OFTEN_S", 0.01)
    asked = threading.Semaphore(0)

    def is_busy() -> bool:
        asked.release()
        return busy

    with patient(silent, 0.05, is_busy) as lost:
        if busy:
            for _ in range(20):
                assert asked.acquire(timeout=600.0)
            assert not lost.is_set()
        else:
            assert lost.wait(600.0)
            assert silent.cancelled.wait(600.0)


@pytest.mark.posix
def test_a_folder_is_worked_in_while_a_task_works(tmp_path: Path) -> None:
    assert not is_worked_in(tmp_path)
    with mark_working(tmp_path):
        assert is_worked_in(tmp_path)
        with mark_working(tmp_path):
            assert is_worked_in(tmp_path)
    assert not is_worked_in(tmp_path)


@pytest.mark.posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("fails", [False, True])
def test_a_held_signal_comes_afterwards_once(number: signal.Signals, fails: bool) -> None:
    steps = []

    def heard(*_: object) -> None:
        steps.append("heard")
        raise KeyboardInterrupt

    def start() -> None:
        with hold_signals():
            for _ in range(3):
                os.kill(os.getpid(), number)
            steps.append("started")
            if fails:
                raise OSError("a worker that was interrupted")

    before = signal.signal(number, heard)
    try:
        with pytest.raises(KeyboardInterrupt):
            start()
        assert signal.getsignal(number) is heard
    finally:
        signal.signal(number, before)
    assert steps == ["started", "heard"]


@pytest.mark.posix
@pytest.mark.skipif(sys.platform == "win32", reason="the signal is one of POSIX")
def test_a_signal_that_is_ignored_stays_ignored() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        with hold_signals():
            os.kill(os.getpid(), signal.SIGTERM)
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGTERM, before)
