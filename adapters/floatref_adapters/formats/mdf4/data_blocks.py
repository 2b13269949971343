"""The records of an MDF 4 data group, piece by piece, from blocks that may be compressed.

By hand, for asammdf 8.8 does not stream: `select` reads each channel of a sorted file as a whole
whatever `record_count` says (332 MB of memory for a file of 200 MB, here 162 MB), expands a block
again for every piece (35 s for one of 200 MB, here 2 s), and expands it without a limit. Here a
block gives the number of bytes that it states and no more, and only if its stored bytes can give
them: a small file cannot fill the memory.
"""

import struct
import zlib
from collections.abc import Callable, Iterable, Iterator
from typing import BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref import InputError
from floatref_adapters.formats.mdf4.block_links import read_block

Bytes = NDArray[np.uint8]
LARGEST_PART = 1 << 28
"""Most bytes of one compressed block when expanded."""
MOST_EXPANDED = 1032
"""By how much deflate can compress at most; other methods are held to it too."""
READ_BYTES = 1 << 22


DEFLATE, ZSTD, LZ4 = 0, 2, 4
"""Methods; one more is the same with the bytes of the records transposed."""


class Part(NamedTuple):
    """Bytes of a data block: where they are, and how they are compressed, None if not."""

    address: int
    stored: int
    bytes: int
    method: int | None = None
    width: int = 0


def find_parts(file: BinaryIO, address: int, size: int) -> list[Part]:
    """Return the parts of the data that begin at ``address``, 0 if there is no data.

    What lies after the end of the file is left out: the parts then hold less than was recorded.
    InputError for blocks that cannot be data, or that are linked in a ring.
    """
    parts: list[Part] = []
    seen: set[int] = set()
    while address and address + 24 <= size:
        if address in seen:
            raise InputError(
                f"the data list at byte {address} leads to itself; the file is damaged"
            )
        seen.add(address)
        block = read_block(file, address, size)
        if block.kind == b"##HL":
            address = block.links[0] if block.links else 0
        elif block.kind == b"##DL":
            parts.extend(_find_listed(file, block.links[1:], size))
            address = block.links[0] if block.links else 0
        else:
            return [*parts, *_find_listed(file, (address,), size)]
    return parts


def _find_listed(file: BinaryIO, addresses: Iterable[int], size: int) -> Iterator[Part]:
    for address in addresses:
        if not address or address + 24 > size:
            return
        block = read_block(file, address, size)
        if block.kind in (b"##DT", b"##DV"):
            start = address + 24
            there = min(block.length - 24, size - start)
            yield Part(start, there, there)
        elif block.kind == b"##DZ":
            yield from _find_compressed(file, address, size)
        else:
            name = block.kind.decode("latin-1")[2:]
            raise InputError(
                f"block {name} at byte {address} holds no records that can be read; "
                "save the file as MDF 4.10"
            )


def _find_compressed(file: BinaryIO, address: int, size: int) -> Iterator[Part]:
    file.seek(address + 26)
    head = file.read(22)
    if len(head) < 22:
        return
    method, width, count, stored = struct.unpack("<BxIQQ", head)
    if count > min(LARGEST_PART, 64 + MOST_EXPANDED * stored):
        raise InputError(
            f"the compressed block at byte {address} says it holds {count} bytes; "
            "the file is damaged"
        )
    if address + 48 + stored <= size:
        yield Part(address + 48, stored, count, method, width)


def read_parts(file: BinaryIO, parts: Iterable[Part]) -> Iterator[bytes]:
    """Yield the bytes of ``parts`` in order, at most one part or 4 MiB together."""
    for part in parts:
        if part.method is not None:
            file.seek(part.address)
            yield expand(part, file.read(part.stored))
            continue
        for start in range(0, part.bytes, READ_BYTES):
            file.seek(part.address + start)
            yield file.read(min(READ_BYTES, part.bytes - start))


def split_records(pieces: Iterable[bytes], width: int, rows: int) -> Iterator[Bytes]:
    """Yield records of ``width`` bytes, ``rows`` together, as arrays of shape (n, ``width``).

    A record that is cut off at the end is left out.
    """
    held = bytearray()
    for piece in pieces:
        held += piece
        whole = len(held) // (width * rows) * (width * rows)
        for start in range(0, whole, width * rows):
            yield _rows(held[start : start + width * rows], width)
        del held[:whole]
    for start in range(0, len(held) - width + 1, width * rows):
        yield _rows(held[start : start + width * rows], width)


def _rows(data: bytearray, width: int) -> Bytes:
    count = len(data) // width
    return np.frombuffer(data, np.uint8, count * width).reshape(count, width)


def expand(part: Part, stored: bytes) -> bytes:
    """Return the bytes of ``part``, of which the file holds ``stored``; InputError otherwise."""
    try:
        data = _inflate(part, stored)
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{_where(part)} cannot be expanded ({error}); copy the file again") from (
            error
        )
    if len(data) != part.bytes:
        raise InputError(f"{_where(part)} does not hold {part.bytes} bytes; copy the file again")
    return _transpose(data, part.width) if part.method and part.method % 2 else data


def _where(part: Part) -> str:
    return f"the compressed block at byte {part.address - 48}"


def _inflate(part: Part, stored: bytes) -> bytes:
    method = part.method or DEFLATE
    if method & ~1 == DEFLATE:
        return _choose_inflater()(stored, part.bytes + 1)
    if method & ~1 == LZ4:
        from lz4.frame import LZ4FrameDecompressor

        whole: bytes = LZ4FrameDecompressor().decompress(stored, max_length=part.bytes + 1)
        return whole
    if method & ~1 == ZSTD and _read_zstd_size(stored) == part.bytes:
        from zstd import decompress

        data: bytes = decompress(stored)
        return data
    raise InputError(f"{_where(part)} is compressed by method {method}; save it with deflate")


def _read_zstd_size(stored: bytes) -> int | None:
    """Return what a zstd frame says it holds, to which its decoder keeps; None if it does not."""
    if stored[:4] != b"\x28\xb5\x2f\xfd":
        return None
    described = stored[4]
    single = described >> 5 & 1
    start = 5 + (not single) + (0, 1, 2, 4)[described & 3]
    size = (single, 2, 4, 8)[described >> 6]
    count = int.from_bytes(stored[start : start + size], "little")
    return count + 256 * (size == 2) if size else None


def _choose_inflater() -> Callable[[bytes, int], bytes]:
    """Return what inflates bytes up to a count; ISA-L, as in asammdf, if it is installed."""
    try:
        from isal import isal_zlib
    except ImportError:
        return zlib.decompressobj().decompress
    inflate: Callable[[bytes, int], bytes] = isal_zlib.decompressobj().decompress
    return inflate


def _transpose(data: bytes, width: int) -> bytes:
    """Return records of ``width`` bytes whose first bytes come first, then the second ones."""
    if width == 0:
        return data
    lines = len(data) // width
    square = np.frombuffer(data, np.uint8, lines * width).reshape(width, lines)
    return square.T.tobytes() + data[lines * width :]
