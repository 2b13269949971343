"""The blocks of a short run, kept in memory: a tape that copies, packs and spools nothing."""

from collections.abc import Iterator
from dataclasses import replace
from types import TracebackType

from floatref.values.arrays import frozen
from floatref.values.block import Block


class KeptBlocks:
    """Blocks in order, as `floatref.intake.tape.Tape` has them, all of them in memory.

    For a run whose length has a bound: a window of a live stream, of which no sample is written to
    disk.
    """

    def __init__(self) -> None:
        """Begin without blocks."""
        self._blocks: list[Block] = []

    def __enter__(self) -> "KeptBlocks":
        """Use the blocks; they are dropped at the end."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        """Drop the blocks."""
        self._blocks = []

    def __len__(self) -> int:
        """Return the number of blocks."""
        return len(self._blocks)

    def append(self, block: Block) -> None:
        """Add ``block`` at the end."""
        self._blocks.append(_at_rest(block))

    def rewrite(self, number: int, block: Block) -> None:
        """Keep ``block``, of the same length, in place of block ``number``."""
        length = len(self._blocks[number])
        if len(block) != length:
            raise ValueError(f"block {number} holds {length} samples, not {len(block)}")
        self._blocks[number] = _at_rest(block)

    def read(self, number: int) -> Block:
        """Return block ``number``."""
        return self._blocks[number]

    def turn(self) -> None:
        """Know that all is there; a short run leaves nothing worth mention."""

    def forward(self) -> Iterator[Block]:
        """Yield all blocks, the first one first."""
        yield from self._blocks


def _at_rest(block: Block) -> Block:
    """Return ``block`` with arrays that are read-only and without gaps, as those from disk are."""
    return replace(block, values={name: frozen(each) for name, each in block.values.items()})
