"""Stack of the deepest call of the library, from the frames and the calls of an image.

Frames are those that the compiler reports (`-fstack-usage`), and of functions of the C library
those that the instructions at their start make. A loop of calls, or a call by a pointer, has no
bound, and is an error.
"""

import re
from functools import cache
from pathlib import Path

from board import TOOLS, quiet
from cycles import registers

FUNCTION = re.compile(r"^[0-9a-f]+ <([^>]+)>:$", re.M)
CALL = re.compile(r"\t(?:bl|b|b[a-z]{2})(?:\.[nw])?\t[0-9a-f]+ <([^>+]+)")
PUSH = re.compile(r"\t(?:stmdb\tsp!, |push\t|vpush\t|vstmdb\tsp!, )(\{[^}]*\})")
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


def frame(body: str) -> int:
    """Return the bytes by which the instructions of a function lower the stack."""
    saved = sum(4 * registers(listed) for listed in PUSH.findall(body))
    return saved + sum(int(a or b) for a, b in MOVE.findall(body))


def deepest(image: Path, folder: Path) -> int:
    """Return the bytes of stack of the deepest call of a function ``fr_`` in an image."""
    parts = FUNCTION.split(quiet([TOOLS[1], "-d", "--no-show-raw-insn", str(image)]))
    bodies, frames = dict(zip(parts[1::2], parts[2::2], strict=True)), reported(folder)
    if len(bodies) != len(parts) // 2:
        raise RuntimeError("two functions have one name: their calls cannot be told apart")
    open_calls: list[str] = []

    @cache
    def depth(name: str) -> int:
        if name in open_calls:
            raise RuntimeError(f"{name} calls itself")
        body = bodies[name]
        if re.search(r"\tblx\t", body):
            raise RuntimeError(f"{name} calls by a pointer")
        open_calls.append(name)
        below = max((depth(n) for n in set(CALL.findall(body)) - {name} if n in bodies), default=0)
        open_calls.pop()
        return frames.get(name, frame(body)) + below

    return max(depth(name) for name in bodies if name.startswith("fr_"))
