"""Devices that are programs: made, started once, started again, timed, judged."""

import json
import os
import shlex
import signal
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner

from floatref.errors import InputError
from floatref.files import write_recording
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording
from floatref_conformance.cli.main import main
from floatref_conformance.devices import executable
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError, DeviceHung, DeviceSkipped
from floatref_conformance.judge.exercise import close, describe, exercise

SOUND = "start()\nwhile True: sound(ask())"
STARTS = "open('starts', 'a').write('x')\n"


def starts(folder):
    return len((folder / "starts").read_text())


def test_a_sound_program_is_started_once_runs_and_ends(device, recording, tmp_path):
    one = device(STARTS + "start()\nfor n in range(3): sound(ask())\nassert ask()['cmd'] == 'stop'")
    description = describe(one)
    assert description == Description("written", "1", "temporal", ())
    for _ in range(3):
        profile = exercise(one, description, recording)
        assert {track.name for track in profile.tracks} == {"left", "right"}
    assert close(one) == ""
    assert close(one) == ""
    assert starts(tmp_path) == 1


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "timeout_s", "error", "words"),
    [
        ("os.kill(os.getpid(), 9)", None, DeviceError, "run: was killed by SIGKILL"),
        ("tell({'seq': c['seq'] - 1}, ok=True)", None, DeviceError, "answered seq 1, expected 2"),
        ("hang()", 0.5, DeviceHung, "run: no answer within 0.5 s"),
    ],
)
def test_after_a_fault_it_is_started_again_for_the_next_run(
    device, recording, tmp_path, fault, timeout_s, error, words
):
    bad = f"if open('starts').read() == 'x':\n    c = ask()\n    {fault}\n    hang()\n"
    one = device(f"{STARTS}start()\n{bad}while True: sound(ask())", timeout_s=timeout_s)
    description = describe(one)
    with pytest.raises(error, match=words):
        exercise(one, description, recording)
    one.timeout_s = None
    exercise(one, description, recording)
    exercise(one, description, recording)
    assert close(one) == ""
    assert starts(tmp_path) == 2


def test_an_error_or_a_skip_is_no_reason_to_start_again(device, recording, tmp_path):
    one = device(
        f"{STARTS}start()\ntell(ask(), error='dark')\nc = ask()\n"
        "tell(c, skipped=f\"no room in {c['profile']}\")\nwhile True: sound(ask())"
    )
    description = describe(one)
    with pytest.raises(DeviceError, match=r"^run: answered an error: dark$"):
        exercise(one, description, recording)
    with pytest.raises(DeviceSkipped, match=r"^no room in …/profile$"):
        exercise(one, description, recording)
    exercise(one, description, recording)
    assert starts(tmp_path) == 1
    assert close(one) == ""


def test_an_end_between_runs_is_charged_to_the_next(device, recording):
    one = device("start()\nsound(ask())")
    description = describe(one)
    exercise(one, description, recording)
    with pytest.raises(DeviceError, match="run: exited with status 0 before it answered"):
        exercise(one, description, recording)
    exercise(one, description, recording)
    assert close(one) == ""


def test_a_device_that_becomes_another_is_refused(device, recording):
    one = device(
        f"{STARTS}SAID['name'] = open('starts').read()\nstart()\nask()\nos._exit(1)", timeout_s=9.0
    )
    description = describe(one)
    for words in ("exited with status 1", "the description differs from that at the first start"):
        with pytest.raises(DeviceError, match=words):
            exercise(one, description, recording)


@pytest.mark.slow
def test_a_start_that_hangs_is_a_hang_and_a_stop_that_hangs_is_told(device):
    with pytest.raises(DeviceHung, match=r"^start: no answer within 0\.3 s$"):
        describe(device("hang()", start_s=0.3))
    one = device("start()\nescape(hang)\nhang()", stop_s=0.3)
    describe(one)
    assert close(one).startswith("stop: still running after 0.3 s")


@pytest.mark.posix
def test_an_interrupt_leaves_no_process_behind(device, recorded, tmp_path):
    one = device("start()\nask()\nescape(hang)\nos.kill(os.getppid(), signal.SIGINT)\nhang()")
    describe(one)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            one.run(recorded, tmp_path / "profile")
    finally:
        signal.signal(signal.SIGINT, before)
    assert close(one) == ""


def test_the_length_is_that_of_the_longest_channel(tmp_path):
    uniform, stamped = UniformClock.of(100.0, 5.0), StampedClock.of(np.array([1.0, 2.0, 8.5]))
    channels = (
        Channel.of("height", np.ones(301), uniform, "main"),
        Channel.of("vertical_specific_force", np.ones(101), uniform, "main"),
        Channel.of("distance", np.arange(3.0), stamped),
    )
    write_recording(Recording(channels), tmp_path / "r")
    assert executable.length_s(tmp_path / "r" / "recording.json") == 7.5


def test_the_limit_is_a_minute_and_twice_the_length_unless_it_is_set(device, recorded, monkeypatch):
    one = device("start()\nask()")
    limits = []
    monkeypatch.setattr(
        executable.Session, "run", lambda self, recording, profile, limit_s: limits.append(limit_s)
    )
    one.run(recorded, recorded)
    one.timeout_s = 7.0
    one.run(recorded, recorded)
    assert limits == [60.0 + 2.0 * 1.995, 7.0]
    assert close(one) == ""


def test_a_command_line_is_split_as_a_posix_shell_would_and_no_shell_sees_it(tmp_path):
    line = f"{sys.executable} -c pass 'a b' $HOME \"; id\" c\\ d"
    assert executable.make(line).argv[1:] == ("-c", "pass", "a b", "$HOME", "; id", "c d")


@pytest.mark.posix
def test_a_program_is_found_on_the_path_or_from_the_folder(tmp_path, monkeypatch):
    program = tmp_path / "bin" / "firmware"
    program.parent.mkdir()
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    assert executable.make("bin/firmware -v").argv == (str(program), "-v")
    monkeypatch.setenv("PATH", str(program.parent))
    found = executable.make("firmware")
    assert found.argv == (str(program),)
    assert found.folder == tmp_path


@pytest.mark.posix
@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("no-such-program --x", "command no-such-program not found; check"),
        ("./missing", r"command \./missing not found; check"),
        ("plain", r"command plain not found; for the file in this folder write \./plain"),
        ("./plain", r"\./plain may not be executed; make it executable"),
        ("./folder", r"\./folder is a folder"),
        ("'unclosed", "No closing quotation; quote as in a POSIX shell"),
        ("  ", "no command; give the program and its arguments"),
        ("'' x", "no command"),
    ],
)
def test_a_command_that_cannot_be_found_is_named(tmp_path, monkeypatch, line, words):
    (tmp_path / "plain").write_text("#!/bin/sh\n")
    (tmp_path / "folder").mkdir()
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        InputError, match=f"^device exec:{line.split()[0] if line.strip() else ''}.*{words}"
    ):
        executable.make(line)


@pytest.mark.posix
def test_what_the_system_cannot_start_is_a_fault_of_start(tmp_path):
    program = tmp_path / "broken"
    program.write_bytes(b"\0\0\0\0")
    program.chmod(0o755)
    with pytest.raises(DeviceError, match=r"^start: .*broken cannot be started \(Exec format"):
        describe(executable.make(str(program)))


def test_a_judged_program_that_crashes_fails_and_is_named(written, tmp_path):
    line = shlex.join(written("print('no licence', file=sys.stderr)\nsys.exit(5)"))
    words = ["run", "--device", f"exec:{line}", "--check", "quiescent", "--report", f"{tmp_path}/r"]
    done = CliRunner().invoke(main, words)
    assert done.exit_code == 1, done.output
    checks = json.loads((tmp_path / "r" / "report.json").read_text())["checks"]
    judged = next(check for check in checks if check["id"] == "quiescent")
    assert judged["outcome"] == "error"
    assert "start: exited with status 5 before it answered ; stderr: no lic" in judged["reason"]


@pytest.mark.posix
@pytest.mark.slow
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_an_interrupted_judge_gives_no_verdict_and_leaves_no_process(written, tmp_path, name):
    body = (
        "escape(lambda: (print(os.getpid(), file=open('pid', 'w'), flush=True), hang()))\n"
        "while not (os.path.exists('pid') and open('pid').read()): time.sleep(0.01)\n"
        f"ask()\nos.kill(os.getppid(), signal.{name})\nhang()"
    )
    judge = [sys.executable, "-m", "floatref_conformance", "run", "--check", "quiescent"]
    done = subprocess.run(
        [*judge, "--device", f"exec:{shlex.join(written(body))}"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        # A shell that runs the tests in the background lets them, and the judge, ignore it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert done.returncode == 130, done.stderr
    assert "Interrupted: no verdict" in done.stderr
    with pytest.raises(ProcessLookupError):
        os.kill(int((tmp_path / "pid").read_text()), 0)
