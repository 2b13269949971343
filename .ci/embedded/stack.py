"""Stack of the deepest call of the library, from the frames and the calls of an image.

Frames are those that the compiler reports (`-fstack-usage`), and of functions of the C library
those that the instructions at their start make. A call by a pointer goes to the deepest of the
functions whose address the library takes. A loop of calls has no bound, and is an error.
"""

import re
from functools import cache
from pathlib import Path

from board import LIBRARY, TOOLS, quiet
from cycles import registers

FUNCTION = re.compile(r"^[0-9a-f]+ <([^>]+)>:$", re.M)
CALL = re.compile(r"\t(?:bl|b|b[a-z]{2})(?:\.[nw])?\t[0-9a-f]+ <([^>+]+)")
PUSH = re.compile(r"\t(?:stmdb\tsp!, |push\t|vpush\t|vstmdb\tsp!, )(\{[^}]*\})")
ADDRESS = re.compile(r" R_ARM_(?:ABS32|THM_MOV\w+) +(?:\.text\.)?(\w+)")
MOVE = re.compile(r"\t(?:sub(?:\.w|w)?\tsp, (?:sp, )?#(\d+)|str(?:\.w)?\t\w+, \[sp, #-(\d+)\]!)")


def reported(folder: Path) -> dict[str, int]:
    """Return the frames in bytes that the compiler has reported in ``folder``."""
    frames = {}
    for path in sorted(folder.glob("*.su")):
        for line in path.read_text(encoding="utf-8").splitlines():
            name, size, kind = line.split("\t")
            if "dynamic" in kind and "bounded" not in kind:
                raise RuntimeError(f"{name}: the frame has no bound")
            frames[name.split(":")[-1]] = int(size)
    return frames


def pointed_at(folder: Path) -> set[str]:
    """Return names in ``folder`` whose address the objects of the library take."""
    library = [folder / f"{source.stem}.o" for source in (LIBRARY / "src").glob("*.c")]
    return set(ADDRESS.findall(quiet([TOOLS[1], "-r", *map(str, library)])))


def frame(body: str) -> int:
    """Return the bytes by which the instructions of a function lower the stack."""
    saved = sum(4 * registers(listed) for listed in PUSH.findall(body))
    return saved + sum(int(a or b) for a, b in MOVE.findall(body))


def deepest(image: Path, folder: Path) -> int:
    """Return the bytes of stack of the deepest call of a function ``fr_`` in an image."""
    parts = FUNCTION.split(quiet([TOOLS[1], "-d", "--no-show-raw-insn", str(image)]))
    bodies, frames = dict(zip(parts[1::2], parts[2::2], strict=True)), reported(folder)
    pointed = pointed_at(folder)
    if len(bodies) != len(parts) // 2:
        raise RuntimeError("two functions have one name: their calls cannot be told apart")
    open_calls: list[str] = []

    @cache
    def depth(name: str) -> int:
        if name in open_calls:
            raise RuntimeError(f"{name} calls itself")
        body = bodies[name]
        called = set(CALL.findall(body)) | (pointed if re.search(r"\tblx\t", body) else set())
        open_calls.append(name)
        below = max((depth(n) for n in called - {name} if n in bodies), default=0)
        open_calls.pop()
        return frames.get(name, frame(body)) + below

    return max(depth(name) for name in bodies if name.startswith("fr_"))
