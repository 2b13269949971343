"""Commands in processes of their own, over files whose reading the test can hold up or kill."""

import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from floatref.files import write_recording
from floatref_conformance.proving_ground import Scenario, simulate

PATIENCE_S = 900.0
FLOATREF = (sys.executable, "-m", "floatref")
PROGRESS = re.compile(r"\d+ of \d+ files, ")
Started = subprocess.Popen[str]
PLUGIN = """
import os
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import floatref
from floatref import hookimpl


class Gate:
    name, summary = "gate", "a recording behind a gate"

    def recognises(self, source):
        return source.suffix == ".gate"

    def read(self, source):
        how, recording = source.read_text().split()
        with (source.parent.parent / "begun").open("a") as stream:
            stream.write(f"{source.name} {os.getpid()}\\n")
        if how == "odd":
            raise floatref.InputError(f"{source}: damaged at byte 7; copy it again")
        with TemporaryDirectory():
            while how == "wait" and not (source.parent.parent / "open").exists():
                time.sleep(0.02)
        return floatref.read_recording(Path(recording))


class Plugin:
    @hookimpl
    def floatref_register_adapters(self, register):
        register(Gate())


plugin = Plugin()
"""


@dataclass
class Bench:
    """A folder with inputs behind gates, and the commands that are started over them."""

    folder: Path
    recording: Path
    started: list[Started] = field(default_factory=list)

    @property
    def out(self) -> Path:
        return self.folder / "out"

    @property
    def temporary(self) -> Path:
        return self.folder / "temporary"

    def put(self, **files: tuple[str, int]) -> None:
        """Write a file for each name, ``how`` it is to be read, and how large it is."""
        for name, (how, size) in files.items():
            text = f"{how} {self.recording}".ljust(size) + "\n"
            (self.folder / "in" / f"{name}.gate").write_text(text, encoding="utf-8")

    def start(self, *arguments: str, program: tuple[str, ...] = FLOATREF) -> Started:
        """Start the command in a session of its own."""
        path = os.pathsep.join([str(self.folder / "plugin"), os.environ.get("PYTHONPATH", "")])
        self.temporary.mkdir(exist_ok=True)
        process = subprocess.Popen(
            [*program, *arguments],
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": path, "TMPDIR": str(self.temporary)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self.started.append(process)
        return process

    def batch(self, *arguments: str) -> Started:
        return self.start("batch", "in", "--out", "out", "--json", *arguments)

    def begun(self) -> dict[str, list[int]]:
        """Return the processes that have begun to read a file, by its name."""
        found: dict[str, list[int]] = {}
        if (self.folder / "begun").exists():
            for line in (self.folder / "begun").read_text(encoding="ascii").splitlines():
                name, process = line.split()
                found.setdefault(name.removesuffix(".gate"), []).append(int(process))
        return found

    def at_work(self) -> int:
        """Return how many files are held at the gate by workers that live."""
        waiting = [processes[-1] for name, processes in self.begun().items() if name[0] == "w"]
        return sum(map(is_alive, waiting))

    def forget_begun(self) -> None:
        (self.folder / "begun").unlink()

    def open_gate(self) -> None:
        (self.folder / "open").touch()

    def records(self) -> dict[str, int]:
        """Return when each record was written, in nanoseconds, by the name of its file."""
        places = (self.out / "records").glob("*.gate.json")
        return {path.name.removesuffix(".gate.json"): path.stat().st_mtime_ns for path in places}

    def scheduler_address(self) -> str:
        """Return what the scheduler's file tells of it."""
        text = (self.folder / "scheduler.json").read_text(encoding="utf-8")
        return str(json.loads(text)["address"])

    def ended(self, process: Started) -> tuple[int, str, str]:
        """Wait for ``process``; return its exit code and what it has printed, progress apart."""
        out, err = process.communicate(timeout=PATIENCE_S)
        lines = [line for line in err.splitlines() if not PROGRESS.match(line)]
        return process.returncode, out, "\n".join(lines)

    def report_of(self, process: Started, code: int = 0) -> dict[str, Any]:
        """Return the one JSON object that ``process`` prints before it ends with ``code``."""
        returned, out, err = self.ended(process)
        assert (returned, err) == (code, "")
        report: dict[str, Any] = json.loads(out)
        return report

    def wait_until(self, is_so: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not is_so():
            assert time.monotonic() < end, "it never came to that"
            time.sleep(0.02)

    def processes_of(self, session: int) -> list[int]:
        """Return the processes that run in the session of the command ``session``."""
        found = []
        for entry in Path("/proc").iterdir():
            if entry.name.isdecimal() and is_alive(int(entry.name)):
                try:
                    if os.getsid(int(entry.name)) == session:
                        found.append(int(entry.name))
                except ProcessLookupError:
                    continue
        return found


def is_alive(process: int) -> bool:
    """Tell whether ``process`` runs; one that has ended and waits for its parent does not."""
    try:
        os.kill(process, 0)
        status = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        return not isinstance(error, ProcessLookupError) and not os.path.isdir("/proc/self")
    return status.rpartition(")")[2].split()[0] != "Z"


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recording") / "run"
    drive = {"road_seed": 1, "rate_hz": 1000.0, "length_m": 60.0, "tracks": ["left"]}
    write_recording(simulate(Scenario.from_dict(drive)).recording, folder)
    return folder


@pytest.fixture
def bench(tmp_path: Path, recording: Path) -> Iterator[Bench]:
    """Yield a bench without files; whatever was started on it is ended."""
    yield from _bench(tmp_path, recording)


@pytest.fixture(scope="module")
def module_bench(tmp_path_factory: pytest.TempPathFactory, recording: Path) -> Iterator[Bench]:
    """Yield a bench for all tests of a module."""
    yield from _bench(tmp_path_factory.mktemp("bench"), recording)


def _bench(folder: Path, recording: Path) -> Iterator[Bench]:
    (folder / "in").mkdir()
    made_known = folder / "plugin" / "gate-1.0.dist-info"
    made_known.mkdir(parents=True)
    (folder / "plugin" / "gate_plugin.py").write_text(PLUGIN, encoding="utf-8")
    (made_known / "METADATA").write_text("Name: gate\nVersion: 1.0\n", encoding="utf-8")
    points = "[floatref]\ngate = gate_plugin:plugin\n"
    (made_known / "entry_points.txt").write_text(points, encoding="utf-8")
    found = Bench(folder, recording)
    yield found
    for process in found.started:
        process.kill()
        process.communicate()
