"""Whether files stay as they are while they are read: one that is still copied does not."""

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from floatref.batch.defaults import files_of
from floatref.batch.job import Job
from floatref.errors import InputError
from floatref.files.recording import DOCUMENT
from floatref.mapping.document import read_map

Stamps = Mapping[str, tuple[int, ...]]
"""Size, time of the last change and number of files on their disk, by what they really are."""


def stamps_of(job: Job) -> Stamps:
    """Return the stamps of what ``job`` may read; InputError for a map that cannot be used."""
    return {os.path.realpath(path): found for path in _read_by(job) if (found := _stamp(path))}


def check_unchanged(before: Stamps, paths: Iterable[Path]) -> None:
    """Raise InputError if one of ``paths``, which were read, has another stamp than ``before``."""
    for path in paths:
        real = os.path.realpath(path)
        if real in before and _stamp(real) != before[real]:
            raise InputError(
                f"{path}: changed while it was read; go on with --resume once it is complete"
            )


def _read_by(job: Job) -> Iterator[str | os.PathLike[str]]:
    folder = job.source.parent if job.source.name == DOCUMENT else job.source
    yield from folder.iterdir() if folder.is_dir() else [job.source]
    if job.channel_map is not None:
        yield from files_of(read_map(job.channel_map))


def _stamp(path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the stamp of the file ``path``, empty if there is none."""
    try:
        found = os.stat(path)
    except OSError:
        return ()
    return found.st_size, found.st_mtime_ns, found.st_ino
