"""Jobs on a cluster: one task each, the largest first, and always one record for each."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from secrets import token_hex
from shutil import rmtree
from threading import Event
from typing import TYPE_CHECKING

from floatref.batch.jobs.job import Job
from floatref.batch.results.folder import mark_working
from floatref.batch.results.record import Record
from floatref.batch.work.limited_calls import call_until
from floatref.errors import FloatrefError

if TYPE_CHECKING:
    from distributed import Client, Future

Task = Callable[[Job, bool], Record]
"""Processing of one file, given whether an existing result is to be reused."""

KILLED = (
    "the worker ended {} times while it processed this file alone (out of memory?); give workers "
    "more memory, or cut the run into shorter ones"
)
STEP_S = 0.05
"""Time in s between two looks at what is done."""
LOST = "the cluster was lost before this file was done; go on with --resume"


def run_jobs(
    client: "Client",
    jobs: Sequence[Job],
    resume: bool,
    task: Task | None = None,
    lost: Event | None = None,
) -> Iterator[tuple[Job, Record]]:
    """Yield every one of ``jobs`` exactly once with its record, as they are done.

    A file whose worker died is tried on other workers, and at last alone, so that it does not fail
    through another file. ``task`` is `floatref.batch.work.task.run_job` unless given. Once the
    event ``lost`` is set, files that are not done have a record that says so.
    """
    chosen, lost = task or _run_job, lost or Event()
    ordered = sorted(jobs, key=lambda job: -job.size_bytes)
    suspects = []
    for job, future in _yield_done(client, ordered, resume, chosen, lost):
        if future is not None and _worker_died(future):
            suspects.append(job)
        else:
            yield job, _record(job, future, resume, lost)
        if future is not None:
            future.release()
    for suspect in suspects:
        for job, future in _yield_done(client, [suspect], resume, chosen, lost):
            yield job, _record(job, future, resume, lost)


def _run_job(job: Job, resume: bool) -> Record:
    from floatref.batch.work.task import run_job

    return run_job(job, resume)


def _mark(job: Job, resume: bool, task: Task) -> Record:
    """Do one task on a worker, and let other commands know that it is being done."""
    with mark_working(job.out):
        return task(job, resume)


def _yield_done(
    client: "Client", jobs: Sequence[Job], resume: bool, task: Task, lost: Event
) -> Iterator[tuple[Job, "Future[Record] | None"]]:
    """Yield every job with its future, in the order in which they are done.

    Once ``lost`` is set, each remaining job is yielded with None.
    """
    from distributed import as_completed

    run = token_hex(8)
    keys = {f"floatref-{run}-{index:09d}": job for index, job in enumerate(jobs)}
    # In one graph, which the scheduler hands out piece by piece and in this order.
    futures = client.map(_mark, jobs, key=list(keys), pure=False, resume=resume, task=task)
    waiting = as_completed(futures)
    del futures
    while not waiting.is_empty():
        if waiting.has_ready():
            future = next(waiting)
            yield keys.pop(future.key), future
        elif lost.wait(STEP_S):
            yield from ((job, None) for job in keys.values())
            return


def _worker_died(future: "Future[Record]") -> bool:
    from distributed import KilledWorker

    return future.status == "error" and isinstance(future.exception(), KilledWorker)


def _record(
    job: Job, future: "Future[Record] | None", resume: bool, lost: Event | None = None
) -> Record:
    """Return the record of the task, or a record of the reason why there is no result."""
    if future is None:
        return _read_written(job, resume) or _fail(job, LOST)
    # A result that was lost with its worker is calculated again, and waited for here.
    with suppress(Exception):
        return call_until(future.result, (lost or Event()).is_set)
    if _worker_died(future):
        return _give_up(job, KILLED.format(future.exception().args[2] + 1))
    if future.status == "error":
        error = future.exception()
        return _fail(job, f"{type(error).__name__}: {error}")
    return _read_written(job, resume) or _fail(job, LOST)


def _read_written(job: Job, resume: bool) -> Record | None:
    """Return the record that a task has written for ``job`` but not returned, or None."""
    from floatref.batch.work.task import read_valid_record

    found = read_valid_record(job)
    return found and replace(found, skipped=resume)


def _give_up(job: Job, reason: str) -> Record:
    """Return and write the record of a file for which no task could write a record."""
    from floatref.batch.results.record import write_record

    record = _fail(job, reason)
    rmtree(job.profile, ignore_errors=True)
    with suppress(FloatrefError, OSError):
        write_record(record, job.record)
    return record


def _fail(job: Job, reason: str) -> Record:
    from floatref.batch.work.task import record_failure

    return record_failure(job, " ".join(reason.split()))
