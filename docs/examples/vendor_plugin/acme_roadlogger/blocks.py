"""Reading the blocks of a file, and skipping damaged parts."""

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from acme_roadlogger import layout
from acme_roadlogger.layout import Header
from floatref import InputError

CHUNK = 1 << 20
"""Bytes read in one go."""
MOST_FALSE = 100_000
"""Number of false beginnings of blocks after which a file is refused."""

Counts = NDArray[np.int16] | NDArray[np.int32]
Block = tuple[int, int, Counts]
"""Channel, tick of the first sample, and counts."""


@dataclass
class Skipped:
    """The data between sound blocks: places, bytes, and bytes since the last sound block."""

    places: int = 0
    size: int = 0
    last: int = 0

    def add(self, size: int) -> None:
        """Count ``size`` more bytes of a place."""
        self.places += self.last == 0
        self.size += size
        self.last += size

    def warnings(self) -> tuple[str, ...]:
        """Return one line for damaged places, and one for a truncated end."""
        places, size, lines = self.places - (self.last > 0), self.size - self.last, []
        if places:
            lines.append(f"{places} damaged places, {size} bytes in all; samples are missing there")
        if self.last:
            lines.append(f"the last {self.last} bytes are no whole block; the file is truncated")
        return tuple(lines)


def sound_blocks(source: Path, header: Header, begin: int, skipped: Skipped) -> Iterator[Block]:
    """Yield every block from byte ``begin`` on whose check is right.

    After a damaged block the next one is found by its sync. Raises InputError for a file with
    more than `MOST_FALSE` false beginnings of blocks.
    """
    buffer, at, false = b"", 0, 0
    with source.open("rb") as stream:
        stream.seek(begin)
        while True:
            if len(buffer) - at < layout.LARGEST and (more := stream.read(CHUNK)):
                buffer, at = buffer[at:] + more, 0
            if at == len(buffer):
                return
            block = _block(buffer, at, header)
            if block is not None:
                yield block
                at, skipped.last = at + layout.AROUND + block[2].nbytes, 0
                continue
            false += 1
            if false > MOST_FALSE:
                raise InputError(f"{source}: {MOST_FALSE} damaged blocks and more; copy it again")
            behind = _next_sync(buffer, at)
            skipped.add(behind - at)
            at = behind


def _block(buffer: bytes, at: int, header: Header) -> Block | None:
    """Return the block at byte ``at``, None if there is no sound one."""
    if len(buffer) - at < layout.AROUND:
        return None
    sync, channel, count, tick = layout.BLOCK.unpack_from(buffer, at)
    if sync != layout.SYNC or channel >= len(header.channels):
        return None
    width, begin = header.channels[channel].width, at + layout.BLOCK.size
    end = begin + count * width
    if not (0 < count <= layout.MOST_SAMPLES and tick < layout.TICKS and end + 4 <= len(buffer)):
        return None
    if layout.CHECK.pack(zlib.crc32(memoryview(buffer)[at:end])) != buffer[end : end + 4]:
        return None
    return channel, tick, np.frombuffer(buffer, f"<i{width}", count, begin)


def _next_sync(buffer: bytes, at: int) -> int:
    """Return where a block may begin next; the last bytes may be those of a sync cut in two."""
    found = buffer.find(layout.SYNC, at + 1)
    return found if found >= 0 else max(at + 1, len(buffer) - len(layout.SYNC) + 1)
