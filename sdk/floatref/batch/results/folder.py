"""The output folder of a batch: whose it is, one command at a time, and no leftovers."""

import os
import shutil
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic, sleep

from floatref.batch.jobs.job import PROFILES, RECORDS, Job
from floatref.batch.jobs.natural_order import natural_key
from floatref.errors import InputError

LOCK, WORKING = ".lock", ".working"
"""Locked by the command while it runs, and by every task while it works."""

LOCKED_S = 60.0
"""Longest time in s that a task waits for the lock of another program."""

OURS = frozenset({PROFILES, RECORDS, LOCK, WORKING, "summary.csv", "summary.parquet", "batch.json"})
BESIDE = ".floatref-*"
"""Pattern of the names of incomplete files."""


@contextmanager
def prepare_folder(out: Path, resume: bool, patience_s: float = 60.0) -> Iterator[None]:
    """Make folder ``out`` ready for this command alone; leave nothing if no task began in it.

    Raises InputError for a folder with content unless ``resume``, for one that no batch has
    written, while another command works in it, and if tasks of a killed command still work there
    after ``patience_s`` seconds.
    """
    made = _make(out, resume)
    with _lock(out / LOCK) as alone:
        if not alone:
            raise InputError(f"{out}: another batch works there; wait for it or choose another")
        try:
            _wait_for_tasks(out, patience_s)
            for folder in (out / PROFILES, out / RECORDS):
                folder.mkdir(exist_ok=True)
            sweep(out)
            yield
        finally:
            _tidy(out, made)


@contextmanager
def mark_working(out: Path) -> Iterator[None]:
    """Mark, for other commands, that a task works in ``out``; many may do so at once."""
    with _lock(out / WORKING, shared=True) as shared:
        if not shared:
            raise InputError(
                f"{out / WORKING}: locked by another program for {LOCKED_S:g} s; end that"
            )
        yield


def is_worked_in(out: Path) -> bool:
    """Return whether a task works in ``out``; True also where the file system has no locks."""
    try:
        import fcntl

        handle = os.open(out / WORKING, os.O_RDWR | os.O_CLOEXEC)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        finally:
            os.close(handle)
    except FileNotFoundError:
        return False
    except (ImportError, OSError):
        return True
    return False


def sweep(out: Path) -> None:
    """Remove incomplete files of killed tasks from ``out``."""
    for place in (out, out / PROFILES, out / RECORDS):
        for path in place.glob(BESIDE) if place == out else list(place.rglob(BESIDE)):
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)


def not_given(out: Path, jobs: Iterable[Job]) -> tuple[str, ...]:
    """Return the names of records in ``out`` that belong to no job of ``jobs``."""
    given = {job.name for job in jobs}
    records = out / RECORDS
    found = (path.relative_to(records).as_posix() for path in records.rglob("*.json"))
    others = {name.removesuffix(".json") for name in found} - given
    return tuple(sorted(others, key=natural_key))


def count_recorded(jobs: Iterable[Job]) -> int:
    """Return the number of ``jobs`` that have a record, of this or of an earlier command."""
    return sum(os.path.isfile(job.record) for job in jobs)


def _make(out: Path, resume: bool) -> bool:
    """Make ``out`` if it is missing, and return whether it was."""
    with suppress(FileExistsError):
        try:
            out.mkdir()
        except FileNotFoundError as error:
            raise InputError(
                f"{out}: its folder does not exist; make {out.parent} first"
            ) from error
        return True
    if not out.is_dir():
        raise InputError(f"{out}: is not a folder; give the name of a folder to write")
    names = set(os.listdir(out)) - {LOCK, WORKING}
    if names and not resume:
        raise InputError(f"{out}: is not empty; choose another folder, or go on with --resume")
    if names and not names & OURS:
        raise InputError(f"{out}: holds other files and no batch; choose another folder")
    return False


def _wait_for_tasks(out: Path, patience_s: float) -> None:
    """Wait until no task of a command that was killed works in ``out`` any more."""
    end = monotonic() + patience_s
    while True:
        with _lock(out / WORKING) as idle:
            if idle:
                return
        if monotonic() > end:
            raise InputError(
                f"{out}: workers still process files there for a command that was killed; "
                "wait for them or end them"
            )
        sleep(0.1)


@contextmanager
def _lock(path: Path, shared: bool = False) -> Iterator[bool]:
    """Lock the file ``path`` if it is free, and yield whether it was.

    A lock ends with its process in any case. Where the file system has no locks, every
    file is free. A lock that is ``shared`` is waited for: others try the lock for a moment.
    """
    try:
        import fcntl
    except ImportError:
        yield True
        return
    handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
    try:
        kind = (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB
        end_s = monotonic() + (LOCKED_S if shared else 0.0)
        while not (free := _free(lambda: fcntl.flock(handle, kind))) and monotonic() < end_s:
            sleep(0.01)
        yield free
    finally:
        os.close(handle)


def _free(lock: Callable[[], None]) -> bool:
    try:
        lock()
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True


def _tidy(out: Path, made: bool) -> None:
    """Remove folders that nothing was written into, and ``out`` itself if we ``made`` it."""
    for folder in (out / PROFILES, out / RECORDS):
        with suppress(OSError):
            folder.rmdir()
    if made and set(os.listdir(out)) <= {LOCK, WORKING}:
        shutil.rmtree(out)
