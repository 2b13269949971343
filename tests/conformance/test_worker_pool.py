"""Worker processes and Ctrl-C: what is being started is finished first, and no thread fails."""

import os
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor

import pytest

from floatref_conformance.worker_pool import WorkerPool, map_in_order


@pytest.fixture
def another_thread():
    """A thread that takes signals, as those of numerical libraries do."""
    ended = threading.Event()
    thread = threading.Thread(target=ended.wait)
    thread.start()
    yield
    ended.set()
    thread.join()


@pytest.mark.posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.usefixtures("another_thread")
def test_a_signal_waits_until_a_process_has_its_task(monkeypatch, number):
    """Else the process would be there, and wait for a task from a command that has ended."""
    done = []

    def submit(_, task):
        os.kill(os.getpid(), number)
        time.sleep(0.2)
        done.append(task)

    def heard(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(ProcessPoolExecutor, "submit", submit)
    before = signal.signal(number, heard)
    try:
        with WorkerPool(1) as pool, pytest.raises(KeyboardInterrupt):
            pool.submit(str)
        assert signal.getsignal(number) is heard
    finally:
        signal.signal(number, before)
    assert done == [str]


def test_results_come_in_order_and_end():
    with map_in_order(pow, 2, [2, 3, 4], [2, 2, 2]) as results:
        assert list(results) == [4, 9, 16]


@pytest.mark.slow
@pytest.mark.posix
def test_no_thread_fails_where_processes_end_before_the_pool(monkeypatch):
    """Under load they end first, and the pool's thread finds them missing."""
    failed = []

    def late(self, *arguments, **more):
        time.sleep(1.0)
        ProcessPoolExecutor.shutdown(self, *arguments, **more)

    monkeypatch.setattr(WorkerPool, "shutdown", late)
    monkeypatch.setattr(threading, "excepthook", failed.append)
    with pytest.raises(KeyboardInterrupt):
        interrupt_while_waiting()
    assert failed == []


def interrupt_while_waiting():
    """Wait for a result that comes in a minute, until a signal comes in half a second."""
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        with map_in_order(time.sleep, 2, [0.0, *[60.0] * 20]) as results:
            next(results)
            signal.setitimer(signal.ITIMER_REAL, 0.5)
            next(results)
    finally:
        signal.signal(signal.SIGALRM, before)
