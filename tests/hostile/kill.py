"""Kill commands that write at random moments, and print counts.

    python tests/hostile/kill.py --kills 1000

Each kill is a SIGKILL or a SIGTERM in a process that has its own session and folders. Law: what has
been written is whole or not there, no process goes on, SIGTERM leaves nothing, and what SIGKILL
leaves is gone after the next run of the same command. Exit code 1 if one of these does not hold.
"""

import argparse
import os
import random
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.hostile.attack import warm_words, words_of
from tests.hostile.attack_running import TRACES, begin, survivors, wait, warm_up
from tests.hostile.attacked_commands import WRITTEN
from tests.hostile.hostile_files import write_sound

INTERRUPTED = 130
GRACE_S = 60.0
"""Time in s in which the children of a killed process end, on a busy machine too."""
STAMPS_BYTES = 64
"""By how much the size of a file may differ: times and durations are in some."""
SHORTEST = {"conformance run --report": "conformance run --check quiescent --report {x}"}
APART = ("floatref live", "conformance table", "conformance faults", "conformance certify")
"""Wait for a peer, or take minutes: their own tests kill them."""


@dataclass(frozen=True)
class Work:
    """A command that writes: its template, its exit code, what it writes by size, its time."""

    key: str
    template: str
    code: int
    sizes: dict[str, int]
    time_s: float


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

    def sizes(self) -> dict[str, int]:
        """Return the size of each file among the results, by its name."""
        root = self.target.parent
        files = (p for p in root.rglob("*") if p.is_file() and ".floatref-" not in p.as_posix())
        return {p.relative_to(root).as_posix(): p.stat().st_size for p in files}

    def left(self) -> list[str]:
        """Return the names of unfinished and temporary files."""
        beside = [path.name for path in self.target.parent.rglob(".floatref-*")]
        return sorted([*beside, *(path.name for path in self.temporary.iterdir())])

    @property
    def printed(self) -> str:
        """What the command has printed; nothing if it was killed before it could."""
        path = self.here / "printed"
        return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def measure_works(folder: Path, sound: dict[str, Path], program: str = "") -> list[Work]:
    """Return the commands of ``program``, or all, that write something here, run once each."""
    works = []
    for key, template in WRITTEN.items():
        if key.startswith(APART) or not key.startswith(program):
            continue
        place, template = Place(folder), SHORTEST.get(key, template)
        template = template.removeprefix(f"{key.split()[0]} ") if key in SHORTEST else template
        begin_s = time.monotonic()
        code, hung, _ = wait(place.start(key, template, sound))
        if place.sizes() and not hung:
            time_s = time.monotonic() - begin_s
            works.append(Work(key, template, code, place.sizes(), time_s))
        shutil.rmtree(place.here, ignore_errors=True)
    return works


def kill_once(work: Work, folder: Path, sound: dict[str, Path], draw: random.Random) -> Killed:
    """Kill ``work`` at a moment of ``draw``, run it again to its end, and say what was wrong."""
    place = Place(folder)
    sent = draw.choice([signal.SIGKILL, signal.SIGTERM])
    process = place.start(work.key, work.template, sound)
    time.sleep(draw.uniform(0.0, 1.1 * work.time_s))
    os.kill(process, sent)
    code, hung, _ = wait(process)
    over = code in (work.code, 0)
    faults = [*_after(work, place, sent, code, hung, process), *_again(work, place, sound)]
    shutil.rmtree(place.here, ignore_errors=True)
    return Killed(work.key, sent.name, tuple(faults), over)


def _after(
    work: Work, place: Place, sent: signal.Signals, code: int, hung: bool, process: int
) -> Iterator[str]:
    """Yield what is wrong after the kill."""
    if hung:
        yield "hang"
    if any(trace in place.printed for trace in TRACES):
        yield "traceback"
    if code not in (work.code, -sent, INTERRUPTED):
        yield f"exit code {code}"
    if not _ends(process):
        yield "alive"
    found = place.sizes()
    if found and not _same(found, work.sizes):
        yield f"half-written {found}"
    if sent is signal.SIGTERM and code == INTERRUPTED and place.left():
        yield f"left by SIGTERM {place.left()}"


def _again(work: Work, place: Place, sound: dict[str, Path]) -> Iterator[str]:
    """Yield what is wrong after the next run, into the same place."""
    for path in place.target.parent.iterdir():
        if not path.name.startswith(".floatref-"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    process = place.start(work.key, work.template, sound)
    code, _, _ = wait(process)
    if code != work.code or not _same(place.sizes(), work.sizes):
        yield f"the next run: exit code {code}, {place.sizes()}"
    if place.left() or survivors(process):
        yield f"left after the next run {place.left()}"


def _ends(process: int) -> bool:
    """Return whether all processes of the session end by themselves."""
    until_s = time.monotonic() + GRACE_S
    while time.monotonic() < until_s:
        try:
            os.killpg(process, 0)
        except (ProcessLookupError, PermissionError):
            return True
        time.sleep(0.02)
    return not survivors(process)


def _same(found: dict[str, int], whole: dict[str, int]) -> bool:
    return found.keys() == whole.keys() and all(
        abs(size - whole[name]) <= STAMPS_BYTES for name, size in found.items()
    )


def kill_often(kills: int, seed: int | None, folder: Path) -> list[Killed]:
    """Kill ``kills`` times, the commands by turns."""
    seed = random.randrange(10**9) if seed is None else seed
    draw = random.Random(seed)
    (folder / "sound").mkdir()
    sound = write_sound(folder / "sound")
    warm_up(warm_words(folder, sound))
    works = measure_works(folder, sound)
    print(f"seed {seed}, {len(works)} commands: {', '.join(work.key for work in works)}")
    return [kill_once(works[n % len(works)], folder, sound, draw) for n in range(kills)]


def report(killed: Sequence[Killed]) -> int:
    """Print counts and every fault; return how many kills had one."""
    counts = Counter((one.key, one.signal) for one in killed)
    for (key, sent), count in sorted(counts.items()):
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
