"""The tape: blocks that are read again, in memory if they are few, else on disk."""

import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from errno import ENOSPC
from os import strerror
from tempfile import TemporaryFile, gettempdir
from types import TracebackType
from typing import IO, TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.intake.freed_memory import return_freed
from floatref.intake.kept_blocks import KeptBlocks
from floatref.values.arrays import FloatArray
from floatref.values.block import Block, Event
from floatref.values.channels import ChannelId

IN_MEMORY = 64 * 2**20
"""Bytes of samples up to which a tape is in memory; a longer one is on disk."""

M = TypeVar("M", np.bool_, np.uint8)
Packed = Mapping[ChannelId, bytes]


class Tape:
    """Blocks in order: as they are up to `IN_MEMORY`, then all of them on disk, masks packed."""

    def __init__(self) -> None:
        """Begin with an empty tape."""
        self._few: KeptBlocks | None = KeptBlocks()
        self._bytes = 0
        self._files: dict[ChannelId, IO[bytes]] = {}
        self._latest: tuple[int, Mapping[ChannelId, FloatArray]] = -1, {}
        self._index: list[tuple[int, int, int]] = []
        self._masks: list[tuple[Packed, Packed, tuple[Event, ...]]] = []
        self._length = 0

    def __enter__(self) -> "Tape":
        """Use the tape; its files are removed at the end."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        """Remove the files."""
        self._few = None
        for file in self._files.values():
            file.close()

    def __len__(self) -> int:
        """Return the number of blocks."""
        return len(self._index) if self._few is None else len(self._few)

    def append(self, block: Block) -> None:
        """Write ``block`` at the end."""
        if self._few is not None:
            self._few.append(block)
            self._bytes += 8 * len(block) * len(block.values)
            if self._bytes > IN_MEMORY:
                self._to_disk(self._few)
            return
        self._index.append((block.first, self._length, len(block)))
        self._masks.append(({}, {}, ()))
        self._length += len(block)
        self.rewrite(len(self._index) - 1, block)

    def rewrite(self, number: int, block: Block) -> None:
        """Write ``block``, of the same length, in place of block ``number``.

        A channel that has not changed since this block was read is not written again: on a long run
        that is a sixth of all writing.
        """
        if self._few is not None:
            self._few.rewrite(number, block)
            return
        _, start, length = self._index[number]
        if len(block) != length:
            raise ValueError(f"block {number} holds {length} samples, not {len(block)}")
        latest, read = self._latest
        for channel, values in block.values.items():
            if latest == number and read.get(channel) is values:
                continue
            if channel not in self._files:
                self._files[channel] = _open()
            _write(self._files[channel], 8 * start, values)
        self._masks[number] = (_pack(block.fresh), _pack(block.flags), block.events)

    def read(self, number: int) -> Block:
        """Return block ``number``."""
        if self._few is not None:
            return self._few.read(number)
        first, start, length = self._index[number]
        values = {}
        for channel, file in self._files.items():
            file.seek(8 * start)
            values[channel] = np.frombuffer(file.read(8 * length))
        self._latest = number, values
        fresh, flags, events = self._masks[number]
        return Block(first, values, _unpack(fresh, np.bool_), _unpack(flags, np.uint8), events)

    def forward(self) -> Iterator[Block]:
        """Yield all blocks, the first one first."""
        for number in range(len(self)):
            yield self.read(number)

    def turn(self) -> None:
        """Know that all is written, and with it done what came before.

        Of a run on disk so much has passed that its memory is worth the system's time.
        """
        if self._few is None:
            return_freed()

    def _to_disk(self, few: KeptBlocks) -> None:
        self._few = None
        for block in few.forward():
            self.append(block)


def _write(file: IO[bytes], at: int, values: FloatArray) -> None:
    with _room():
        file.seek(at)
        data = np.ascontiguousarray(values).data
        if file.write(data) < data.nbytes:
            raise OSError(ENOSPC, strerror(ENOSPC))


@contextmanager
def _room() -> Iterator[None]:
    """Name the full folder in an error."""
    try:
        yield
    except OSError as error:
        raise InputError(
            f"{gettempdir()}: the run does not fit ({error.strerror}); free space there, or name "
            "another folder in the environment variable TMPDIR"
        ) from error


def _open() -> IO[bytes]:
    # Without a buffer: whole blocks are written and read.
    with _room():
        return TemporaryFile(buffering=0)


def _pack(masks: Mapping[ChannelId, NDArray[M]]) -> Packed:
    return {channel: zlib.compress(mask.tobytes(), 1) for channel, mask in masks.items()}


def _unpack(packed: Packed, kind: type[M]) -> dict[ChannelId, NDArray[M]]:
    return {c: np.frombuffer(zlib.decompress(data), kind) for c, data in packed.items()}
