"""A child process: what comes of it in time, and that nothing comes of it afterwards."""

import ctypes
import json
import os
import subprocess
import sys
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.devices import process
from floatref_conformance.devices.pipes import TAIL_BYTES
from floatref_conformance.devices.process import readable
from floatref_conformance.errors import DeviceError, DeviceHung

LONG_S = 600.0
"""Limit that nothing here comes near."""
PR_GET_CHILD_SUBREAPER = 37


def is_adopting():
    adopts = ctypes.c_int()
    ctypes.CDLL(None).prctl(PR_GET_CHILD_SUBREAPER, ctypes.byref(adopts), 0, 0, 0)
    return bool(adopts.value)


def asked(child):
    child.send(b"{}\n")
    return child.receive(LONG_S)


def is_there(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.fixture
def child(written, tmp_path):
    """Return a function that starts a program; all are ended."""
    started = []

    def start(body):
        started.append(process.start(written(body), tmp_path))
        return started[-1]

    yield start
    for one in started:
        one.kill()


def test_a_device_has_what_programs_need_but_is_not_told_where_the_truth_is_kept(
    child, monkeypatch
):
    monkeypatch.setenv("FLOATREF_CACHE", "/somewhere/secret")
    monkeypatch.setenv("OMP_NUM_THREADS", "kept")
    reporter = child("sys.stdin.readline()\nprint(json.dumps(dict(os.environ)), flush=True)")
    found = json.loads(asked(reporter))
    assert found["OMP_NUM_THREADS"] == "kept"
    assert not [name for name, value in found.items() if value == "/somewhere/secret"]


def test_lines_go_in_and_out(child):
    echo = child("for line in sys.stdin: print(line.strip()[::-1], flush=True)")
    for word in (b"one", b"two"):
        echo.send(word + b"\n")
        assert echo.receive(LONG_S) == word[::-1]
    assert echo.finish(LONG_S) == ()


def test_no_shell_sees_the_arguments(tmp_path):
    words = ["$HOME", "*", "; exit 7", "`id`", "a  b", "'"]
    argv = [sys.executable, "-c", "import sys, json; print(json.dumps(sys.argv[1:]))", *words]
    child = process.start(argv, tmp_path)
    assert json.loads(child.receive(LONG_S)) == words
    child.kill()


def test_the_folder_is_the_one_given(child, tmp_path):
    assert child("print(os.getcwd(), flush=True)").receive(LONG_S) == os.fsencode(tmp_path)


@pytest.mark.parametrize(
    ("argv", "why"),
    [
        (["/no/such/program"], "No such file"),
        (["/"], "Permission denied"),
        (["nul\0inside"], "null byte"),
    ],
)
def test_what_cannot_be_started_is_a_fault_and_leaves_nothing(argv, why, tmp_path):
    with pytest.raises(DeviceError, match=f"cannot be started .*{why}"):
        process.start(argv, tmp_path)
    assert not is_adopting()


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "fate"),
    [
        ("sys.exit(3)", "exited with status 3"),
        ("pass", "exited with status 0"),
        ("raise ValueError('oh')", "exited with status 1"),
        ("os.kill(os.getpid(), signal.SIGSEGV)", "was killed by SIGSEGV"),
        ("os.kill(os.getpid(), signal.SIGRTMIN + 3)", "was killed by signal"),
        ("os.close(1); hang()", "closed its standard output"),
    ],
)
def test_an_end_without_an_answer_says_how_it_ended(child, body, fate):
    with pytest.raises(DeviceError, match=f"{fate}.* before it answered") as caught:
        child(f"import resource; resource.setrlimit(resource.RLIMIT_CORE, (0, 0))\n{body}").receive(
            LONG_S
        )
    assert not isinstance(caught.value, DeviceHung)


def test_an_answer_before_the_end_is_heard(child):
    answering = child("print('done', flush=True); os._exit(5)")
    assert answering.receive(LONG_S) == b"done"
    with pytest.raises(DeviceError, match="exited with status 5"):
        answering.finish(LONG_S)


def test_an_end_is_noticed_though_another_process_holds_the_pipes(child):
    with pytest.raises(DeviceError, match="exited with status 4 before"):
        child("escape(hang)\nos._exit(4)").receive(LONG_S)


def test_silence_is_noticed_and_an_unfinished_line_shown(child):
    with pytest.raises(DeviceHung, match=r"^no answer within 0\.2 s$"):
        child("hang()").receive(0.2)
    writing = child("os.write(1, b'almost'); os.write(2, b'x'); hang()")
    while not writing._lines.rest:
        time.sleep(0.01)
    with pytest.raises(DeviceHung, match="in the middle of a line: almost"):
        writing.receive(0.0)


def test_a_process_that_stays_after_the_end_of_input_is_noticed(child):
    with pytest.raises(DeviceHung, match=r"still running after 0\.2 s"):
        child("hang()").finish(0.2)


def test_a_flood_of_standard_error_keeps_nobody_waiting_and_its_end_is_shown(child):
    noisy = child(
        "for n in range(300): sys.stderr.write(f'{n:0>9999}\\n')\n"
        "print('done', file=sys.stderr)\nprint('ok', flush=True)"
    )
    assert noisy.receive(LONG_S) == b"ok"
    noisy.finish(LONG_S)
    assert noisy.describe_stderr().endswith(" | done")
    assert len(noisy._tail.end) == TAIL_BYTES
    assert len(noisy.describe_stderr()) < 1100


def test_standard_error_is_shown_on_one_printable_line(child):
    talking = child("sys.stderr.buffer.write(b'a\\x1b[31mb\\xff\\r\\n\\n  c\\td\\n'); sys.exit(1)")
    with pytest.raises(DeviceError):
        talking.receive(LONG_S)
    assert talking.describe_stderr() == " ; stderr: a [31mb\ufffd | c d"


def test_a_program_that_reads_nothing_keeps_nobody_waiting(child):
    deaf = child("hang()")
    deaf.send(b"y" * 5_000_000)
    with pytest.raises(DeviceHung):
        deaf.receive(0.1)


ESCAPES = {
    "a child": "subprocess.Popen([sys.executable, '-c', WAIT], stdout=into)",
    "a session of its own": (
        "subprocess.Popen([sys.executable, '-c', WAIT], stdout=into, start_new_session=True)"
    ),
    "an orphan that ignores signals": "escape(lambda: (here(), hang()))",
    "an orphan without our environment": (
        "escape(lambda: (os.dup2(into, 1), "
        "os.execve(sys.executable, [sys.executable, '-c', WAIT], {})))"
    ),
    "an orphan of an orphan": ("escape(lambda: (escape(lambda: (here(), hang())), os._exit(0)))"),
}


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.parametrize("way", ESCAPES)
@pytest.mark.parametrize("leaves", ["hang()", "os._exit(0)"])
def test_what_comes_from_a_program_ends_with_it(child, way, leaves, tmp_path):
    body = f"""\
WAIT = "import os, time; print(os.getpid(), flush=True); time.sleep(3600)"
out, into = os.pipe()
os.set_inheritable(into, True)
def here(): os.write(into, f"{{os.getpid()}}\\n".encode())
{ESCAPES[way]}
print(os.read(out, 100).decode().strip(), flush=True)
{leaves}
"""
    program = child(body)
    escaped = int(program.receive(LONG_S))
    assert is_there(escaped) or leaves != "hang()"
    program.kill()
    assert not is_there(escaped)
    assert not is_adopting()


@pytest.mark.posix
def test_processes_of_others_are_left_alone(child):
    wait = [sys.executable, "-c", "import time; time.sleep(3600)"]
    before = subprocess.Popen(wait, start_new_session=True)
    program = child("escape(hang)\nprint('up', flush=True)\nhang()")
    during = subprocess.Popen(wait)
    other = child("escape(hang)\nprint('up', flush=True)\nask()")
    try:
        assert program.receive(LONG_S) == other.receive(LONG_S) == b"up"
        program.kill()
        assert before.poll() is None
        assert during.poll() is None
        assert other._process.poll() is None
        assert is_adopting()
        other.kill()
    finally:
        for one in (before, during):
            one.kill()
            one.wait()


@pytest.mark.slow
def test_a_judge_that_forgets_its_device_ends_it_when_it_ends_itself(written, tmp_path):
    forgetful = (
        "import sys; from pathlib import Path; from floatref_conformance.devices import process\n"
        "child = process.start(sys.argv[1:], Path.cwd())\n"
        "print(child.receive(60.0).decode())"
    )
    argv = written("escape(hang)\nprint(os.getpid(), flush=True)\nhang()")
    judge = [sys.executable, "-c", forgetful, *argv]
    done = subprocess.run(judge, capture_output=True, text=True, check=True, timeout=LONG_S)
    assert not is_there(int(done.stdout))


@settings(deadline=None, max_examples=100)
@given(st.one_of(st.text(max_size=300), st.binary(max_size=300)), st.integers(1, 50))
def test_what_is_shown_is_one_short_line_that_prints(text, longest):
    shown = readable(text, longest)
    assert shown.isprintable()
    assert len(shown) <= longest
    assert shown == shown.strip()


@given(st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=50))
def test_a_plain_word_is_shown_as_it_is(word):
    assert readable(word) == readable(word.encode()) == word
