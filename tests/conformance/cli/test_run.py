"""`conformance run`: exit codes, what it says, and the report it leaves."""

import json
import os
import shlex
import shutil
import subprocess
import sys
from contextlib import suppress

import pytest
from jsonschema import Draft202012Validator

from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.cli import run as run_command
from floatref_conformance.judge import trial
from floatref_conformance.render.terminal import PipedConsole, TerminalRenderer
from floatref_conformance.schemas import read_schema


def report_in(folder):
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    Draft202012Validator(read_schema("conformance-report-1")).validate(report)
    return report


def files_in(folder):
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}


def test_a_selection_that_passes_is_incomplete_and_says_what_was_not_run(run_toy):
    answer = run_toy("good")
    assert answer.exit_code == 4
    assert "INCOMPLETE: 1 of 1 checks that ran passed" in answer.output
    assert "Not run (not selected): second, skewed, needy" in answer.output
    unwrapped = " ".join(answer.output.split())
    assert f"Not run (not built yet): {', '.join(IDS)}" in unwrapped
    assert "not run and not judged" in answer.output


@pytest.mark.slow
def test_a_failure_is_exit_1_with_reason_and_how_to_reproduce_it_last(run_toy):
    answer = run_toy("bad", "--seed", 3)
    assert answer.exit_code == 1
    assert "FAIL: 0 of 1 checks that ran passed" in answer.output
    assert answer.output.rstrip().splitlines()[-1] == (
        "Reproduce with: conformance run --device fake:bad --class nominal --seed 3 --check toy"
    )


def test_a_whole_suite_that_passes_is_exit_0(call, registry, toy_check, monkeypatch):
    monkeypatch.setattr("floatref_conformance.registry.not_built", lambda built: ())
    for id_ in ("skewed", "needy"):
        registry.checks.pop(id_)
    answer = call("run", "--device", "fake:good")
    assert answer.exit_code == 0
    assert answer.stdout.splitlines()[-1].startswith("PASS: 2 of 2 checks that ran passed")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("device", "code", "said"),
    [
        ("choosy", 4, "too fast for me"),
        ("broken", 1, "out of paper"),
    ],
)
def test_a_device_that_skips_is_incomplete_and_one_that_crashes_fails(run_toy, device, code, said):
    answer = run_toy(device)
    assert answer.exit_code == code
    assert said in answer.stdout


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
        (["--device", "fake:good", "--device-timeout", "0"], "--device-timeout"),
        (["--device", "fake:low", "--device-timeout", "nan"], "device-timeout"),
        (["--device", "fake:good", "--waive", "no such file"], "No such file"),
        (["--device", "fake:good", "--until", "x"], "No such option"),
    ],
)
def test_wrong_usage_is_exit_2_in_one_clear_line_without_a_traceback(call, words, said):
    answer = call("run", *words)
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert "Traceback" not in answer.output
    assert [line for line in answer.stderr.splitlines() if line.startswith("Error:")]
    assert "toy" not in answer.stdout


def test_a_fault_of_the_suite_is_exit_3_without_verdict_or_report(call, tmp_path):
    answer = call("run", "--device", "fake:good", "--check", "skewed", "--report", tmp_path)
    assert answer.exit_code == 3
    assert "the suite itself is at fault, no verdict" in answer.stderr
    assert not any(word in answer.output for word in ("PASS", "FAIL", "INCOMPLETE"))
    assert files_in(tmp_path) == set()


def test_an_unexpected_error_of_the_suite_is_exit_3_and_shows_where(run_toy, monkeypatch):
    def broken(*_):
        raise RuntimeError("bug")

    monkeypatch.setattr(trial, "check_result", broken)
    answer = run_toy("good")
    assert answer.exit_code == 3
    assert "RuntimeError: bug" in answer.stderr
    assert "Traceback" in answer.stderr


def test_an_interruption_is_no_verdict(run_toy, monkeypatch, tmp_path, devices):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(trial, "check_result", interrupted)
    answer = run_toy("good", "--report", tmp_path)
    assert answer.exit_code == 130
    assert "no verdict" in answer.stderr
    assert files_in(tmp_path) == set()
    assert devices["good"].closed == 1


@pytest.fixture
def unread():
    """A console whose reader goes away before the first line."""
    reading, writing = os.pipe()
    os.close(reading)
    file = os.fdopen(writing, "w")
    yield PipedConsole(file=file, emoji=False)
    with suppress(BrokenPipeError):
        file.close()


@pytest.mark.slow
@pytest.mark.parametrize(("device", "code"), [("good", 4), ("bad", 1)])
def test_a_run_goes_on_and_reports_when_nobody_reads_what_it_shows(
    run_toy, tmp_path, monkeypatch, unread, device, code
):
    assert run_toy(device, "--report", tmp_path / "read").exit_code == code
    monkeypatch.setattr(run_command, "TerminalRenderer", lambda *_: TerminalRenderer(unread))
    answer = run_toy(device, "--report", tmp_path / "unread")
    assert (answer.exit_code, answer.stdout) == (code, "")
    assert files_in(tmp_path / "unread") == files_in(tmp_path / "read")
    assert report_in(tmp_path / "unread") == report_in(tmp_path / "read")


def test_a_report_that_fails_after_judging_is_exit_3_beneath_the_verdict(
    run_toy, monkeypatch, tmp_path
):
    folder = tmp_path / "report"
    judged = trial.check_result

    def losing(*arguments):
        shutil.rmtree(folder, ignore_errors=True)
        return judged(*arguments)

    monkeypatch.setattr(trial, "check_result", losing)
    answer = run_toy("good", "--report", folder)
    assert answer.exit_code == 3
    assert "INCOMPLETE: 1 of 1 checks that ran passed" in answer.stdout
    assert "Error: no report: FileNotFoundError" in answer.stderr
    assert "Traceback" not in answer.output


@pytest.mark.slow
@pytest.mark.parametrize("effort", ["quick", "certification"])
def test_the_report_keeps_its_schema_at_every_effort(run_toy, tmp_path, effort):
    assert run_toy("good", "--effort", effort, "--report", tmp_path).exit_code == 4
    assert report_in(tmp_path)["effort"] == effort


def test_the_report_says_what_the_terminal_says(run_toy, tmp_path):
    answer = run_toy("bad", "--report", tmp_path / "new", "--class", "adequate")
    report = report_in(tmp_path / "new")
    assert (report["verdict"], report["class"]) == ("FAIL", "adequate")
    assert report["device"]["spec"] == "fake:bad"
    outcomes = {c["id"]: c["outcome"] for c in report["checks"]}
    assert outcomes.pop("toy") == "fail"
    assert set(outcomes.values()) == {"skip"}
    assert answer.exit_code == 1


@pytest.mark.slow
def test_the_same_seed_and_kept_cases_write_the_same_bytes(run_toy, tmp_path):
    first, *others = (tmp_path / name for name in "abc")
    run_toy("bad", "--report", first)
    for folder in others:
        shutil.copytree(first / "cases", folder / "cases")
        run_toy("bad", "--report", folder, "--seed", 4)
    assert files_in(others[0]) == files_in(others[1])
    for path in ("report.json", *(p for p in files_in(others[0]) if p.parent.name == "cases")):
        assert (others[0] / path).read_bytes() == (others[1] / path).read_bytes()
    assert len(report_in(others[0])["replayed"]) == 1


@pytest.mark.parametrize("name", ["file", "file/below", "folder"])
def test_a_report_that_cannot_be_written_is_exit_2_before_anything_runs(
    run_toy, tmp_path, devices, name
):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "cases").write_text("")
    answer = run_toy("good", "--report", tmp_path / name)
    assert answer.exit_code == 2
    assert "toy" not in answer.stdout
    assert devices["good"].seen == []


def test_piped_output_is_plain_lines_and_a_broken_plugin_is_one_of_them(run_toy):
    answer = run_toy("good")
    assert "\x1b" not in answer.output
    assert "toy: 2 cases" in answer.stdout
    assert "toy: pass" in answer.stdout
    assert "Warning: plug-in sad: ImportError: gone" in answer.stderr


@pytest.mark.slow
def test_help_needs_no_compiler():
    code = (
        "import sys; from click.testing import CliRunner; "
        "from floatref_conformance.cli.main import main; "
        "[CliRunner().invoke(main, w) for w in (['--help'], ['run', '--help'])]; "
        "sys.exit(bool({'numba', 'scipy.signal', 'hypothesis'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_device_that_was_made_is_closed_whatever_keeps_it_from_being_run(
    run_toy, call, keep, tmp_path, devices
):
    assert run_toy("good", "--device-timeout", "nan").exit_code == 2
    assert devices["good"].closed == 1
    (tmp_path / "file").touch()
    assert run_toy("low", "--report", tmp_path / "file" / "report").exit_code != 0
    assert devices["low"].closed == 1
    case = keep(tmp_path)
    answer = call("replay", case, "--device", "fake:bad", "--device-timeout", "nan")
    assert (answer.exit_code, devices["bad"].closed) == (2, 1)


@pytest.mark.slow
def test_a_kept_case_is_replayed_as_told_from_where_the_run_was_started(
    run_toy, call, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    run_toy("bad", "--report", "a report")
    answer = run_toy("bad", "--report", "a report", "--device-timeout", 3)
    replay_line = next(line for line in answer.stdout.splitlines() if "conformance replay" in line)
    again = call(*shlex.split(replay_line.partition("conformance ")[2]))
    assert again.exit_code == 1
    assert "fake:bad" in again.stdout
    assert answer.stdout.rstrip().endswith("--device-timeout 3")
