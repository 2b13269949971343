"""Mixed work, over and over in one process: nothing may grow with the rounds.

    python tests/hostile/soak.py --minutes 10

A round processes files, converts, measures and draws them, runs a batch on a cluster and the judge
on a device in a process of its own, streams a run, and is refused a damaged file. After each round
the memory of the process, its file handles, threads and children, and what is left in the temporary
folder are counted. After the first third of the time they may not grow any more: exit code 1 if one
does.
"""

import argparse
import gc
import os
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from click.testing import CliRunner
from numpy.typing import NDArray

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.hostile.attack_running import resident_bytes
from tests.hostile.hostile_files import write_sound

from floatref import Recording, UniformClock, read_recording, start_stream
from floatref.cli.main import main as floatref
from floatref_conformance.cli.main import main as conformance
from floatref_conformance.devices.builtin import BuiltinDevice

GROWTH_MIB = 24.0
"""Memory in MiB that the allocator may hold on to between the first third and the end."""
PIECES = 50
LEAST_ROUNDS = 4
PROGRAMS = {"floatref": floatref, "conformance": conformance}
COMMANDS = (
    (0, "floatref process {drive} --out {out}/profile"),
    (0, "floatref iri {out}/profile --segment 100"),
    (0, "floatref roughness {out}/profile"),
    (0, "floatref compare {out}/profile {out}/profile"),
    (0, "floatref plot {out}/profile --out {out}/profile.png"),
    (0, "floatref view {out}/profile --out {out}/profile.html"),
    (0, "floatref convert {drive} --out {out}/drive.mf4"),
    (0, "floatref batch {drives} --out {out}/batch --segment 100 --jobs 1"),
    (4, "conformance run --check constant-speed --device {device}"),
    (2, "floatref process {damaged} --out {out}/never"),
)
"""Exit code and words of each command of a round."""
DEVICE = "python:tests.hostile.soak:make_device"


def make_device() -> BuiltinDevice:
    """Return the device that the judge runs in a process of its own."""
    return BuiltinDevice("temporal-matched-hpf")


@dataclass(frozen=True)
class Counts:
    """What the process holds: memory in MiB, open handles, threads, children, files left."""

    memory_mib: float
    handles: int
    threads: int
    children: int
    left: int

    def grown(self, before: "Counts") -> tuple[str, ...]:
        """Return the names of what has grown since ``before``."""
        bounds = dict.fromkeys(asdict(self), 0.0) | {"memory_mib": GROWTH_MIB}
        now, then = asdict(self), asdict(before)
        return tuple(name for name, bound in bounds.items() if now[name] - then[name] > bound)


def count(temporary: Path) -> Counts:
    """Count what this process holds, and the files in ``temporary``."""
    gc.collect()
    process = Path("/proc/self")
    tasks = process / "task"
    children = {
        child
        for task in tasks.iterdir()
        for child in (task / "children").read_text(encoding="ascii").split()
    }
    return Counts(
        memory_mib=resident_bytes() / 2**20,
        handles=len(list((process / "fd").iterdir())),
        threads=threading.active_count(),
        children=len(children),
        left=len(list(temporary.iterdir())),
    )


def run_command(code: int, words: Sequence[str]) -> None:
    """Run a command in this process; AssertionError unless it ends with ``code``."""
    done = CliRunner().invoke(PROGRAMS[words[0]], list(words[1:]))
    if done.exit_code != code:
        raise AssertionError(f"{' '.join(words)}: exit code {done.exit_code}\n{done.output}")


def stream_drive(drive: Recording) -> None:
    """Push the channels of ``drive`` that have a rate in pieces, and take all points."""
    channels = [c for c in drive.channels if isinstance(c.clock, UniformClock)]
    clocks = {channel.id: channel.clock for channel in channels}
    with start_stream(drive.setup, clocks, pipeline="temporal-matched-hpf") as stream:
        for piece in range(PIECES):
            stream.push({channel.id: _cut(channel.values, piece) for channel in channels})
            stream.ready()
        if not stream.finish():
            raise AssertionError("the stream gave out no point")


def _cut(values: NDArray[Any], piece: int) -> NDArray[Any]:
    return values[values.size * piece // PIECES : values.size * (piece + 1) // PIECES]


def write_files(folder: Path) -> dict[str, Path]:
    """Return the files of the `COMMANDS` by name, made in ``folder``."""
    sound, drives = write_sound(folder), folder / "drives"
    drives.mkdir()
    run_command(0, ["conformance", "simulate", "ref_72", "--out", str(drives / "drive")])
    damaged = folder / "damaged.csv"
    damaged.write_bytes(sound["csv"].read_bytes()[:-40] + b"\xff" * 40)
    return {"drives": drives, "drive": drives / "drive", "damaged": damaged}


def work_a_round(files: dict[str, Path], folder: Path) -> None:
    """Do all the work once, with its results in a new part of ``folder``."""
    with tempfile.TemporaryDirectory(dir=folder) as out:
        for code, line in COMMANDS:
            words = line.split(" ")
            run_command(code, [word.format(**files, out=out, device=DEVICE) for word in words])
    stream_drive(read_recording(files["drive"]))


def main(arguments: Sequence[str]) -> int:
    """Work for the minutes of the ``arguments``; return the exit code."""
    parser = argparse.ArgumentParser(description="Mixed work, over and over in one process.")
    parser.add_argument("--minutes", type=float, default=10.0)
    minutes = parser.parse_args(arguments).minutes
    root = Path(__file__).parents[2]
    os.chdir(root)
    with tempfile.TemporaryDirectory(prefix="soak-") as name:
        folder, temporary = Path(name) / "files", Path(name) / "temporary"
        for made in (folder, temporary):
            made.mkdir()
        os.environ["TMPDIR"] = tempfile.tempdir = str(temporary)
        rounds = list(soak(write_files(folder), temporary, 60.0 * minutes))
        tempfile.tempdir = None
    before, after = rounds[len(rounds) // 3], rounds[-1]
    grown = after.grown(before)
    print(f"{len(rounds)} rounds; grown: {', '.join(grown) or 'nothing'}")
    return 1 if grown else 0


def soak(files: dict[str, Path], temporary: Path, most_s: float) -> Iterator[Counts]:
    """Yield the counts after each round, four rounds at least."""
    begin_s, number = time.monotonic(), 0
    while number < LEAST_ROUNDS or time.monotonic() - begin_s < most_s:
        work_a_round(files, files["drives"].parent)
        number += 1
        counts = count(temporary)
        held = ", ".join(f"{name} {value:.0f}" for name, value in asdict(counts).items())
        print(f"round {number}, {time.monotonic() - begin_s:.0f} s: {held}", flush=True)
        yield counts


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
