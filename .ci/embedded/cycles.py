"""Cycles of a Cortex-M4F, from the instructions that a run executes and ARM's table of them.

Each instruction has a range: the Cortex-M4 Technical Reference Manual (ARM DDI 0439) gives one
cycle to most, and a number that depends on the instructions beside it to some. The range of a run
is the sum over its instructions. Memory without wait states is assumed, as the manual does.
"""

import re
import subprocess
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from board import TOOLS, Board, quiet

REFILL = (1, 3)
"""Cycles to refill the pipeline behind a branch that is taken: P of the manual."""
SHORT = ("-DWARM=12", "-DTIMED=2")
"""Pieces of a run that is traced, before the clock and with it: the IRI starts after 11 m."""
RANGES: tuple[tuple[tuple[str, ...], tuple[int, int]], ...] = (
    (("it",), (0, 1)),
    (("ldrd", "strd"), (3, 3)),
    (("tbb", "tbh"), (2, 2)),
    (("ldr", "str"), (1, 2)),
    (("sdiv", "udiv"), (2, 12)),
    (("vdiv", "vsqrt"), (14, 15)),
    (("vmla", "vmls", "vfma", "vfms", "vnmla", "vnmls", "vfnma", "vfnms"), (3, 4)),
    (("vldr", "vstr"), (2, 2)),
    (("v",), (1, 2)),
    (("",), (1, 1)),
)
"""Cycles of instructions by how their names start: the first row that fits. A result of the
floating-point unit costs one more where the next instruction needs it."""
MULTIPLE = ("ldm", "stm", "push", "pop", "vldm", "vstm", "vpush", "vpop")
"""Moves of a list of registers: one cycle, and one for each word."""
CODE = re.compile(r"^ +([0-9a-f]+):\t(\S+)(?:\t([^;@\n]*))?", re.M)
STEP = re.compile(rb"\[[0-9a-f]+/([0-9a-f]+)/")


@dataclass(frozen=True)
class Instruction:
    """An instruction of an image: its name, and its operands."""

    name: str
    operands: str


@dataclass(frozen=True)
class Cost:
    """What a sample takes: instructions, and the fewest and the most cycles."""

    instructions: float
    fewest: float
    most: float


def code(image: Path) -> dict[int, Instruction]:
    """Return the instructions of an image by address."""
    text = quiet([TOOLS[1], "-d", "--no-show-raw-insn", str(image)])
    found = CODE.findall(text)
    return {int(at, 16): Instruction(name, operands or "") for at, name, operands in found}


def registers(operands: str) -> int:
    """Return how many words a list of registers moves."""
    listed = operands[operands.index("{") + 1 :].rstrip("} \t").split(",")
    words = 0
    for part in (each.strip() for each in listed):
        first, _, last = part.partition("-")
        count = int(last[1:]) - int(first[1:]) + 1 if last else 1
        words += count * (2 if first.startswith("d") else 1)
    return words


def cycles(instruction: Instruction, taken: bool) -> tuple[int, int]:
    """Return the fewest and the most cycles of an instruction; ``taken`` if it goes elsewhere."""
    name, operands = instruction.name, instruction.operands
    if name.startswith(MULTIPLE):
        low = high = 1 + registers(operands)
    elif name.startswith(("vldr", "vstr")) and operands.startswith("d"):
        low = high = 3
    else:
        low, high = next(r for prefixes, r in RANGES if name.startswith(prefixes))
    refill = REFILL if taken else (0, 0)
    return low + refill[0], high + refill[1]


def steps(board: Board, image: Path) -> Iterator[int]:
    """Yield the address of every instruction that a run executes."""
    command = [*board.emulation(image), "-singlestep", "-d", "exec,nochain", "-D", "/dev/stderr"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        assert process.stderr is not None
        for line in process.stderr:
            match = STEP.search(line)
            if match:
                yield int(match[1], 16)


def windows(addresses: Iterable[int], clock: int) -> list[Counter[tuple[int, int]]]:
    """Return what is executed from one reading of the clock to the next, every other time.

    Each is a count of pairs: an address, and the one after it.
    """
    found: list[Counter[tuple[int, int]]] = []
    inside, before = False, 0
    for address in addresses:
        if address == clock:
            inside = not inside
            if inside:
                found.append(Counter())
        if inside:
            found[-1][before, address] += 1
        before = address
    return found


def cost(timed: Counter[tuple[int, int]], listing: dict[int, Instruction], samples: int) -> Cost:
    """Return what each of ``samples`` takes of the instructions that were counted."""
    ranges = [
        (times, *cycles(listing[at], taken=not at < following <= at + 4))
        for (at, following), times in timed.items()
        if at in listing
    ]
    return Cost(
        sum(times for times, _, _ in ranges) / samples,
        sum(times * low for times, low, _ in ranges) / samples,
        sum(times * high for times, _, high in ranges) / samples,
    )


def estimate(board: Board, stage: str) -> dict[int, Cost]:
    """Return what a sample of a stage takes, by the rate in Hz."""
    image = board.image(stage, *SHORT)
    listing = code(image)
    (clock,) = re.findall(r"^([0-9a-f]+) <board_ticks>:", quiet([TOOLS[1], "-d", str(image)]), re.M)
    found = windows(steps(board, image), int(clock, 16))
    rates = board.run(image)
    each = len(found) // len(rates)
    made = {}
    for k, figures in enumerate(rates):
        # A run in pieces is timed at its last two, one that has an end at that alone.
        timed = sum(found[k * each : (k + 1) * each][-2:], Counter[tuple[int, int]]())
        made[figures.rate] = cost(timed, listing, figures.samples)
    return made
