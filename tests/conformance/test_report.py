"""`report.json` as other programs read it."""

import json
from math import nan

import pytest
from jsonschema import Draft202012Validator

from floatref_conformance.classes import DeviceClass, same_limit
from floatref_conformance.errors import SuiteError
from floatref_conformance.events import RunFinished
from floatref_conformance.render.report import JsonReport, as_json, write
from floatref_conformance.schemas import read_schema
from floatref_conformance.verdict import CheckResult, Measurement, Outcome, RunResult

KEYS = {
    "format", "edition", "device", "class", "class_reached", "seed", "effort", "verdict",
    "checks", "replayed",
}  # fmt: skip
CHECK_KEYS = {"id", "outcome", "class_reached", "cases", "worst", "clause", "counterexample"}


def result(*checks):
    device = {
        "spec": "fake:x", "name": "x", "version": "1", "architecture": "spatial",
        "capabilities": (),
    }  # fmt: skip
    return RunResult(device, DeviceClass.NOMINAL, 3, "quick", checks)


def failed(value=0.2):
    worst = Measurement("IRI", "left", value, "m/km", same_limit(0.1, 0.05))
    found = {"case": "toy-1", "parameters": {"seed": 5, "gap": nan}, "reason": "too rough"}
    return CheckResult(
        "toy", "Toy 1.2", Outcome.FAIL, "too rough", None, 2, worst, counterexample=found
    )


def test_the_report_has_the_keys_of_its_format_and_no_others():
    report = as_json(result(failed(), CheckResult("later", "", Outcome.SKIP, "not built yet")))
    assert set(report) == KEYS
    assert all(set(check) == CHECK_KEYS for check in report["checks"])
    assert report["format"] == "conformance-report/1"
    assert report["replayed"] == []
    assert report["checks"][0]["worst"] == {"value": 0.2, "limit": 0.1, "unit": "m/km"}
    assert (report["class"], report["seed"], report["effort"]) == ("nominal", 3, "quick")


def test_the_report_keeps_the_shipped_schema_which_is_itself_sound(tmp_path):
    schema = read_schema("conformance-report-1")
    Draft202012Validator.check_schema(schema)
    JsonReport.into(tmp_path).handle(RunFinished(result(failed())))
    Draft202012Validator(schema).validate(json.loads((tmp_path / "report.json").read_text()))


def test_nan_is_written_as_null(tmp_path):
    JsonReport.into(tmp_path).handle(RunFinished(result(failed(nan))))
    check = json.loads((tmp_path / "report.json").read_text())["checks"][0]
    assert check["worst"]["value"] is None
    assert check["counterexample"]["parameters"]["gap"] is None


def test_a_report_that_breaks_its_schema_is_the_suites_fault_and_leaves_no_file(tmp_path):
    report = as_json(result(failed()))
    with pytest.raises(SuiteError, match="verdict"):
        write({**report, "verdict": "MAYBE"}, tmp_path / "report.json")
    assert list(tmp_path.iterdir()) == []


def test_the_report_replaces_an_older_one_and_leaves_nothing_beside_it(tmp_path):
    folder = tmp_path / "new" / "folder"
    JsonReport.into(folder)
    (folder / "report.json").write_text("old")
    JsonReport.into(folder).handle(RunFinished(result(failed())))
    assert [p.name for p in folder.iterdir()] == ["report.json"]
    assert json.loads((folder / "report.json").read_text())["verdict"] == "FAIL"


def test_an_older_report_is_gone_before_the_run_begins(tmp_path):
    (tmp_path / "report.json").write_text("old")
    JsonReport.into(tmp_path)
    assert list(tmp_path.iterdir()) == []
