"""`conformance run`: the details of `--verbose`, and the one object of `--json`."""

import json
import subprocess
import sys

import pytest

from floatref_conformance.judge import trial
from floatref_conformance.render.report import JsonOutput


@pytest.mark.slow
@pytest.mark.parametrize(("device", "code"), [("good", 4), ("bad", 1), ("choosy", 4)])
def test_json_is_the_document_of_the_report_and_all_else_is_on_stderr(
    run_toy, tmp_path, device, code
):
    answer = run_toy(device, "--json", "--report", tmp_path)
    report = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert (answer.exit_code, json.loads(answer.stdout)) == (code, report)
    plain = run_toy(device)
    shown = [line for line in answer.stderr.splitlines() if not line.startswith("Warning")]
    assert shown == plain.stdout.splitlines()


def test_json_needs_no_folder(run_toy):
    document = json.loads(run_toy("good", "--json").stdout)
    assert (document["format"], document["verdict"]) == ("conformance-report/1", "INCOMPLETE")


@pytest.mark.parametrize(("kept", "left"), [((), set()), (("a",), {"a"}), (("a", "b"), {"a", "b"})])
def test_an_interruption_leaves_the_folders_that_were_there(
    run_toy, monkeypatch, tmp_path, kept, left
):
    """The folder of the report and that of its cases are made before the run: to try whether."""

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(trial, "check_result", interrupted)
    tmp_path.joinpath(*kept).mkdir(parents=True, exist_ok=True)
    answer = run_toy("good", "--report", tmp_path / "a" / "b" / "c")
    assert answer.exit_code == 130
    assert {path.name for path in tmp_path.rglob("*")} == left


@pytest.mark.parametrize("words", [["--device", "fake:nobody"], ["--check", "jumping"]])
def test_wrong_usage_leaves_stdout_empty(call, words):
    answer = call("run", "--device", "fake:good", "--json", *words)
    assert (answer.exit_code, answer.stdout) == (2, "")
    assert answer.stderr.splitlines()[-1].startswith("Error: ")


def test_a_fault_of_the_suite_leaves_stdout_empty(call):
    answer = call("run", "--device", "fake:good", "--check", "skewed", "--json")
    assert (answer.exit_code, answer.stdout) == (3, "")
    assert "no verdict" in answer.stderr


def test_an_object_that_nobody_reads_is_exit_3_below_the_reports(run_toy, monkeypatch, tmp_path):
    def unread(self, event):
        raise BrokenPipeError(32, "Broken pipe")

    monkeypatch.setattr(JsonOutput, "handle", unread)
    answer = run_toy("good", "--json", "--report", tmp_path)
    assert answer.exit_code == 3
    assert "no report: BrokenPipeError" in answer.stderr


@pytest.mark.slow
@pytest.mark.parametrize("device", ["good", "bad"])
def test_verbose_adds_the_details_of_every_check_and_takes_nothing_away(run_toy, device):
    short, whole = (run_toy(device, *words).stdout for words in ((), ("--verbose",)))
    assert "worst is the IRI error of track " in whole
    assert "worst is" not in short
    assert ("simplest case that fails" in whole) == (device == "bad")
    assert "simplest case that fails" not in short
    assert whole.splitlines()[-1] == short.splitlines()[-1]


def test_a_failure_has_its_reason_without_verbose_too(run_toy):
    (line,) = [x for x in run_toy("bad").stdout.splitlines() if x.startswith("toy: IRI error")]
    assert line.endswith("[Toy 1.2]")
    assert "limit 0.1 m/km" in line


@pytest.mark.slow
def test_the_object_is_all_that_a_process_writes_to_its_standard_output():
    words = ["run", "--check", "bounce", "--device", "builtin:temporal-basic", "--json"]
    command = [sys.executable, "-m", "floatref_conformance", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 4, done.stderr
    checks = {check["id"]: check for check in json.loads(done.stdout)["checks"]}
    assert checks["bounce"]["shown"]["quantity"] == "IRI"
    assert "INCOMPLETE" in done.stderr


@pytest.mark.parametrize(
    ("jobs", "words"), [(2, "may not run several times at once"), (0, "0 is not in the range")]
)
def test_jobs_that_cannot_be_are_exit_2_before_anything_runs(run_toy, devices, jobs, words):
    answer = run_toy("good", "--jobs", jobs)
    assert (answer.exit_code, answer.stdout, devices["good"].seen) == (2, "", [])
    assert words in answer.stderr.splitlines()[-1]


def test_one_job_is_the_default(run_toy):
    assert run_toy("good", "--jobs", 1).stdout == run_toy("good").stdout
