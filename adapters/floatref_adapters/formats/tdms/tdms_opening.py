"""TDMS files opened with npTDMS, once it is sure that it will come to an end with them."""

import contextlib
import io
import os
import struct
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

from floatref import InputError
from floatref_adapters.formats.tdms.property_changes import Changes, watched
from floatref_adapters.shared.libraries import library

MAGIC = b"TDSm"
LEAD_IN = 28
MOST_SEGMENTS = 2_000_000
LONGEST_READ = 1 << 26
"""Most bytes of one name or text; a damaged length would fill the memory."""


class Guarded(io.BufferedReader):
    """A file of which no more is read at once than any name or text has."""

    def read(self, size: int | None = -1) -> bytes:
        """Return up to ``size`` bytes; InputError if that is more than can be meant."""
        if size is None or not 0 <= size <= LONGEST_READ:
            raise InputError(f"a text of {size} bytes; the file is damaged")
        return super().read(size)


def opened(source: Path) -> tuple[Any, Changes, BinaryIO]:
    """Return npTDMS's TdmsFile of ``source``, how properties change in it, and the file itself.

    An index file beside it is left alone: it may belong to another version of the file, and
    then values would be read from where they are not. InputError in one line if the file is
    damaged.
    """
    library("nptdms", "reading TDMS")
    file = Guarded(io.FileIO(source))
    try:
        _check(file, os.fstat(file.fileno()).st_size)
        file.seek(0)
        with quiet():
            return *watched(file), file
    except InputError:
        file.close()
        raise
    except Exception as error:
        file.close()
        fault = f"npTDMS cannot read it ({first_line(error)}); copy the complete file"
        raise InputError(fault) from error


def first_line(error: Exception) -> str:
    """Return what ``error`` says, on one line of moderate length."""
    return (" ".join(str(error).split()) or type(error).__name__)[:120]


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Keep npTDMS from logging and warning."""
    from nptdms.log import log_manager

    was = log_manager.log_level
    log_manager.set_level("CRITICAL")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        log_manager.set_level(was)


def _check(file: BinaryIO, size: int) -> None:
    """Raise InputError unless ``file`` is a chain of segments, not too many."""
    position = segments = 0
    while position + LEAD_IN <= size:
        file.seek(position)
        tag, kind, length = struct.unpack("<4sl4xQ8x", file.read(LEAD_IN))
        if kind & 1 << 6:
            (length,) = struct.unpack(">Q", struct.pack("<Q", length))
        if tag != MAGIC:
            raise InputError(
                f"no segment where one has to be, at byte {position}; copy the complete file"
            )
        position, segments = position + LEAD_IN + length, segments + 1
        if segments > MOST_SEGMENTS:
            raise InputError(f"more than {MOST_SEGMENTS} segments; defragment the file")
    if not segments:
        raise InputError("not a TDMS file; copy the complete file")
