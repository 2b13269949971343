"""`report.json` as other programs read it."""

import json
from dataclasses import replace
from math import nan

import pytest
from jsonschema import Draft202012Validator

from floatref_conformance.checks.verdict import CheckResult, Measurement, Outcome, RunResult
from floatref_conformance.classes import DeviceClass, same_limit
from floatref_conformance.errors import SuiteError
from floatref_conformance.judge.events import RunFinished
from floatref_conformance.render.report import JsonReport, as_json, write
from floatref_conformance.schemas import read_schema

KEYS = {
    "format", "edition", "device", "class", "class_reached", "seed", "effort", "verdict",
    "checks", "replayed",
}  # fmt: skip
CHECK_KEYS = {
    "id", "outcome", "reason", "class_reached", "cases", "worst", "shown", "clause", "flagged_m",
    "counterexample",
}  # fmt: skip


def result(*checks, replayed=()):
    device = {
        "spec": "fake:x", "name": "x", "version": "1", "architecture": "spatial",
        "capabilities": (),
    }  # fmt: skip
    return RunResult(device, DeviceClass.NOMINAL, 3, "quick", checks, replayed)


def failed(value=0.2):
    worst = Measurement("IRI", "left", value, "m/km", same_limit(0.1, 0.05))
    found = {"case": "toy-1", "parameters": {"seed": 5, "gap": nan}, "reason": "too rough"}
    return CheckResult("toy", "Toy 1.2", Outcome.FAIL, "too rough", None, 2, worst, "toy-2", found)


def test_the_report_has_the_keys_of_its_format_and_no_others():
    report = as_json(result(failed(), CheckResult("later", "", Outcome.SKIP, "not built yet")))
    assert set(report) == KEYS
    assert all(set(check) == CHECK_KEYS for check in report["checks"])
    assert report["format"] == "conformance-report/1"
    assert report["replayed"] == []
    worst = report["checks"][0]["worst"]
    assert {key: worst[key] for key in ("value", "limit", "unit", "quantity", "track", "case")} == {
        "value": 0.2, "limit": 0.1, "unit": "m/km", "quantity": "IRI", "track": "left",
        "case": "toy-2",
    }  # fmt: skip
    assert worst["margin"] == pytest.approx(-1.0)
    assert (report["class"], report["seed"], report["effort"]) == ("nominal", 3, "quick")


def test_the_report_keeps_the_shipped_schema_which_is_itself_sound(tmp_path):
    schema = read_schema("conformance-report-1")
    Draft202012Validator.check_schema(schema)
    JsonReport.into(tmp_path).handle(RunFinished(result(failed())))
    Draft202012Validator(schema).validate(json.loads((tmp_path / "report.json").read_text()))


def test_a_class_without_limit_has_none_in_the_report_either():
    free = Measurement("IRI", "left", 5.0, "m/km", {})
    report = as_json(result(replace(failed(), worst=free)))
    assert report["checks"][0]["worst"]["limit"] is None
    assert report["checks"][0]["worst"]["margin"] is None


def test_a_kept_case_is_listed_with_what_it_came_to(tmp_path):
    kept = {
        "file": "toy-1a2b3c4d.json", "check": "toy", "outcome": "fail", "reason": "too rough",
        "value": nan, "limit": 0.1, "unit": "m/km",
    }  # fmt: skip
    JsonReport.into(tmp_path).handle(RunFinished(result(failed(), replayed=(kept,))))
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["replayed"] == [{**kept, "value": None}]


def test_half_a_character_from_a_device_does_not_keep_the_report_from_being_written(tmp_path):
    odd = replace(failed(), reason="half \ud83d and whole \U0001f600")
    JsonReport.into(tmp_path).handle(RunFinished(result(odd)))
    assert json.loads((tmp_path / "report.json").read_bytes())["checks"][0]["reason"] == odd.reason


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


def test_the_report_replaces_an_older_one_that_is_gone_before_the_run_begins(tmp_path):
    folder = tmp_path / "new" / "folder"
    JsonReport.into(folder)
    (folder / "report.json").write_text("old")
    report = JsonReport.into(folder)
    assert list(folder.iterdir()) == []
    report.handle(RunFinished(result(failed())))
    assert [p.name for p in folder.iterdir()] == ["report.json"]
    assert json.loads((folder / "report.json").read_text())["verdict"] == "FAIL"
