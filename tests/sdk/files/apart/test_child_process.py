"""What is read in another process is what is read in this one, or it is refused in one line."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import InputError, read_apart
from floatref.files.apart import child_process

BROKEN = "run.xyz: no sound file"
READING = f"""
import sys, threading
from floatref import read_apart
def read():
    for _ in read_apart("{__name__}:hang_in_a_library", (sys.argv[1],), ""):
        print("reads", flush=True)
threading.Thread(target=read).start() if sys.argv[2] == "thread" else read()
"""
DEAF = f"""
import signal
from floatref import read_apart
signal.signal(signal.SIGINT, lambda *_: None)
for answer in read_apart("{__name__}:wait_for", (0.0, 1.0), "broken"):
    print(answer, flush=True)
"""


@pytest.fixture(autouse=True, scope="module")
def importable() -> Iterator[None]:
    """Let other processes import this module, of which they run functions."""
    root = str(Path(__file__).parents[4])
    sys.path.insert(0, root)
    yield
    sys.path.remove(root)


def pieces(values: list[float]) -> Iterator[object]:
    for value in values:
        yield np.array([value])
        yield {"value": value}


def refuse(name: str) -> Iterator[object]:
    yield 1
    raise InputError(f"{name}: a hole at 3 m")


def break_down(how: str) -> Iterator[object]:
    yield 1
    if how == "abort":
        os.abort()
    if how == "leave":
        os._exit(0)
    if how == "other":
        raise ValueError("of the library")
    if how == "print":
        sys.stdout.buffer.write(b"not an answer")
        sys.stdout.flush()
    if how == "swell":
        yield np.ones(1 << 27).size
    time.sleep(60)
    yield 2


def count_on(path: str) -> Iterator[object]:
    Path(path).write_text(str(os.getpid()))
    yield from range(1_000_000)


def hang_in_a_library(path: str) -> Iterator[object]:
    Path(path).write_text(str(os.getpid()))
    yield 1
    # A search without an end, in which no other thread of Python runs.
    re.match("(a+)+b", "a" * 60)


def wait_for(*seconds: float) -> Iterator[object]:
    for each in seconds:
        time.sleep(each)
        yield each


def memory_limit() -> Iterator[object]:
    import resource

    yield resource.getrlimit(resource.RLIMIT_AS)[0]


def runs(process: int) -> bool:
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state not in "ZX"


def start(program: str, *words: str) -> "subprocess.Popen[bytes]":
    """Start ``program`` in a group of its own, where it can import this module."""
    return subprocess.Popen(
        [sys.executable, "-c", program, *words],
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(each for each in sys.path if each)},
        process_group=0,
    )


def name(function: object) -> str:
    return f"{__name__}:{function.__name__}"  # type: ignore[attr-defined]


@settings(deadline=None, max_examples=5)
@given(st.lists(st.floats(allow_nan=False), max_size=4))
def test_it_yields_what_the_function_yields(values: list[float]) -> None:
    assert list(read_apart(name(pieces), (values,), BROKEN)) == list(pieces(values))


def test_an_error_of_the_input_has_its_own_text_and_comes_behind_what_was_read() -> None:
    answers = read_apart(name(refuse), ("road.xyz",), BROKEN)
    assert next(answers) == 1
    with pytest.raises(InputError, match=r"^road\.xyz: a hole at 3 m$"):
        next(answers)


@pytest.mark.parametrize("how", ["abort", "leave", "other", "print", "hang", "swell"])
def test_a_function_that_breaks_down_does_no_harm(how: str) -> None:
    silence_s = 0.5 if how == "hang" else None
    answers = read_apart(name(break_down), (how,), BROKEN, silence_s, most_memory=1 << 29)
    assert next(answers) == 1
    with pytest.raises(InputError, match=rf"^{BROKEN}$"):
        next(answers)


def test_one_that_does_not_exist_is_refused() -> None:
    with pytest.raises(InputError, match=rf"^{BROKEN}$"):
        list(read_apart(f"{__name__}:nothing", (), BROKEN))


def test_a_reader_that_is_left_early_leaves_no_process(tmp_path: Path) -> None:
    path = tmp_path / "number"
    answers = read_apart(name(count_on), (str(path),), BROKEN)
    assert [next(answers), next(answers)] == [0, 1]
    answers.close()  # type: ignore[attr-defined]
    with pytest.raises(ProcessLookupError):
        os.kill(int(path.read_text()), 0)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the state of a process in /proc")
@pytest.mark.parametrize("where", ["main", "thread"])
def test_one_that_hangs_ends_with_a_parent_that_is_killed(tmp_path: Path, where: str) -> None:
    path = tmp_path / "number"
    with start(READING, str(path), where) as parent:
        assert parent.stdout is not None
        assert parent.stdout.readline() == b"reads\n"
        process = int(path.read_text())
        assert runs(process)
        parent.kill()
    end = time.monotonic() + 20
    while (alive := runs(process)) and time.monotonic() < end:
        time.sleep(0.01)
    if alive:
        os.kill(process, 9)
    assert not alive


def test_one_that_does_not_take_its_request_is_refused_in_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(child_process, "COMMAND", "import time; time.sleep(60)")
    monkeypatch.setattr(child_process, "LONGEST_SILENCE_S", 0.5)
    begun = time.monotonic()
    with pytest.raises(InputError, match=rf"^{BROKEN}$"):
        list(read_apart(name(pieces), (b"x" * (1 << 20),), BROKEN))
    assert time.monotonic() - begun < 30


def test_ctrl_c_as_the_watch_starts_leaves_no_thread_that_python_waits_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    class Interrupted(threading.Timer):
        def start(self) -> None:
            super().start()
            raise KeyboardInterrupt

    before = set(threading.enumerate())
    monkeypatch.setattr(child_process, "Timer", Interrupted)
    with pytest.raises(KeyboardInterrupt):
        list(read_apart(name(pieces), ([1.0],), BROKEN))
    assert all(thread.daemon for thread in set(threading.enumerate()) - before)


def test_a_lower_limit_of_memory_that_the_user_has_set_stays() -> None:
    resource = pytest.importorskip("resource", reason="Windows has no such limit")
    before, lower = resource.getrlimit(resource.RLIMIT_AS), 1 << 36
    resource.setrlimit(resource.RLIMIT_AS, (lower, before[1]))
    try:
        answers = read_apart(name(memory_limit), (), BROKEN, most_memory=1 << 37)
        assert list(answers) == [lower]
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="Windows has no such groups")
def test_a_signal_to_the_group_is_answered_by_the_parent_alone() -> None:
    with start(DEAF) as parent:
        assert parent.stdout is not None
        assert parent.stdout.readline() == b"0.0\n"
        os.killpg(parent.pid, signal.SIGINT)
        assert parent.stdout.read() == b"1.0\n"
    assert parent.returncode == 0
