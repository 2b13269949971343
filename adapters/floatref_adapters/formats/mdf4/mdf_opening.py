"""MDF 4 files opened with asammdf, once it is sure that it will come to an end with them."""

import contextlib
import gc
import io
import logging
import struct
import sys
import warnings
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, BinaryIO

from floatref import InputError
from floatref_adapters.formats.mdf4.block_links import check_links, read_block
from floatref_adapters.formats.mdf4.data_blocks import Part, expand, find_parts
from floatref_adapters.shared.refusals import library

MAGIC = (b"MDF     ", b"UnFinMF ")
LAST_LENGTHS = 0b10100
"""Flags of an unfinished file: the length of the last data block or list was not written."""
RECORD_IDS = 56
"""Where a data group says how many bytes tell its records apart, after four links."""


def open_mdf(source: Path) -> Any:
    """Return asammdf's MDF of ``source``; InputError in one line if it is damaged."""
    with source.open("rb") as file:
        _check(file, source.stat().st_size)
    MDF = library("asammdf", "reading MDF4").MDF
    with quiet():
        fault = ""
        try:
            options: Any = {"process_bus_logging": False, "add_array_components": False}
            return MDF(source, **options)
        except Exception as error:
            fault = f"asammdf cannot read it ({first_line(error)}); copy the complete file"
        # What asammdf had opened complains when it is deleted: here, and unheard.
        gc.collect()
    raise InputError(fault)


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


def _check(file: BinaryIO, size: int) -> None:
    """Raise InputError unless asammdf will end with ``file``, and within its size."""
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
