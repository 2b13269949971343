"""The engine: passes blocks through stages, forward in one go, backward over the tape."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby
from typing import TypeVar

from floatref.errors import FloatrefError, InputError, StageError
from floatref.intake.kept_blocks import KeptBlocks
from floatref.intake.tape import Tape
from floatref.stages.protocol import Direction, Stage
from floatref.values.block import Block, Header
from floatref.values.innovations import Innovations

Kept = Mapping[str, Mapping[str, Innovations]]


T = TypeVar("T")


def run(
    stages: Sequence[Stage],
    header: Header,
    blocks: Iterable[Block],
    tape: type[Tape] | type[KeptBlocks] = Tape,
) -> tuple[Header, Iterator[Block]]:
    """Start all ``stages`` and return the last header and the resulting blocks.

    Nothing is processed until the blocks are read. Adjacent backward stages share one pass. What
    is read again is on a ``tape``; ``blocks`` that are no iterator are asked for again instead, as
    a recording's are, whose samples are in its file.
    """
    for stage in stages:
        header = _guard(stage, partial(stage.start, header))
    if stages and stages[0].surveys and not isinstance(blocks, Iterator):
        stream, stages = _survey_again(stages[0], blocks), stages[1:]
    else:
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
        tape.turn()
        yield from _forward(stage, tape.forward())


def _survey_again(stage: Stage, blocks: Iterable[Block]) -> Iterator[Block]:
    for block in blocks:
        _guard(stage, partial(stage.survey, block))
    yield from _forward(stage, iter(blocks))


def _backward(
    stages: Sequence[Stage], blocks: Iterator[Block], kept: Tape | KeptBlocks
) -> Iterator[Block]:
    with kept as tape:
        for block in blocks:
            tape.append(block)
        tape.turn()
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
