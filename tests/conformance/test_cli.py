"""The `conformance` command: exit codes and what it says."""

import json
import os
import shutil
import subprocess
import sys

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from floatref.errors import InputError
from floatref_conformance import runner
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.cli import explain as explain_command
from floatref_conformance.cli import list as list_command
from floatref_conformance.cli import run as run_command
from floatref_conformance.cli.main import main
from floatref_conformance.devices.interface import DeviceEntry, DeviceKind
from floatref_conformance.registry import Registry
from floatref_conformance.schemas import read_schema


@pytest.fixture
def call(monkeypatch, toy_check, fake_device):
    """Return a function that calls the command with toy checks and devices in place of all."""
    gains = {"good": 1.0, "bad": 0.5}
    entries = tuple(DeviceEntry(name, "toy", ("toy",) * (name == "bad")) for name in gains)

    def make(name):
        if name == "odd":
            raise ZeroDivisionError("out of luck")
        if name not in gains:
            raise InputError(f"device fake:{name}: unknown; known: good, bad")
        return fake_device(lambda tracks: {t: gains[name] * z for t, z in tracks.items()})

    kinds = {"fake": DeviceKind("fake", "NAME", make, lambda: entries)}
    skewed = toy_check(id="skewed", skew=0.1)
    checks = {c.id: c for c in (toy_check(), toy_check(id="second"), skewed)}
    registry = Registry(kinds, checks, ("plug-in sad: ImportError: gone; it is left out",))
    for module in (run_command, list_command, explain_command):
        monkeypatch.setattr(module, "load_registry", lambda: registry)
    return lambda *words: CliRunner().invoke(main, list(words))


def run(call, device, *words):
    return call("run", "--device", f"fake:{device}", "--check", "toy", *words)


def test_a_selection_that_passes_is_incomplete_and_says_what_was_not_run(call):
    answer = run(call, "good")
    assert answer.exit_code == 4
    assert "INCOMPLETE: 1 of 1 checks that ran passed" in answer.output
    assert "Not run (not selected): second, skewed" in answer.output
    assert f"Not run (not built yet): {', '.join(IDS)}" in answer.output
    assert "nothing is said of them" in answer.output


def test_a_failure_is_exit_1_with_reason_and_how_to_reproduce_it_last(call):
    answer = run(call, "bad", "--seed", "3")
    assert answer.exit_code == 1
    assert "FAIL: 0 of 1 checks that ran passed" in answer.output
    assert answer.output.rstrip().splitlines()[-1] == (
        "Reproduce with: conformance run --device fake:bad --class nominal --seed 3 --check toy"
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--device", "exec:./x"], "not a kind that works here; these do: fake:NAME"),
        (["--device", "fake:nobody"], "unknown; known: good, bad"),
        (["--device", "fake:good", "--check", "jumping"], "unknown check"),
        (["--device", "fake:good", "--check", "stop"], "not built yet"),
        (["--device", "fake:good", "--class", "superb"], "superb"),
        (["--device", "fake:good", "--effort", "endless"], "endless"),
        (["--device", "fake:odd"], "fake:odd: ZeroDivisionError: out of luck"),
        (["--device", "fake:good", "--seed", "-1"], "-1"),
        (["--waive", "x"], "No such option"),
    ],
)
def test_wrong_usage_is_exit_2_in_one_clear_line_without_a_traceback(call, words, said):
    answer = call("run", *words)
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert "Traceback" not in answer.output
    assert [line for line in answer.stderr.splitlines() if line.startswith("Error:")]


def test_a_fault_of_the_suite_is_exit_3_without_verdict_or_report(call, tmp_path):
    answer = call("run", "--device", "fake:good", "--check", "skewed", "--report", str(tmp_path))
    assert answer.exit_code == 3
    assert "the suite itself is at fault, no verdict" in answer.stderr
    assert not any(word in answer.output for word in ("PASS", "FAIL", "INCOMPLETE"))
    assert list(tmp_path.iterdir()) == []


def test_an_unexpected_error_of_the_suite_is_exit_3_and_shows_where(call, monkeypatch):
    def broken(*_):
        raise RuntimeError("bug")

    monkeypatch.setattr("floatref_conformance.runner.check_result", broken)
    answer = run(call, "good")
    assert answer.exit_code == 3
    assert "RuntimeError: bug" in answer.stderr
    assert "Traceback" in answer.stderr


@pytest.mark.parametrize("effort", ["quick", "certification"])
def test_the_report_keeps_its_schema_at_every_effort(call, tmp_path, effort):
    assert run(call, "good", "--effort", effort, "--report", str(tmp_path)).exit_code == 4
    report = json.loads((tmp_path / "report.json").read_text())
    Draft202012Validator(read_schema("conformance-report-1")).validate(report)
    assert report["effort"] == effort


@pytest.mark.parametrize("command", [["list"], ["explain", "toy"], ["run"]])
@pytest.mark.parametrize("error", [AttributeError("clause"), SystemExit(0), SystemExit(1)])
def test_an_unexpected_error_outside_a_run_is_exit_3_in_one_line(call, monkeypatch, command, error):
    def broken():
        raise error

    for module in (run_command, list_command, explain_command):
        monkeypatch.setattr(module, "load_registry", broken)
    answer = call(*command)
    assert answer.exit_code == 3
    assert answer.stderr.startswith("Error: the suite itself is at fault, no verdict: ")
    assert f"{type(error).__name__}: {error} (test_cli.py:" in answer.stderr
    assert len(answer.stderr.splitlines()) == 1


def test_an_interruption_outside_a_run_is_no_verdict_either(call, monkeypatch):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr(list_command, "load_registry", interrupted)
    answer = call("list")
    assert (answer.exit_code, answer.stderr) == (130, "Interrupted: no verdict\n")


@pytest.mark.parametrize("both", [False, True])
@pytest.mark.parametrize("words", [["list"], ["--help"], ["run", "--check", "quiescent"]])
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


def test_a_report_that_fails_after_judging_is_exit_3_beneath_the_verdict(
    call, monkeypatch, tmp_path
):
    folder = tmp_path / "report"
    judged = runner.check_result

    def losing(*arguments):
        shutil.rmtree(folder, ignore_errors=True)
        return judged(*arguments)

    monkeypatch.setattr(runner, "check_result", losing)
    answer = run(call, "good", "--report", str(folder))
    assert answer.exit_code == 3
    assert "INCOMPLETE: 1 of 1 checks that ran passed" in answer.stdout
    assert "Error: no report: FileNotFoundError" in answer.stderr
    assert "Traceback" not in answer.output


def test_an_interruption_is_no_verdict(call, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("floatref_conformance.runner.check_result", interrupted)
    answer = run(call, "good")
    assert answer.exit_code == 130
    assert "no verdict" in answer.stderr


def test_a_broken_plugin_is_reported_and_the_run_goes_on(call):
    answer = run(call, "good")
    assert "Warning: plug-in sad: ImportError: gone" in answer.stderr


def test_the_report_says_what_the_terminal_says(call, tmp_path):
    answer = run(call, "bad", "--report", str(tmp_path / "new"), "--class", "adequate")
    report = json.loads((tmp_path / "new" / "report.json").read_text())
    Draft202012Validator(read_schema("conformance-report-1")).validate(report)
    assert (report["verdict"], report["class"]) == ("FAIL", "adequate")
    assert report["device"]["spec"] == "fake:bad"
    outcomes = {c["id"]: c["outcome"] for c in report["checks"]}
    assert outcomes.pop("toy") == "fail"
    assert set(outcomes.values()) == {"skip"}
    assert answer.exit_code == 1


def test_the_same_seed_writes_the_same_bytes(call, tmp_path):
    texts = []
    for name in ("a", "b"):
        run(call, "bad", "--report", str(tmp_path / name))
        texts.append((tmp_path / name / "report.json").read_bytes())
    assert texts[0] == texts[1]


def test_a_report_that_cannot_be_written_is_exit_2_before_anything_runs(call, tmp_path):
    (tmp_path / "file").write_text("")
    answer = run(call, "good", "--report", str(tmp_path / "file" / "below"))
    assert answer.exit_code == 2
    assert "toy" not in answer.stdout


def test_piped_output_is_plain_lines_without_control_codes(call):
    answer = run(call, "good")
    assert "\x1b" not in answer.output
    assert "toy: 2 cases" in answer.stdout
    assert "toy: pass" in answer.stdout


def test_list_names_checks_built_and_not_and_devices_with_what_they_must_fail(call):
    listing = json.loads(call("list", "--json").stdout)
    checks = {c["id"]: c for c in listing["checks"]}
    assert checks["toy"]["built"]
    assert checks["toy"]["clause"] == "Toy 1.2"
    assert not checks["stop"]["built"]
    assert listing["devices"][1] == {"spec": "fake:bad", "summary": "toy", "fails": ["toy"]}
    words = call("list").stdout
    assert "stop" in words
    assert "not built yet" in words
    assert "fake:bad" in words


def test_explain_prints_clause_derivation_floor_and_the_devices_that_must_fail(call, toy_check):
    answer = call("explain", "toy")
    for text in ("Clause: Toy 1.2", "by hand", "the road", "Must fail: fake:bad"):
        assert text in answer.stdout
    assert call("explain", "nonsense").exit_code == 2
    assert call("explain", "stop").exit_code == 2


def test_help_needs_no_compiler(tmp_path):
    code = (
        "import sys; from click.testing import CliRunner; "
        "from floatref_conformance.cli.main import main; "
        "[CliRunner().invoke(main, w) for w in (['--help'], ['run', '--help'])]; "
        "sys.exit(bool({'numba', 'scipy.signal'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
