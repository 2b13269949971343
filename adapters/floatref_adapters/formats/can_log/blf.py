"""The sound part of a Vector BLF log, as the file that python-can reads.

python-can trusts the sizes that such a file declares: a wrong one makes it loop for ever, or unpack
gigabytes. So the frames are picked out here, object by object, and handed on in containers of
their own.
"""

import struct
import zlib
from collections import Counter
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import BinaryIO

from floatref import InputError, open_bytes

HEADER = 144
SIZED = struct.Struct("<4sL")
BASE = struct.Struct("<4sHHLL")
CONTAINER = struct.Struct("<H6xL4x")
SIGNATURE = b"LOBJ"
LOG_CONTAINER = 10
STORED, DEFLATED = 0, 2
LARGEST = 1 << 24
"""Bytes of a container or an object, unpacked; Vector's have 128 KiB."""
BODIES = {1: 16, 73: 32, 86: 16, 100: 84, 101: 40}
"""Least bytes of the objects that are CAN frames, behind their header."""
HEADERS = {1: 32, 2: 40}
"""Bytes of an object's header by its version."""


class SoundBlf:
    """What python-can reads: ``read(size)`` returns the next bytes; ``faults`` counts the rest."""

    def __init__(self, source: Path, faults: Counter[str]) -> None:
        self._faults = faults
        self._pieces = self._rewrite(source)
        self._kept = b""

    def read(self, size: int) -> bytes:
        """Return the next ``size`` bytes, fewer at the end."""
        while len(self._kept) < size:
            piece = next(self._pieces, None)
            if piece is None:
                break
            self._kept += piece
        wanted, self._kept = self._kept[:size], self._kept[size:]
        return wanted

    def close(self) -> None:
        """Close the log."""
        self._pieces.close()

    def _rewrite(self, source: Path) -> Generator[bytes, None, None]:
        with open_bytes(source) as stream:
            yield _header(source, stream)
            for frames in self._frames(self._unpack(stream)):
                size = BASE.size + CONTAINER.size + len(frames)
                yield BASE.pack(SIGNATURE, BASE.size, 1, size, LOG_CONTAINER)
                yield CONTAINER.pack(STORED, len(frames)) + frames + bytes(size % 4)

    def _unpack(self, stream: BinaryIO) -> Iterator[bytes]:
        """Yield what the containers hold, b"" where one is damaged."""
        while base := stream.read(BASE.size):
            signature, _, _, size, kind = BASE.unpack(base.ljust(BASE.size, b"\0"))
            if signature != SIGNATURE or not BASE.size <= size <= LARGEST:
                self._faults["rest"] += 1
                return
            body = stream.read(size - BASE.size)
            stream.read(size % 4)
            if kind == LOG_CONTAINER:
                yield self._inflate(body)
            else:
                self._faults["event"] += 1
            if len(body) < size - BASE.size:
                self._faults["rest"] += 1

    def _inflate(self, body: bytes) -> bytes:
        if len(body) < CONTAINER.size:
            return b""
        method, _ = CONTAINER.unpack_from(body)
        packed = body[CONTAINER.size :]
        if method == STORED:
            return packed
        inflating = zlib.decompressobj()
        try:
            data = inflating.decompress(packed, LARGEST) if method == DEFLATED else b""
        except zlib.error:
            data = b""
        if not data or inflating.unconsumed_tail:
            self._faults["container"] += 1
            return b""
        return data

    def _frames(self, unpacked: Iterator[bytes]) -> Iterator[bytes]:
        """Yield the objects that are CAN frames, those of each container together."""
        rest = b""
        for data in unpacked:
            # An object that continues in a damaged container is lost with it.
            data = rest + data if data else b""
            at, frames = 0, []
            while (size := self._size(data, at)) is not None:
                at = data.index(SIGNATURE, at)
                if self._is_frame(data, at, size):
                    frames.append(data[at : at + size])
                at += size
            rest = data[at:] if data.find(SIGNATURE, at) >= 0 else data[at:][-3:]
            if len(rest) > LARGEST:
                self._faults["objects"] += 1
                rest = b""
            yield b"".join(frames)
        self._faults["objects"] += SIGNATURE in rest

    def _size(self, data: bytes, at: int) -> int | None:
        """Return the size of the object at ``at``, or just behind; None if it is not all there."""
        begin = data.find(SIGNATURE, at, at + 8)
        if begin < 0 and len(data) - at >= 8:
            begin = data.find(SIGNATURE, at)
            self._faults["objects"] += 1
        if begin < 0 or len(data) - begin < BASE.size:
            return None
        size = int(BASE.unpack_from(data, begin)[3])
        if not BASE.size <= size <= LARGEST:
            self._faults["objects"] += 1
            size = len(SIGNATURE)
        return size if begin + size <= len(data) else None

    def _is_frame(self, data: bytes, at: int, size: int) -> bool:
        if size < BASE.size:
            return False
        _, _, version, _, kind = BASE.unpack_from(data, at)
        if kind not in BODIES:
            self._faults["event"] += 1
            return False
        if size < HEADERS.get(version, LARGEST) + BODIES[kind]:
            self._faults["objects"] += 1
            return False
        return True


def _header(source: Path, stream: BinaryIO) -> bytes:
    """Return the header of the log with the size that it should have."""
    head = stream.read(HEADER)
    size = SIZED.unpack_from(head.ljust(SIZED.size, b"\0"))[1]
    if len(head) < HEADER or not 72 <= size <= 1 << 16:
        raise InputError(f"{source}: a BLF log without a sound header; copy the log again")
    stream.seek(size)
    return head[:4] + struct.pack("<L", HEADER) + head[8:]
