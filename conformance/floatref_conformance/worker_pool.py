"""Worker processes that end with the command: after Ctrl-C, SIGTERM or an error at once.

Ctrl-C reaches every process of a terminal. The first one alone decides; a worker that heard it
would print a traceback of its own, or die while others wait for it.
"""

import signal
import tempfile
from collections import deque
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, resource_tracker
from multiprocessing.process import BaseProcess
from threading import current_thread, main_thread
from time import monotonic
from types import FrameType
from typing import Any, TypeVar

from floatref.files.scratch import scratch_folder
from floatref_conformance.errors import SuiteError
from floatref_conformance.kept_memory import keep_memory
from floatref_conformance.parent_death import end_with_parent

Result = TypeVar("Result")
GRACE_S = 10.0
"""Longest time in s until a process has ended that was asked to; then it is killed."""
LONGEST_S = 24 * 3600.0
"""Longest time in s of one task; one that takes longer hangs."""


class WorkerPool(ProcessPoolExecutor):
    """A pool whose processes are deaf to Ctrl-C from their first instruction on."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Submit ``fn``; a process may be started for it."""
        with _without_interrupts():
            return super().submit(fn, *args, **kwargs)


@contextmanager
def worker_pool(processes: int) -> Iterator[WorkerPool]:
    """Yield a pool whose processes, and their temporary files, end with it, after an error at once.

    A fork would share the threads of this process.
    """
    others = set(active_children())
    with scratch_folder("workers") as scratch:
        pool = WorkerPool(processes, get_context("spawn"), _prepare_worker, (str(scratch),))
        try:
            yield pool
        except BaseException:
            _end(set(active_children()) - others)
            raise
        finally:
            pool.shutdown(cancel_futures=True)


def _end(workers: Collection[BaseProcess]) -> None:
    """End ``workers``, and kill those that do not end within `GRACE_S`."""
    for worker in workers:
        worker.terminate()
    end_s = monotonic() + GRACE_S
    for worker in workers:
        worker.join(max(0.0, end_s - monotonic()))
        if worker.is_alive():
            worker.kill()


def wait_for(future: "Future[Result]", what: str) -> Result:
    """Return the result of ``future``; SuiteError if ``what`` is not done within `LONGEST_S`."""
    try:
        return future.result(LONGEST_S)
    except TimeoutError as error:
        if future.done():
            raise
        raise SuiteError(f"{what}: not done after {LONGEST_S / 3600:g} h") from error


@contextmanager
def map_in_order(
    do: Callable[..., Result], processes: int, *items: Sequence[Any]
) -> Iterator[Iterator[Result]]:
    """Yield the results of ``do`` for all ``items``, as `map` does, by ``processes``.

    One process is this one.
    """
    if processes == 1:
        yield map(do, *items)
        return
    with worker_pool(processes) as workers:
        yield _in_order(deque(workers.submit(do, *each) for each in zip(*items, strict=False)))


def _in_order(coming: deque[Future[Result]]) -> Iterator[Result]:
    """Yield the results of ``coming``, each of which is then dropped.

    The `map` of a pool cancels what is coming after an error. Where the processes have ended
    before the pool is shut down, its thread fails at a cancelled one: in Python 3.11 with a
    traceback.
    """
    while coming:
        yield wait_for(coming.popleft(), "a worker's task")


def _prepare_worker(scratch: str) -> None:
    """Write temporary files into ``scratch``; the first process alone decides on Ctrl-C."""
    tempfile.tempdir = scratch
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent()
    keep_memory()


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Hold Ctrl-C back in this thread; a process that is started meanwhile never hears it.

    Windows has no such masks: there a worker hears it until `_prepare_worker` has run.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    with _handlers_held_back():
        # It changes the mask itself, once.
        resource_tracker.ensure_running()
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _handlers_held_back() -> Iterator[None]:
    """Call the handlers of Ctrl-C and SIGTERM afterwards, for the first of them that comes.

    A mask is of one thread. Python calls a handler here for a signal that another thread has
    taken, as one of a numerical library: a process that has been started, but not been given its
    task, would print a traceback.
    """
    if current_thread() is not main_thread():
        yield
        return
    heard: list[int] = []
    before: dict[int, Callable[[int, FrameType | None], Any]] = {}
    try:
        for number in (signal.SIGINT, signal.SIGTERM):
            handler = signal.getsignal(number)
            if callable(handler):
                before[number] = handler
                signal.signal(number, lambda number, _: heard.append(number))
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)
        if heard:
            before[heard[0]](heard[0], None)
