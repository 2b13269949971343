"""TDMS files opened, once it is sure that npTDMS will come to an end with them."""

import contextlib
import io
import os
import struct
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from floatref import InputError, open_bytes
from floatref_adapters.formats.tdms.tdms_objects import Contents, read_contents
from floatref_adapters.shared.refusals import library

MAGIC = b"TDSm"
LEAD_IN = 28
BIG_ENDIAN = 1 << 6
"""Flag of a segment."""
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


@contextlib.contextmanager
def open_guarded(source: Path) -> Iterator[Guarded]:
    """Open ``source``; InputError if it is no chain of segments.

    An index file beside it is left alone: it may belong to another version of the file, and
    then values would be read from where they are not.
    """
    library("nptdms", "reading TDMS")
    with open_bytes(source) as stream:
        file = Guarded(stream.raw)
        for _ in _read_leads(file):
            pass
        file.seek(0)
        yield file


def read_metadata(source: Path) -> Contents:
    """Return what ``source`` says of its channels; InputError in one line if it is damaged."""
    with open_guarded(source) as file, quiet():
        try:
            return read_contents(file, _read_leads(file))
        except InputError:
            raise
        except Exception as error:
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


def _read_leads(file: BinaryIO) -> Iterator[tuple[int, int, int, int, bool]]:
    """Yield position, kind, end and start of the values of each segment, and if it is cut off.

    The file is then where the metadata begin. InputError unless ``file`` is a chain of segments.
    """
    size = file.seek(0, os.SEEK_END)
    position = segments = 0
    while position + LEAD_IN <= size:
        file.seek(position)
        lead = file.read(LEAD_IN)
        tag, kind = struct.unpack_from("<4sl", lead)
        length, metadata = struct.unpack_from(">QQ" if kind & BIG_ENDIAN else "<QQ", lead, 12)
        if tag != MAGIC:
            raise InputError(
                f"no segment where one has to be, at byte {position}; copy the complete file"
            )
        end, values = position + LEAD_IN + length, position + LEAD_IN + metadata
        if end > size and values > size:
            break
        yield position, kind, min(end, size), values, end > size
        position, segments = end, segments + 1
        if segments > MOST_SEGMENTS:
            raise InputError(f"more than {MOST_SEGMENTS} segments; defragment the file")
    if not size >= LEAD_IN:
        raise InputError("not a TDMS file; copy the complete file")
    if not segments:
        raise InputError("cut off before the first value of its first segment; copy it again")
