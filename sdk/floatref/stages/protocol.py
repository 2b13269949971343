"""The stage protocol and its laws.

A stage is started once with a `Header`, is pushed blocks, and is finished. Its laws:

1. any split of the input gives the same output, bit for bit;
2. output indices are contiguous, no output lies further back than the declared delay, and all
   of it is out after `finish`;
3. the input is left as it was;
4. saving and restoring the state in the middle changes nothing;
5. a missing (NaN) or flagged sample is flagged on the way out, and what it affects is declared;
6. after `finish`, `push` raises StageError;
7. what the stage declares in `Declared` holds.

A backward stage obeys the same laws with its blocks pushed from the last to the first. A
surveying stage first sees every block, forward, in `survey`, and only then is it pushed.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from enum import Enum
from typing import Any, ClassVar

from floatref.errors import StageError
from floatref.values.block import Block, Header
from floatref.values.innovations import Innovations


class Direction(Enum):
    """The order in which a stage is pushed its blocks."""

    FORWARD = 1
    BACKWARD = -1


@dataclass(frozen=True)
class Declared:
    """What holds of a stage's output, tested for every stage.

    `linear`: output of a sum is the sum of outputs. `zero_in_zero_out`: nothing is added.
    `shift_invariant`: after the first sample, the absolute index does not matter. `delay`:
    input samples that may be held back until the next block.
    """

    linear: bool = True
    zero_in_zero_out: bool = True
    shift_invariant: bool = True
    delay: int = 0


class Stage(ABC):
    """Base of all stages: it checks the order of calls; a stage defines the work of each.

    A subclass keeps all that changes in ``self.memory``, a dictionary of what a deep copy copies:
    arrays, numbers, and objects of these. So state and restore need no code of its own.
    """

    direction: ClassVar[Direction] = Direction.FORWARD
    surveys: ClassVar[bool] = False
    declared: ClassVar[Declared] = Declared()
    has_innovations: ClassVar[bool] = False

    def __init__(self) -> None:
        """Wait for `start`."""
        self.keeps_innovations = False
        self.memory: dict[str, Any] = {}
        self._next: int | None = None
        self._phase = "new"

    @property
    def name(self) -> str:
        """The stage's name in messages."""
        return type(self).__name__

    def keep_innovations(self) -> None:
        """Keep the normalized innovations of the run; only a stage that has them is asked.

        Raises StageError if the stage was started before.
        """
        if not self.has_innovations:
            raise StageError(f"stage {self.name} has no innovations")
        if self._phase != "new":
            raise StageError(f"stage {self.name}: keep innovations before the start")
        self.keeps_innovations = True

    def start(self, header: Header) -> Header:
        """Begin a run and return the header of the output.

        Raises StageError if the stage was started before, InputError if ``header`` has not every
        channel that the stage needs.
        """
        if self._phase != "new":
            raise StageError(f"stage {self.name}: started twice; make a new one for each run")
        result = self.open(header)
        self._phase = "running"
        return result

    def survey(self, block: Block) -> None:
        """Look at ``block`` before the first push; only a surveying stage is asked to."""
        raise StageError(f"stage {self.name} does not survey")

    def push(self, block: Block) -> Block:
        """Return the output that ``block`` completes, possibly empty.

        Raises StageError unless the stage is running and ``block`` follows the one before.
        """
        if self._phase != "running":
            raise StageError(f"stage {self.name}: push after {self._phase}; start it first")
        backward = self.direction is Direction.BACKWARD
        near, far = block.first, block.first + len(block)
        if backward:
            near, far = far, near
        if self._next is not None and near != self._next:
            raise StageError(f"stage {self.name}: block at {near}, expected {self._next}")
        self._next = far
        return self.advance(block)

    def finish(self) -> tuple[Block, ...]:
        """Return the blocks held back and end the run; raises StageError if it is not running."""
        if self._phase != "running":
            raise StageError(f"stage {self.name}: finish after {self._phase}")
        self._phase = "finish"
        return self.close()

    def state(self) -> Mapping[str, Any]:
        """Return a copy of all that a later `restore` needs."""
        return {"memory": deepcopy(self.memory), "next": self._next, "phase": self._phase}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go back to ``state``, of this stage or of one started with the same header."""
        self.memory = deepcopy(state["memory"])
        self._next, self._phase = state["next"], state["phase"]

    def warnings(self) -> tuple[str, ...]:
        """Return the warnings of the run so far, one line each."""
        return ()

    def list_learned(self) -> Mapping[str, float]:
        """Return settings estimated from the run, for the next run of the same vehicle."""
        return {}

    def list_innovations(self) -> Mapping[str, Mapping[str, Innovations]]:
        """Return the innovations of the run so far, by wheel path and kind of reading, if kept."""
        return {}

    @abstractmethod
    def open(self, header: Header) -> Header:
        """Check ``header``, prepare the memory, and return the header of the output."""

    @abstractmethod
    def advance(self, block: Block) -> Block:
        """Return the output for ``block``, which is known to be the next one."""

    def close(self) -> tuple[Block, ...]:
        """Return the blocks held back; most stages hold nothing."""
        return ()
