"""The engine's tape: a whole stream, kept for a stage that has to see it again."""

import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from tempfile import SpooledTemporaryFile, gettempdir
from types import TracebackType
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.block import Block, Event
from floatref.values.channels import ChannelId

IN_MEMORY = 64 * 2**20
"""Bytes of samples up to which a tape stays in memory; beyond, it is on disk."""

M = TypeVar("M", np.bool_, np.uint8)
Packed = Mapping[ChannelId, bytes]


class Tape:
    """Blocks in order, with samples spooled to disk and masks packed."""

    def __init__(self) -> None:
        """Begin with an empty tape."""
        self._spools: dict[ChannelId, SpooledTemporaryFile[bytes]] = {}
        self._index: list[tuple[int, int, int]] = []
        self._masks: list[tuple[Packed, Packed, tuple[Event, ...]]] = []
        self._length = 0

    def __enter__(self) -> "Tape":
        """Use the tape; its files are gone afterwards."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        """Remove the files."""
        for spool in self._spools.values():
            spool.close()

    def __len__(self) -> int:
        """Return the number of blocks."""
        return len(self._index)

    def append(self, block: Block) -> None:
        """Write ``block`` at the end."""
        self._index.append((block.first, self._length, len(block)))
        self._masks.append(({}, {}, ()))
        self._length += len(block)
        self.rewrite(len(self._index) - 1, block)

    def rewrite(self, number: int, block: Block) -> None:
        """Write ``block``, of the same length, in place of block ``number``."""
        _, start, length = self._index[number]
        if len(block) != length:
            raise ValueError(f"block {number} holds {length} samples, not {len(block)}")
        for channel, values in block.values.items():
            if channel not in self._spools:
                self._spools[channel] = _spool()
            _write(self._spools[channel], 8 * start, values)
        if 8 * self._length * len(self._spools) > IN_MEMORY:
            self._to_disk()
        self._masks[number] = (_pack(block.fresh), _pack(block.flags), block.events)

    def read(self, number: int) -> Block:
        """Return block ``number``."""
        first, start, length = self._index[number]
        values = {}
        for channel, spool in self._spools.items():
            spool.seek(8 * start)
            values[channel] = np.frombuffer(spool.read(8 * length))
        fresh, flags, events = self._masks[number]
        return Block(first, values, _unpack(fresh, np.bool_), _unpack(flags, np.uint8), events)

    def forward(self) -> Iterator[Block]:
        """Yield all blocks, the first one first."""
        for number in range(len(self)):
            yield self.read(number)

    def _to_disk(self) -> None:
        with _room():
            for spool in self._spools.values():
                spool.rollover()


def _write(spool: SpooledTemporaryFile[bytes], at: int, values: FloatArray) -> None:
    with _room():
        spool.seek(at)
        spool.write(np.ascontiguousarray(values).data)


@contextmanager
def _room() -> Iterator[None]:
    """Name the folder that is full."""
    try:
        yield
    except OSError as error:
        raise InputError(
            f"{gettempdir()}: the run does not fit ({error.strerror}); free space there, or name "
            "another folder in the environment variable TMPDIR"
        ) from error


def _spool() -> SpooledTemporaryFile[bytes]:
    # Without a size of its own: the tape decides for all channels together.
    return SpooledTemporaryFile()


def _pack(masks: Mapping[ChannelId, NDArray[M]]) -> Packed:
    return {channel: zlib.compress(mask.tobytes(), 1) for channel, mask in masks.items()}


def _unpack(packed: Packed, kind: type[M]) -> dict[ChannelId, NDArray[M]]:
    return {c: np.frombuffer(zlib.decompress(data), kind) for c, data in packed.items()}
