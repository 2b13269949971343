"""What tasks return, until the summary is made of it: no shared disk has to show it in time."""

import json
import os
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO

from floatref.batch.job import Job
from floatref.batch.record import Record
from floatref.batch.record_files import as_document, of_document
from floatref.errors import InputError


class Returned:
    """Records in a file that has no name, by the names of their jobs."""

    def __init__(self, stream: IO[bytes], out: Path) -> None:
        """Keep them in ``stream``, an empty file to write and read on the disk of ``out``."""
        self._stream, self._out = stream, out
        self._places: dict[str, tuple[int, int]] = {}

    def add(self, record: Record) -> None:
        """Keep ``record``, of which ``skipped`` is forgotten; InputError if there is no space."""
        content = zlib.compress(json.dumps(as_document(record)).encode("ascii"), level=1)
        with _space(self._out):
            self._places[record.name] = (self._stream.seek(0, os.SEEK_END), len(content))
            self._stream.write(content)
            self._stream.flush()

    def of(self, jobs: Iterable[Job]) -> Iterator[Record]:
        """Yield the record of every one of ``jobs``, all of which were added, in their order."""
        for job in jobs:
            start, size = self._places[job.name]
            self._stream.seek(start)
            yield of_document(json.loads(zlib.decompress(self._stream.read(size))))


@contextmanager
def returned_records(out: Path) -> Iterator[Returned]:
    """Yield a place for records on the disk of the folder ``out``, of which nothing is left.

    Raises InputError if it cannot be made.
    """
    with _space(out):
        stream = TemporaryFile(prefix=".floatref-", dir=out)  # noqa: SIM115
    try:
        yield Returned(stream, out)
    finally:
        # What there was no space for would be refused once more.
        with suppress(OSError):
            stream.close()


@contextmanager
def _space(out: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"{out}: cannot be written ({reason}); free space there, and go on with --resume"
        ) from error
