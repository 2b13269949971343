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
SHORT = ("-DWARM=12", "-DTIMED=2", "-DTRACED=1")
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
CODE = re.compile(r"^ +([0-9a-f]+):\t([0-9a-f ]+?) *\t(\S+)(?:\t([^;@\n]*))?")
OWNER = re.compile(r"^[0-9a-f]+ <([^>]+)>:$")
BLOCK = re.compile(rb"^Trace .*?\[[0-9a-f]+/([0-9a-f]+)/")
STOPPED = b"Stopped execution of TB chain"
CONDITION = "(?:eq|ne|cs|hs|cc|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)?"
BRANCH = re.compile(rf"(?:(?:b|bl|blx|bx){CONDITION}|cbn?z|tb[bh]|bkpt|isb|vmsr)(?:\.[nw])?$")
PAGE = 1024
"""QEMU's pages of such a core, in bytes: a block of instructions ends with its page."""


@dataclass(frozen=True)
class Instruction:
    """An instruction of an image: its name, its operands, its bytes, and whose it is."""

    name: str
    operands: str
    size: int = 2
    reads_clock: bool = False


@dataclass(frozen=True)
class Cost:
    """What a sample takes: instructions, and the fewest and the most cycles."""

    instructions: float
    fewest: float
    most: float


def code(image: Path) -> dict[int, Instruction]:
    """Return the instructions of an image by address."""
    listed: dict[int, Instruction] = {}
    owner = ""
    for line in quiet([TOOLS[1], "-d", str(image)]).splitlines():
        owner = match[1] if (match := OWNER.match(line)) else owner
        if match := CODE.match(line):
            at, words, name, operands = match.groups()
            size = len(words.replace(" ", "")) // 2
            listed[int(at, 16)] = Instruction(name, operands or "", size, owner == "board_ticks")
    return listed


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


def blocks(board: Board, image: Path) -> Iterator[int]:
    """Yield the address of every block of instructions that a run executes."""
    command = [*board.emulation(image), "-d", "exec,nochain", "-D", "/dev/stderr"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        assert process.stderr is not None
        begun = None
        for line in process.stderr:
            match = BLOCK.match(line)
            # A block that is stopped before its first instruction is begun again.
            if begun is not None and (match or line.startswith(STOPPED)):
                if match:
                    yield begun
                begun = None
            if match:
                begun = int(match[1], 16)
        if begun is not None:
            yield begun


def windows(addresses: Iterable[int], clock: int) -> list[Counter[tuple[int, int]]]:
    """Return what is executed from one reading of the clock to the next, every other time.

    Each is a count of pairs: the address of a block, and that of the one after it.
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


def ends(instruction: Instruction) -> bool:
    """Return whether a block ends with this instruction, as one that may go elsewhere."""
    name, operands = instruction.name, instruction.operands
    loads_pc = name.startswith(("pop", "ldm")) and re.search(r"\bpc\b", operands.partition("{")[2])
    return bool(BRANCH.match(name) or loads_pc or operands.startswith("pc"))


def block(start: int, following: int, listing: dict[int, Instruction]) -> list[int]:
    """Return the instructions from ``start`` that are executed before the block ``following``.

    A block ends with a branch, with its page, or before an instruction that reads the clock.
    """
    found, at, clock = [], start, listing.get(following)
    while at in listing:
        found.append(at)
        behind = at + listing[at].size
        crossed = behind // PAGE != at // PAGE or (behind + 2) // PAGE != at // PAGE
        reads = clock is not None and clock.reads_clock
        if ends(listing[at]) or (behind == following and (crossed or reads)):
            break
        at = behind
    return found


def cost(timed: Counter[tuple[int, int]], listing: dict[int, Instruction], samples: int) -> Cost:
    """Return what each of ``samples`` takes of the blocks that were counted."""
    total = fewest = most = 0
    for (start, following), times in timed.items():
        executed = block(start, following, listing)
        for at in executed:
            away = at == executed[-1] and following != at + listing[at].size
            low, high = cycles(listing[at], taken=away)
            total, fewest, most = total + times, fewest + times * low, most + times * high
    return Cost(total / samples, fewest / samples, most / samples)


def estimate(board: Board, stage: str) -> dict[int, Cost]:
    """Return what a sample of a stage takes, by the rate in Hz."""
    image = board.image(stage, *SHORT)
    listing = code(image)
    (clock,) = re.findall(r"^([0-9a-f]+) <board_ticks>:", quiet([TOOLS[1], "-d", str(image)]), re.M)
    found = windows(blocks(board, image), int(clock, 16))
    rates = board.run(image)
    each = len(found) // len(rates)
    made = {}
    for k, figures in enumerate(rates):
        # A run in pieces is timed at its last two, one that has an end at that alone.
        timed = sum(found[k * each : (k + 1) * each][-2:], Counter[tuple[int, int]]())
        made[figures.rate] = cost(timed, listing, figures.samples)
    return made
