"""The engine: blocks through stages, forward in one go, backward over the tape."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import groupby
from typing import TypeVar

from floatref.architectures.tape import Tape
from floatref.errors import FloatrefError, StageError
from floatref.stages.protocol import Direction, Stage
from floatref.values.block import Block, Header

T = TypeVar("T")


def run(
    stages: Sequence[Stage], header: Header, blocks: Iterable[Block]
) -> tuple[Header, Iterator[Block]]:
    """Start all ``stages`` and return the last header and the blocks that come out.

    Nothing flows until the blocks are taken. Backward stages next to each other share one pass.
    """
    for stage in stages:
        header = _guarded(stage, partial(stage.start, header))
    stream = iter(blocks)
    for kind, group in groupby(stages, key=_kind):
        if kind == "forward":
            for stage in group:
                stream = _forward(stage, stream)
        elif kind == "survey":
            for stage in group:
                stream = _surveyed(stage, stream)
        else:
            stream = _backward(tuple(group), stream)
    return header, stream


def told(stages: Sequence[Stage]) -> tuple[str, ...]:
    """Return what ``stages`` have to tell of a run, in their order, each line once."""
    lines = (line for stage in stages for line in _guarded(stage, stage.told))
    return tuple(dict.fromkeys(lines))


def learned(stages: Sequence[Stage]) -> dict[str, float]:
    """Return the settings that a run through ``stages`` has told."""
    return {k: v for stage in stages for k, v in _guarded(stage, stage.learned).items()}


def _kind(stage: Stage) -> str:
    if stage.direction is Direction.BACKWARD:
        return "backward"
    return "survey" if stage.surveys else "forward"


def _forward(stage: Stage, blocks: Iterator[Block]) -> Iterator[Block]:
    for block in blocks:
        out = _guarded(stage, partial(stage.push, block))
        if len(out):
            yield out
    yield from (block for block in _guarded(stage, stage.finish) if len(block))


def _surveyed(stage: Stage, blocks: Iterator[Block]) -> Iterator[Block]:
    with Tape() as tape:
        for block in blocks:
            _guarded(stage, partial(stage.survey, block))
            tape.append(block)
        yield from _forward(stage, tape.forward())


def _backward(stages: Sequence[Stage], blocks: Iterator[Block]) -> Iterator[Block]:
    with Tape() as tape:
        for block in blocks:
            tape.append(block)
        for number in reversed(range(len(tape))):
            tape.rewrite(number, _through(stages, tape.read(number)))
        for stage in stages:
            _guarded(stage, stage.finish)
        yield from tape.forward()


def _through(stages: Sequence[Stage], block: Block) -> Block:
    length = len(block)
    for stage in stages:
        block = _guarded(stage, partial(stage.push, block))
        if len(block) != length:
            raise StageError(f"stage {stage.name}: a backward stage must keep its block's length")
    return block


def _guarded(stage: Stage, call: Callable[[], T]) -> T:
    """Name the stage in whatever goes wrong inside it, be it ours or a vendor's."""
    try:
        return call()
    except FloatrefError:
        raise
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
        raise StageError(f"stage {stage.name}: {reason}") from error
