"""MDF 4 files opened with asammdf, once it is sure that it will come to an end with them."""

import contextlib
import gc
import io
import logging
import shutil
import struct
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from floatref import InputError, open_bytes, scratch_folder
from floatref_adapters.formats.mdf4.block_links import check_links, read_block
from floatref_adapters.formats.mdf4.data_blocks import Part, expand, find_parts
from floatref_adapters.shared.refusals import library

MAGIC = (b"MDF     ", b"UnFinMF ")
LAST_LENGTHS = 0b10100
"""Flags of an unfinished file: the length of the last data block or list was not written."""
SPARE = 1 << 28
"""Bytes of the disk that must remain free beside a copy."""
BLOCK = 1 << 20
RECORD_IDS = 56
"""Where a data group says how many bytes tell its records apart, after four links."""


@dataclass(frozen=True, eq=False)
class OpenedMdf:
    """An opened file: asammdf's ``mdf``, and the file ``records`` that its addresses are of.

    Of an unfinished recording that is a copy of ``source``, which asammdf has finished; `close`
    removes it.
    """

    source: Path
    mdf: Any
    records: Path
    unfinished: bool
    close: Callable[[], None]


def open_mdf(source: Path) -> OpenedMdf:
    """Return ``source``, opened by asammdf; InputError in one line if it is damaged.

    Raises it as well if the disk of temporary files has no room for the copy that is needed.
    """
    MDF = library("asammdf", "reading MDF4").MDF
    with ExitStack() as stack:
        stream: Any = stack.enter_context(open_bytes(source))
        try:
            unfinished = _check(stream, stream.seek(0, 2))
        except OSError as error:
            # An address beyond what any file can have.
            raise InputError(f"{first_line(error)}; the file is damaged, copy it again") from error
        folder, records = None, source
        if unfinished:
            folder = stack.enter_context(scratch_folder("mdf4"))
            records = folder / "records.mf4"
            _copy(stream, records)
            stream = stack.enter_context(records.open("rb+"))
        mdf = _open(MDF, stream, folder)
        stack.callback(_close, mdf)
        close = stack.pop_all().close
    return OpenedMdf(source, mdf, records, unfinished, close)


def _copy(stream: BinaryIO, copy: Path) -> None:
    """Copy the file; InputError if its disk has no room for that."""
    size = stream.seek(0, 2)
    stream.seek(0)
    try:
        free = shutil.disk_usage(copy.parent).free - SPARE
        if size > free:
            raise InputError(
                f"it was not finished, and a copy of it needs {size / 1e9:.1f} GB on disk for a "
                f"while; {copy.parent.parent} has {max(free, 0) / 1e9:.1f} GB; set TMPDIR to a "
                "folder with more"
            )
        with copy.open("wb") as out:
            shutil.copyfileobj(stream, out, BLOCK)
    except OSError as error:
        raise InputError(f"its copy: {error.strerror}; set TMPDIR to a disk with room") from error


def _open(MDF: Any, stream: BinaryIO, folder: Path | None) -> Any:
    fault = ""
    stream.seek(0)
    with quiet():
        try:
            return MDF(
                stream,
                temporary_folder=str(folder) if folder else None,
                process_bus_logging=False,
                add_array_components=False,
            )
        except Exception as error:
            fault = f"asammdf cannot read it ({first_line(error)}); copy the complete file"
        # What asammdf had opened complains when it is deleted: here, and unheard.
        gc.collect()
    raise InputError(fault)


def _close(mdf: Any) -> None:
    with quiet():
        mdf.close()


def first_line(error: Exception) -> str:
    """Return what ``error`` says, on one line of moderate length."""
    return (" ".join(str(error).split()) or type(error).__name__)[:120]


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Keep asammdf from printing, logging and warning."""
    log, hook = logging.getLogger("asammdf"), sys.unraisablehook
    was, log.disabled, sys.unraisablehook = log.disabled, True, lambda _: None
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("ignore")
            yield
    finally:
        log.disabled, sys.unraisablehook = was, hook


def _check(file: BinaryIO, size: int) -> bool:
    """Return whether ``file`` was not finished; InputError if asammdf would not end with it."""
    file.seek(0)
    start = file.read(64)
    version = start[8:16].decode("latin-1").strip(" \0")
    if len(start) < 64 or start[:8] not in MAGIC:
        raise InputError("not an MDF file; copy the complete file")
    if not version.startswith("4"):
        raise InputError(f"MDF version {version[:8]!r}; save it as MDF 4.10")
    (unfinished,) = struct.unpack_from("<H", start, 60)
    for address in check_links(file, size):
        links = read_block(file, address, size).links
        data = links[2] if len(links) > 2 else 0
        # The length of the only data block may not be known yet: asammdf finds it.
        if unfinished & LAST_LENGTHS and data and _one_block(file, data, size):
            continue
        parts = find_parts(file, data, size)
        file.seek(address + RECORD_IDS)
        if unfinished or file.read(1) not in (b"", b"\0"):
            _check_expansion(file, parts)
    # asammdf finishes files of these versions, in place.
    return bool(unfinished) and version >= "4.10"


def _one_block(file: BinaryIO, address: int, size: int) -> bool:
    """Tell whether the data is one block; InputError for several lists: asammdf loses its way."""
    file.seek(address)
    if file.read(4) == b"##DT":
        return True
    block = read_block(file, address, size)
    if block.kind == b"##HL" and block.links:
        block = read_block(file, block.links[0], size)
    if block.kind == b"##DL" and any(block.links[:1]):
        raise InputError("the recording was not finished; finish it with the maker's own program")
    return False


def _check_expansion(file: BinaryIO, parts: Iterable[Part]) -> None:
    """Raise InputError for records that expand to more than they say.

    asammdf itself expands those it has to sort, or of unfinished files, whatever there is.
    """
    for part in parts:
        if part.method is not None:
            file.seek(part.address)
            expand(part, file.read(part.stored))
