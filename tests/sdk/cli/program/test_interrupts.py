"""Signals that end a command: one line, exit code 130 and no file, wherever they come."""

import gc
import signal
import subprocess
import sys
import time
import weakref
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import click
import pytest

from floatref.cli.batch.interruption import interruptible
from floatref.cli.program.interrupts import Interrupt, raising_interrupt

pytestmark = pytest.mark.posix

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
WORK = """
import os, signal, sys, time
from pathlib import Path
from floatref.files.atomic import replace_file

def command():
    with replace_file(Path("road.erd")) as beside:
        beside.write_text("half")
        try:
            os.kill(os.getpid(), int(sys.argv[2]))
            time.sleep(600)
        finally:
            # Impatience does not hinder what has to be removed.
            os.kill(os.getpid(), int(sys.argv[2]))
            [0 for _ in range(10**6)]
"""
PROGRAM = """
import click, signal, sys

# A test that was started by nohup, or behind a shell's &, hands on signals that are ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
for each in (signal.SIGTERM, signal.SIGHUP):
    signal.signal(each, signal.SIG_DFL)

from floatref.cli.lazy import LazyGroup
from floatref.cli.program.starting import start_program
import work as module

where = sys.argv[1]
run = module.command
module.click_command = click.command("inside")(click.argument("number")(lambda number: run()))
group = LazyGroup("prog", lazy={"inside": ("work:click_command", "works")})

class Outside(click.Group):
    def invoke(self, ctx):
        return run()

def main():
    if where == "inside":
        group()
    else:
        Outside("prog", commands={"outside": module.click_command})()

sys.modules["program_main"] = sys.modules[__name__]
start_program("program_main", "Interrupted")
"""


@pytest.mark.parametrize("where", ["inside", "outside"])
@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_is_a_line_and_130_and_leaves_nothing(
    tmp_path: Path, number: signal.Signals, where: str
) -> None:
    """``outside``: click itself would say `Aborted!` and end with 1."""
    code = tmp_path / "code"
    code.mkdir()
    (code / "work.py").write_text(WORK, encoding="utf-8")
    (code / "program.py").write_text(PROGRAM, encoding="utf-8")
    (tmp_path / "here").mkdir()
    words = [sys.executable, str(code / "program.py"), where, str(int(number))]
    done = subprocess.run(
        words, cwd=tmp_path / "here", capture_output=True, text=True, timeout=600, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "Interrupted\n")
    assert list((tmp_path / "here").iterdir()) == []


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_that_was_ignored_stays_so(tmp_path: Path, number: signal.Signals) -> None:
    text = (
        f"import os, signal; signal.signal({int(number)}, signal.SIG_IGN)\n"
        "from floatref.cli.program.interrupts import raising_interrupt\n"
        f"with raising_interrupt():\n    os.kill(os.getpid(), {int(number)})\nprint('goes on')\n"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "goes on\n", "")


def test_a_command_whose_loading_is_interrupted_says_what_is_missing(tmp_path: Path) -> None:
    """Most of the time of a short command is the loading of modules."""
    text = (
        "import os, signal, sys\n"
        "class Hit:\n"
        "    def find_spec(name, path=None, target=None):\n"
        "        if name == 'floatref_conformance.cli.table':\n"
        "            os.kill(os.getpid(), signal.SIGTERM)\n"
        "            [0 for _ in range(10**6)]\n"
        "sys.meta_path.insert(0, Hit)\n"
        "sys.argv[1:] = ['table', '--json']\n"
        "from floatref_conformance.__main__ import start\n"
        "start()\n"
    )
    words = [sys.executable, "-c", text]
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "Interrupted: no table\n")


def _wait() -> None:
    """Wait a minute, in pieces: one call would not end by a signal just before it."""
    for _ in range(1200):
        time.sleep(0.05)


class Referred:
    """An object that a weak reference waits for."""


class Lasting:
    """An object whose finalizer takes a while, and gets a signal meanwhile."""

    def __del__(self) -> None:
        signal.raise_signal(signal.SIGTERM)
        time.sleep(0.1)


def _in_a_callback() -> None:
    came = []

    def collect(*_: object) -> None:
        if not came:
            came.append(True)
            signal.raise_signal(signal.SIGTERM)
            time.sleep(0.1)

    gc.callbacks.append(collect)
    try:
        gc.collect()
        _wait()
    finally:
        gc.callbacks.remove(collect)


def _in_a_finalizer() -> None:
    Lasting()
    _wait()


def _for_a_weak_reference() -> None:
    referred = Referred()
    reference = weakref.ref(referred, lambda _: (signal.raise_signal(signal.SIGTERM), None)[1])
    del referred
    assert reference() is None
    _wait()


@contextmanager
def _batch() -> Iterator[None]:
    """End as `floatref batch` does, whose own handler ends the command."""
    with pytest.raises(click.exceptions.Exit), interruptible(lambda: "Interrupted"):
        yield
    raise Interrupt


@pytest.mark.parametrize("work", [_in_a_callback, _in_a_finalizer, _for_a_weak_reference])
@pytest.mark.parametrize("handled", [raising_interrupt, _batch])
def test_a_signal_whose_exception_python_drops_comes_again(
    work: Callable[[], None], handled: Callable[[], AbstractContextManager[None]]
) -> None:
    """Hypothesis has a callback of the collector, in which every tenth signal was lost."""
    begun = time.monotonic()
    with pytest.raises(Interrupt), handled():
        work()
    assert time.monotonic() - begun < 50.0


class Leaving:
    """An object whose finalizer ends the program, which Python drops."""

    def __del__(self) -> None:
        raise SystemExit(3)


@pytest.mark.parametrize("handled", [raising_interrupt, lambda: interruptible(lambda: "never")])
def test_what_others_raise_and_python_drops_sends_no_signal(
    handled: Callable[[], AbstractContextManager[None]], monkeypatch: pytest.MonkeyPatch
) -> None:
    told = list[type[BaseException]]()
    monkeypatch.setattr(sys, "unraisablehook", lambda dropped: told.append(dropped.exc_type))
    with handled():
        Leaving()
        time.sleep(0.1)
    assert told == [SystemExit]


class Closing:
    """An object whose finalizer runs while the terminal is closed."""

    def __del__(self) -> None:
        signal.raise_signal(signal.SIGHUP)
        time.sleep(0.1)


def _work_in_batch(heard: list[str]) -> None:
    with raising_interrupt(), interruptible(lambda: heard.append("once") or "Interrupted"):
        Closing()
        _wait()


def test_a_signal_of_the_outer_handler_comes_again_in_batch() -> None:
    """That a terminal is closed is no signal of batch's own."""
    heard = list[str]()
    with pytest.raises(click.exceptions.Exit):
        _work_in_batch(heard)
    assert heard == ["once"]
