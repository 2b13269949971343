"""The engine: passes blocks through stages, forward in one go, backward over the tape."""

import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from itertools import groupby
from tempfile import SpooledTemporaryFile, gettempdir
from types import TracebackType
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from floatref.errors import FloatrefError, InputError, StageError
from floatref.intake.kept_blocks import KeptBlocks
from floatref.stages.protocol import Direction, Stage
from floatref.values.arrays import FloatArray
from floatref.values.block import Block, Event, Header
from floatref.values.channels import ChannelId
from floatref.values.innovations import Innovations

IN_MEMORY = 64 * 2**20
"""Bytes of samples up to which a tape is in memory; a longer one is on disk."""

M = TypeVar("M", np.bool_, np.uint8)
Packed = Mapping[ChannelId, bytes]
Kept = Mapping[str, Mapping[str, Innovations]]


class Tape:
    """Blocks in order, with samples spooled to disk and masks packed."""

    def __init__(self) -> None:
        """Begin with an empty tape."""
        self._spools: dict[ChannelId, SpooledTemporaryFile[bytes]] = {}
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
    """Name the full folder in an error."""
    try:
        yield
    except OSError as error:
        raise InputError(
            f"{gettempdir()}: the run does not fit ({error.strerror}); free space there, or name "
            "another folder in the environment variable TMPDIR"
        ) from error


def _spool() -> SpooledTemporaryFile[bytes]:
    # Without its own size limit: the tape decides for all channels together.
    return SpooledTemporaryFile()


def _pack(masks: Mapping[ChannelId, NDArray[M]]) -> Packed:
    return {channel: zlib.compress(mask.tobytes(), 1) for channel, mask in masks.items()}


def _unpack(packed: Packed, kind: type[M]) -> dict[ChannelId, NDArray[M]]:
    return {c: np.frombuffer(zlib.decompress(data), kind) for c, data in packed.items()}


T = TypeVar("T")


def run(
    stages: Sequence[Stage],
    header: Header,
    blocks: Iterable[Block],
    tape: type[Tape] | type[KeptBlocks] = Tape,
) -> tuple[Header, Iterator[Block]]:
    """Start all ``stages`` and return the last header and the resulting blocks.

    Nothing is processed until the blocks are read. Adjacent backward stages share one pass. What
    is read again is on a ``tape``.
    """
    for stage in stages:
        header = _guard(stage, partial(stage.start, header))
    stream = iter(blocks)
    for kind, group in groupby(stages, key=_kind):
        if kind == "forward":
            for stage in group:
                stream = _forward(stage, stream)
        elif kind == "survey":
            for stage in group:
                stream = _survey(stage, stream, tape())
        else:
            stream = _backward(tuple(group), stream, tape())
    return header, stream


def collect_warnings(stages: Sequence[Stage]) -> tuple[str, ...]:
    """Return the warnings of ``stages`` on a run, in their order, each line once."""
    lines = (line for stage in stages for line in _guard(stage, stage.warnings))
    return tuple(dict.fromkeys(lines))


def collect_estimates(stages: Sequence[Stage]) -> dict[str, float]:
    """Return the settings that ``stages`` have estimated from a run."""
    return {k: v for stage in stages for k, v in _guard(stage, stage.list_learned).items()}


def keep_innovations(stages: Sequence[Stage], pipeline: str) -> None:
    """Ask the ``stages`` of ``pipeline`` that have innovations to keep them, before their start.

    Raises InputError if no stage has any.
    """
    filters = [stage for stage in stages if stage.has_innovations]
    if not filters:
        raise InputError(
            f"pipeline {pipeline}: has no filter with innovations to diagnose; those named "
            "kalman-… and road-prior-… have one"
        )
    for stage in filters:
        _guard(stage, stage.keep_innovations)


def collect_innovations(stages: Sequence[Stage]) -> Kept:
    """Return the innovations that ``stages`` have kept, by wheel path and kind of reading."""
    found: dict[str, dict[str, Innovations]] = {}
    for stage in stages:
        for track, kinds in _guard(stage, stage.list_innovations).items():
            found.setdefault(track, {}).update(kinds)
    return found


def _kind(stage: Stage) -> str:
    if stage.direction is Direction.BACKWARD:
        return "backward"
    return "survey" if stage.surveys else "forward"


def _forward(stage: Stage, blocks: Iterator[Block]) -> Iterator[Block]:
    for block in blocks:
        out = _guard(stage, partial(stage.push, block))
        if len(out):
            yield out
    yield from (block for block in _guard(stage, stage.finish) if len(block))


def _survey(stage: Stage, blocks: Iterator[Block], kept: Tape | KeptBlocks) -> Iterator[Block]:
    with kept as tape:
        for block in blocks:
            _guard(stage, partial(stage.survey, block))
            tape.append(block)
        yield from _forward(stage, tape.forward())


def _backward(
    stages: Sequence[Stage], blocks: Iterator[Block], kept: Tape | KeptBlocks
) -> Iterator[Block]:
    with kept as tape:
        for block in blocks:
            tape.append(block)
        for number in reversed(range(len(tape))):
            tape.rewrite(number, _through(stages, tape.read(number)))
        for stage in stages:
            _guard(stage, stage.finish)
        yield from tape.forward()


def _through(stages: Sequence[Stage], block: Block) -> Block:
    length = len(block)
    for stage in stages:
        block = _guard(stage, partial(stage.push, block))
        if len(block) != length:
            raise StageError(f"stage {stage.name}: a backward stage must keep its block's length")
    return block


def _guard(stage: Stage, call: Callable[[], T]) -> T:
    """Name the stage in every error that it raises, ours or a vendor's."""
    try:
        return call()
    except (FloatrefError, KeyboardInterrupt):
        raise
    except BaseException as error:
        reason = f"{type(error).__name__}: {error}"
        raise StageError(f"stage {stage.name}: {reason}") from error
