"""Kill every command that works on something at random moments, and print counts.

    python tests/hostile/kill.py --kills 1000

Each kill is a SIGKILL or a SIGTERM in a process that has its own session and folders, to it alone
or to its group, as batch queues send it. Law: what has been written is whole or not there, no
process goes on, SIGTERM leaves nothing, and what SIGKILL leaves is gone after the next run. Whole
is what has the bytes that two runs to the end have written; of a file in which these differ, by
times or durations, all but its numbers. Exit code 1 if not.
"""

import argparse
import os
import random
import re
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.hostile.attack import warm_words, words_of
from tests.hostile.attack_running import TRACES, begin, survivors, wait, warm_up
from tests.hostile.hostile_files import write_sound
from tests.hostile.killed_commands import KILLED, write_working

INTERRUPTED = 130
GRACE_S = 60.0
"""Time in s in which the children of a killed process end, on a busy machine too."""
ENDED = (0, 1, 4)
"""Exit codes of a command that has done its work."""
NUMBER = re.compile(rb"[0-9A-Fa-f.:+-]+")
"""Numbers, dates and hashes."""
GROWING = ("floatref batch", "conformance run --report")
"""Write into a folder that may be there, file by file: each of the files is whole."""
Files = dict[str, tuple[str, str]]
"""Files by their names: the hash of what is in them, and of that without its numbers."""


@dataclass(frozen=True)
class Work:
    """A command: its template, its exit code, what it writes, and its time.

    The names ``stamped`` are those of files that differ from run to run.
    """

    key: str
    template: str
    code: int
    files: Files
    stamped: frozenset[str]
    time_s: float

    def wrote(self, found: Files, whole: bool = True) -> bool:
        """Return whether ``found`` is what it writes, or, unless ``whole``, a part of that."""
        names = found.keys() == self.files.keys() if whole else found.keys() <= self.files.keys()
        return names and all(
            both[name in self.stamped] == self.files[name][name in self.stamped]
            for name, both in found.items()
        )


@dataclass(frozen=True)
class Killed:
    """A command after its kill: what was wrong, in words, and whether it had ended before."""

    key: str
    signal: str
    faults: tuple[str, ...]
    was_over: bool


class Place:
    """A new folder for one command: its target, and its folder of temporary files."""

    def __init__(self, folder: Path) -> None:
        self.here = Path(tempfile.mkdtemp(dir=folder))
        self.target = self.here / "results" / "target"
        self.temporary = self.here / "temporary"
        for made in (self.target.parent, self.temporary):
            made.mkdir()

    def start(self, key: str, template: str, sound: dict[str, Path]) -> int:
        """Return the process of the command at ``key``."""
        return begin(words_of(key, template, self.target, sound), self.here, self.temporary)

    def files(self) -> Files:
        """Return the files among the results, without unfinished ones."""
        root = self.target.parent
        files = [p for p in root.rglob("*") if p.is_file() and ".floatref-" not in p.as_posix()]
        return {p.relative_to(root).as_posix(): _hashes(p.read_bytes()) for p in files}

    def left(self) -> list[str]:
        """Return the names of unfinished and temporary files."""
        beside = [path.name for path in self.target.parent.rglob(".floatref-*")]
        return sorted([*beside, *(path.name for path in self.temporary.iterdir())])

    @property
    def printed(self) -> str:
        """What the command has printed; nothing if it was killed before it could."""
        path = self.here / "printed"
        return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def _hashes(content: bytes) -> tuple[str, str]:
    shape = NUMBER.sub(b"0", content)
    return sha256(content).hexdigest(), sha256(shape).hexdigest()


def measure_works(folder: Path, sound: dict[str, Path], program: str = "") -> list[Work]:
    """Return the commands of ``program``, or all, each of them run to its end twice."""
    return [
        _measure(key, template, folder, sound)
        for key, template in KILLED.items()
        if key.startswith(program)
    ]


def _measure(key: str, template: str, folder: Path, sound: dict[str, Path]) -> Work:
    """Return the command at ``key``; RuntimeError if it does no work."""
    found: list[Files] = []
    for _ in range(2):
        place, begin_s = Place(folder), time.monotonic()
        code, hung, _ = wait(place.start(key, template, sound))
        time_s = time.monotonic() - begin_s
        if hung or code not in ENDED:
            raise RuntimeError(f"{key}: exit code {code}: {place.printed[-300:]}")
        found.append(place.files())
        shutil.rmtree(place.here, ignore_errors=True)
    first, second = found
    stamped = frozenset(name for name in second if first.get(name) != second[name])
    return Work(key, template, code, second, stamped, time_s)


def kill_once(work: Work, folder: Path, sound: dict[str, Path], draw: random.Random) -> Killed:
    """Kill ``work`` at a moment of ``draw``, run it again to its end, and say what was wrong."""
    place = Place(folder)
    sent, send = draw.choice([signal.SIGKILL, signal.SIGTERM]), draw.choice([os.kill, os.killpg])
    process = place.start(work.key, work.template, sound)
    time.sleep(draw.uniform(0.0, 1.1 * work.time_s))
    send(process, sent)
    code, hung, _ = wait(process)
    faults = [*_after(work, place, sent, code, hung, process), *_again(work, place, sound)]
    shutil.rmtree(place.here, ignore_errors=True)
    return Killed(work.key, sent.name, tuple(faults), code in (work.code, 0))


def _after(
    work: Work, place: Place, sent: signal.Signals, code: int, hung: bool, process: int
) -> Iterator[str]:
    """Yield what is wrong after the kill."""
    if hung:
        yield "hang"
    if any(trace in place.printed for trace in TRACES):
        yield f"traceback: {place.printed[-2000:]}"
    if code not in (work.code, -sent, INTERRUPTED):
        yield f"exit code {code}: {place.printed[-300:]}"
    if code == INTERRUPTED and "Interrupted" not in place.printed:
        yield "no line"
    if not _ends(process, place):
        yield "alive"
    found = place.files()
    if found and not work.wrote(found, whole=not work.key.startswith(GROWING)):
        yield f"half-written {sorted(found)}"
    if sent is signal.SIGTERM and code == INTERRUPTED and place.left():
        yield f"left by SIGTERM {place.left()}"


def _again(work: Work, place: Place, sound: dict[str, Path]) -> Iterator[str]:
    """Yield what is wrong after the next run, into the same place."""
    for path in place.target.parent.iterdir():
        if not path.name.startswith(".floatref-"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    process = place.start(work.key, work.template, sound)
    code, _, _ = wait(process)
    if code != work.code or not work.wrote(place.files()):
        yield f"the next run: exit code {code}, {sorted(place.files())}: {place.printed[-300:]}"
    if not _ends(process, place):
        yield "alive after the next run"
    if place.left():
        yield f"left after the next run {place.left()}"


def _ends(process: int, place: Place) -> bool:
    """Return whether all processes of the command end by themselves."""
    until_s = time.monotonic() + GRACE_S
    while time.monotonic() < until_s:
        if not _has_group(process) and not _strays(place):
            return True
        time.sleep(0.02)
    for pid in _strays(place):
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    survivors(process)
    return False


def _has_group(process: int) -> bool:
    try:
        os.killpg(process, 0)
    except (ProcessLookupError, PermissionError):
        return False
    return True


def _strays(place: Place) -> list[int]:
    """Return processes with the folder of temporary files of ``place``, whatever their session."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if os.fsencode(place.temporary) in (entry / "environ").read_bytes():
                found.append(int(entry.name))
    return found


def kill_often(kills: int, seed: int | None, folder: Path) -> list[Killed]:
    """Kill ``kills`` times, the commands by turns."""
    seed = random.randrange(10**9) if seed is None else seed
    draw = random.Random(seed)
    (folder / "sound").mkdir()
    sound = write_sound(folder / "sound") | write_working(folder / "sound")
    warm_up(warm_words(folder, sound))
    works = measure_works(folder, sound)
    print(f"seed {seed}, {len(works)} commands: {', '.join(work.key for work in works)}")
    return [kill_once(works[n % len(works)], folder, sound, draw) for n in range(kills)]


def report(killed: Sequence[Killed]) -> int:
    """Print counts and every fault; return how many kills had one."""
    for (key, sent), count in sorted(Counter((k.key, k.signal) for k in killed).items()):
        print(f"{count:5} {sent} {key}")
    for one in killed:
        if one.faults:
            print(f"{one.signal} {one.key}: {'; '.join(one.faults)}")
    bad, over = sum(bool(one.faults) for one in killed), sum(one.was_over for one in killed)
    print(f"{len(killed)} kills, {over} of them behind the end of the command: {bad} with a fault")
    return bad


def main(arguments: Sequence[str]) -> int:
    """Kill as often as the ``arguments`` say; return the exit code."""
    parser = argparse.ArgumentParser(description="Kill commands at random moments.")
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=None)
    given = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as name:
        return 1 if report(kill_often(given.kills, given.seed, Path(name))) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
