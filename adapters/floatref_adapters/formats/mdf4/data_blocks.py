"""The records of an MDF 4 data group, piece by piece, from blocks that may be compressed.

A compressed block is expanded by as many bytes as it says and not one more, and only if so many
can come of what it holds: a small file cannot fill the memory.
"""

import struct
from collections.abc import Iterable, Iterator
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from floatref import InputError
from floatref_adapters.formats.mdf4.block_links import read_block
from floatref_adapters.formats.mdf4.expansion import Part, expanded

Bytes = NDArray[np.uint8]
LARGEST_PART = 1 << 28
"""Most bytes of one compressed block when expanded."""
MOST_EXPANDED = 1032
"""By how much deflate can compress at most; other methods are held to it too."""
READ_BYTES = 1 << 22


def parts_of(file: BinaryIO, address: int, size: int) -> list[Part]:
    """Return the parts of the data that begin at ``address``, 0 if there are none.

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
            parts.extend(_listed(file, block.links[1:], size))
            address = block.links[0] if block.links else 0
        else:
            return [*parts, *_listed(file, (address,), size)]
    return parts


def _listed(file: BinaryIO, addresses: Iterable[int], size: int) -> Iterator[Part]:
    for address in addresses:
        if not address or address + 24 > size:
            return
        block = read_block(file, address, size)
        if block.kind in (b"##DT", b"##DV"):
            start = address + 24
            there = min(block.length - 24, size - start)
            yield Part(start, there, there)
        elif block.kind == b"##DZ":
            yield from _compressed(file, address, size)
        else:
            name = block.kind.decode("latin-1")[2:]
            raise InputError(
                f"block {name} at byte {address} holds no records that can be read; "
                "save the file as MDF 4.10"
            )


def _compressed(file: BinaryIO, address: int, size: int) -> Iterator[Part]:
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


def pieces_of(file: BinaryIO, parts: Iterable[Part]) -> Iterator[bytes]:
    """Yield the bytes of ``parts`` in order, at most one part or 4 MiB together."""
    for part in parts:
        if part.method is not None:
            file.seek(part.address)
            yield expanded(part, file.read(part.stored))
            continue
        for start in range(0, part.bytes, READ_BYTES):
            file.seek(part.address + start)
            yield file.read(min(READ_BYTES, part.bytes - start))


def rows_of(pieces: Iterable[bytes], width: int, rows: int) -> Iterator[Bytes]:
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
