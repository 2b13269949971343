"""The comparison of two reports finds every number that changed, and no text."""

import json
import subprocess
import sys
from copy import deepcopy
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / ".ci" / "same_reports.py"
REPORT = {
    "seed": 0,
    "device": {"name": "temporal-basic", "version": "0.1.0"},
    "checks": [
        {"id": "stop", "outcome": "fail", "reason": "off", "cases": 7, "worst": {"value": 0.1}},
        {"id": "faults", "outcome": "pass", "reason": "", "cases": 14, "worst": None},
    ],
}


def compared(folder: Path, change, kept=()) -> subprocess.CompletedProcess:
    """Return what the script makes of `REPORT`, with cases ``kept``, and of its ``change``."""
    new = deepcopy(REPORT)
    change(new)
    for name, document in (("old", REPORT), ("new", new)):
        (folder / name / "cases").mkdir(parents=True)
        (folder / name / "report.json").write_text(json.dumps(document), encoding="utf-8")
    for name in kept:
        (folder / "old" / "cases" / name).write_text("{}", encoding="utf-8")
    command = [sys.executable, str(SCRIPT), str(folder / "old"), str(folder / "new")]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    ("change", "where"),
    [
        (lambda r: r["checks"][0]["worst"].update(value=0.1 + 2e-17 * 2), "stop/worst/value"),
        (lambda r: r["checks"][0].update(outcome="pass"), "stop/outcome"),
        (lambda r: r["checks"][1].update(cases=14.0), "faults/cases"),
        (lambda r: r["checks"].pop(), "checks"),
        (lambda r: r["checks"][1].update(worst={}), "faults/worst"),
        (lambda r: r.pop("seed"), "seed"),
    ],
)
def test_a_change_is_found_and_named(tmp_path, change, where):
    found = compared(tmp_path, change)
    assert found.returncode == 1
    assert found.stdout.startswith((f"/report.json/{where}", f"/report.json/checks/{where}"))


def test_texts_and_the_version_may_differ(tmp_path):
    def reworded(report):
        report["checks"][0]["reason"] = "another sentence"
        report["device"]["version"] = "0.2.0"

    assert compared(tmp_path, reworded).returncode == 0


def test_a_kept_case_that_is_gone_is_found(tmp_path):
    found = compared(tmp_path, lambda report: None, kept=("stop-1.json",))
    assert found.returncode == 1
    assert "/stop-1.json: only in the old one" in found.stdout


def test_a_report_that_cannot_be_read_is_no_difference(tmp_path):
    command = [sys.executable, str(SCRIPT), str(tmp_path), str(tmp_path)]
    assert subprocess.run(command, capture_output=True, check=False).returncode == 2
