"""One command under attack, in a process of its own: how it ended, and what it left."""

import os
import signal
import sys
import tempfile
import time
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from click.testing import CliRunner

from floatref.cli.main import main as floatref
from floatref.cli.program.starting import start as start_floatref
from floatref.files.scratch import remove_left
from floatref_conformance.__main__ import start as start_conformance
from floatref_conformance.cli.main import main as conformance

LONGEST_S = 120.0
"""A command that takes longer hangs: the files are small."""
MOST_BYTES = 600 << 20
LOADED_BYTES = 250 << 20
"""What a process takes that has loaded what commands need, and nothing else."""
ALLOWED = (*range(6), 130)
"""Exit codes that commands have, that of a signal last."""
FOLLOWS, FOLLOWED_S = ("live", "--follow"), 5.0
"""A command that waits for its file to grow: it gets a SIGTERM after this time in s."""
TRACES = ("Traceback (most recent call last)", "the suite itself is at fault", "Exception ignored")

STARTS = {"floatref": start_floatref, "conformance": start_conformance}


@dataclass(frozen=True)
class Ended:
    """How the command ``words`` ended.

    ``code`` is its exit code, that of a signal negative; ``text`` what it printed, ``peak_bytes``
    the memory it took at most, ``left`` the names of what it left behind.
    """

    words: tuple[str, ...]
    code: int
    hung: bool
    text: str
    peak_bytes: int
    left: tuple[str, ...]

    def faults(self) -> tuple[str, ...]:
        """Return what is wrong with it: no words if all is well."""
        found = {
            "hang": self.hung,
            "crash": not self.hung and self.code not in ALLOWED,
            "traceback": any(trace in self.text for trace in TRACES),
            "controls": any(c < " " and c not in "\n\r\t" for c in self.text),
            "left behind": bool(self.left),
            "memory": self.peak_bytes > MOST_BYTES,
        }
        return tuple(name for name, wrong in found.items() if wrong)


def warm_up(words: Iterable[Sequence[str]]) -> None:
    """Run ``words`` here: a process that is forked has then imported what commands need."""
    for each in words:
        CliRunner().invoke(conformance if each[0] == "conformance" else floatref, list(each[1:]))


def run_attack(words: Sequence[str], folder: Path) -> Ended:
    """Run ``words``, a program and its arguments, with temporary files in a new part of ``folder``.

    Its memory is what it took beyond that of this process, which may hold much of earlier work, and
    `LOADED_BYTES`. Linux alone counts memory in KiB.
    """
    here = Path(tempfile.mkdtemp(dir=folder))
    temporary = here / "temporary"
    temporary.mkdir()
    before = resident_bytes()
    process = begin(words, here, temporary)
    code, hung, peak = wait(process, FOLLOWED_S if {*FOLLOWS} <= {*words} else None)
    peak = LOADED_BYTES + max(0, peak - before)
    text = (here / "printed").read_text(encoding="utf-8", errors="replace")
    beside = [path.name for path in folder.rglob(".floatref-*")]
    left = (*sorted(path.name for path in temporary.iterdir()), *beside, *survivors(process))
    return Ended(tuple(words), code, hung, text, peak, left)


def resident_bytes() -> int:
    """Return the memory of this process."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def begin(words: Sequence[str], here: Path, temporary: Path) -> int:
    """Return the process that runs ``words`` in ``here``, in a session of its own."""
    process = os.fork()
    if process == 0:
        _become(words, here, temporary)
    # Before that a signal to its group finds nobody.
    while os.getpgid(process) != process:
        time.sleep(0.001)
    return process


def _become(words: Sequence[str], here: Path, temporary: Path) -> None:
    """Run the command in this process, and end it."""
    code = 99
    try:
        os.setsid()
        os.chdir(here)
        os.environ["TMPDIR"] = tempfile.tempdir = str(temporary)
        nothing = os.open(os.devnull, os.O_RDONLY)
        printed = os.open(here / "printed", os.O_WRONLY | os.O_CREAT, 0o600)
        for target, source in enumerate((nothing, printed, printed)):
            os.dup2(source, target)
        sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
        sys.stderr = open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
        # In a test a warning is an error; in a command it is a line.
        warnings.resetwarnings()
        sys.argv = list(words)
        STARTS[words[0]]()
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    except BaseException:
        import traceback

        traceback.print_exc()
    finally:
        # Of what the end of Python does: all else there is of the process that has made this one.
        remove_left()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def wait(process: int, stopped_s: float | None = None) -> tuple[int, bool, int]:
    """Return exit code, whether it had to be killed, and its peak of memory in bytes.

    It gets a SIGTERM after ``stopped_s``, if given.
    """
    begun, hung = time.monotonic(), False
    end = begun + LONGEST_S
    while True:
        if stopped_s is not None and time.monotonic() > begun + stopped_s:
            stopped_s = None
            os.kill(process, signal.SIGTERM)
        found, status, usage = os.wait4(process, os.WNOHANG)
        if found:
            return os.waitstatus_to_exitcode(status), hung, usage.ru_maxrss << 10
        if time.monotonic() > end and not hung:
            hung = True
            os.killpg(process, signal.SIGKILL)
        time.sleep(0.005)


def survivors(group: int) -> tuple[str, ...]:
    """Return a name if processes of the session are still there."""
    try:
        os.killpg(group, 0)
    except (ProcessLookupError, PermissionError):
        return ()
    os.killpg(group, signal.SIGKILL)
    return ("processes",)
