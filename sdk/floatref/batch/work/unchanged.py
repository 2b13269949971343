"""Whether the previous result of a file is still valid."""

import os
from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

from floatref.batch.jobs.defaults import files_of
from floatref.batch.jobs.job import Job
from floatref.batch.results.record import Record
from floatref.engine.automatic import resolve_named_or_best
from floatref.errors import FloatrefError, InputError
from floatref.files import fingerprint_native
from floatref.files.document import plain
from floatref.files.fingerprint import sha256
from floatref.files.recording_directory import DOCUMENT
from floatref.files.sources import real_path
from floatref.mapping.channel_map.map_document import read_map
from floatref.version import __version__

LIBRARIES = ("numpy", "numba", "scipy")
"""Libraries whose other versions may round differently."""


def versions() -> dict[str, str]:
    """Return the versions of floatref and of the libraries that it computes with."""
    return {"floatref": __version__, **{name: version(name) for name in LIBRARIES}}


def list_what_matters(job: Job) -> dict[str, Any]:
    """Return all that the profile of ``job`` depends on besides the content of its inputs."""
    described: dict[str, Any] = plain(
        {
            "source": str(real_path(job.source)),
            "adapter": job.adapter,
            "map": None if job.channel_map is None else str(job.channel_map),
            "pipeline": job.pipeline,
            "settings": job.settings,
            "resolved": _resolve(job),
            "versions": versions(),
        },
        "job",
    )
    return described


def holds(record: Record, job: Job) -> bool:
    """Return whether ``record`` and its profile are those of ``job``, unchanged.

    The length of segments may differ. A failed record is never valid.
    """
    if record.error or not record.outputs or record.key.get("asked") != list_what_matters(job):
        return False
    outputs = {job.profile / name: value for name, value in record.outputs.items()}
    inputs = {Path(path): value for path, value in record.inputs.items()}
    return _are(outputs) and _are(inputs) and _has_no_more(job.source, inputs)


def _resolve(job: Job) -> dict[str, Any]:
    """Return all settings before the recording decides any; empty if they cannot be used."""
    try:
        return resolve_named_or_best(job.pipeline, job.settings)
    except FloatrefError:
        return {}


def _are(files: Mapping[Path, str]) -> bool:
    try:
        return all(sha256(path) == value for path, value in files.items())
    except FloatrefError:
        return False


def _has_no_more(source: Path, inputs: Mapping[Path, str]) -> bool:
    """Return whether the native folder ``source`` has no file that is not among ``inputs``."""
    if not source.is_dir() or real_path(source) / DOCUMENT in inputs:
        return True
    return {real_path(source) / name for name in fingerprint_native(source)} <= set(inputs)


Stamps = Mapping[str, tuple[int, ...]]
"""Size, time of the last change and number of files on their disk, by resolved path."""


def stamps_of(job: Job) -> Stamps:
    """Return the stamps of the files of ``job``; InputError for a map that cannot be used."""
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
    """Return the stamp of the file ``path``, empty if it does not exist."""
    try:
        found = os.stat(path)
    except OSError:
        return ()
    return found.st_size, found.st_mtime_ns, found.st_ino
