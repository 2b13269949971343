"""What goes wrong outside a run: one line, and an exit code that is never that of a verdict."""

import os
import subprocess
import sys

import pytest

from floatref.cli.program.interrupts import Ending
from floatref_conformance.cli import explain as explain_command
from floatref_conformance.cli import list as list_command
from floatref_conformance.cli import replay as replay_command
from floatref_conformance.cli import run as run_command


@pytest.mark.parametrize("command", ["list", "explain", "run", "replay"])
@pytest.mark.parametrize("error", [AttributeError("clause"), SystemExit(0), SystemExit(1)])
def test_an_unexpected_error_outside_a_run_is_exit_3_in_one_line(
    call, monkeypatch, keep, tmp_path, command, error
):
    def broken(edition):
        raise error

    for module in (run_command, list_command, explain_command, replay_command):
        monkeypatch.setattr(module, "load_registry", broken)
    words = {"explain": ["toy"], "replay": [keep(tmp_path), "--device", "fake:good"]}
    answer = call(command, *words.get(command, []))
    assert answer.exit_code == 3
    assert answer.stderr.startswith("Error: the suite itself is at fault, no verdict: ")
    assert f"{type(error).__name__}: {error} (test_no_verdict.py:" in answer.stderr
    assert len(answer.stderr.splitlines()) == 1


def test_a_check_that_breaks_in_a_replay_is_no_verdict(call, keep, tmp_path, registry, toy_check):
    class Broken(toy_check):
        def judge(self, case, bench):
            raise KeyError("left")

    registry.checks["toy"] = Broken()
    answer = call("replay", keep(tmp_path), "--device", "fake:good")
    assert answer.exit_code == 3
    assert "KeyError: 'left'" in answer.stderr
    assert not any(word in answer.stdout for word in ("PASS", "FAIL", "INCOMPLETE"))


def test_an_interruption_outside_a_run_is_no_verdict_either(call, monkeypatch):
    def interrupted(edition):
        raise KeyboardInterrupt

    monkeypatch.setattr(list_command, "load_registry", interrupted)
    answer = call("list")
    assert (answer.exit_code, answer.stderr) == (130, "Interrupted: no verdict\n")


def test_a_signal_beside_the_command_is_no_fault_of_the_suite(call, monkeypatch):
    """Between the handlers of program and command, the program's own ends it."""

    def ended(edition):
        raise Ending(130)

    monkeypatch.setattr(list_command, "load_registry", ended)
    answer = call("list")
    assert (answer.exit_code, answer.stderr) == (130, "")


@pytest.mark.slow
@pytest.mark.parametrize("both", [False, pytest.param(True, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "words",
    [
        ["list"],
        *(pytest.param(w, marks=pytest.mark.slow) for w in (["--help"], ["explain", "stop"])),
    ],
)
def test_output_that_nobody_reads_is_exit_3_and_never_a_verdict(words, both):
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "floatref_conformance", *words]
    stderr = writing if both else subprocess.PIPE
    done = subprocess.run(command, stdout=writing, stderr=stderr, text=True, check=False)
    os.close(writing)
    assert done.returncode == 3
    if not both:
        assert done.stderr == "Error: nobody reads the output any more, no verdict\n"
