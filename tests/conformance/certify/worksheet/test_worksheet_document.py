"""The worksheet as JSON: all numbers in it, its schema kept, written whole or not at all."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

from floatref.errors import InputError
from floatref_conformance.certify.judging.contents import Cause, Worksheet
from floatref_conformance.certify.judging.criteria import verdict_of
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.scales import judge_readings
from floatref_conformance.certify.judging.sections import Run
from floatref_conformance.certify.judging.stationary import stationary_sheet
from floatref_conformance.certify.plan.plan_document import DistancePlan, StationaryPlan
from floatref_conformance.certify.worksheet.worksheet_document import (
    FORMAT,
    SCHEMA,
    as_json,
    write_worksheet,
)
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.errors import SuiteError
from floatref_conformance.schemas import enforce

LIMITS = CertificationLimits()


@pytest.fixture(scope="module")
def worksheet(sheet_of, ten_runs):
    """A worksheet with all that one can hold: a run that failed, a cause, missing numbers."""
    bad = Run("torn", "torn.erd", ("read as ERD",), None, "line 3 is cut short")
    section = sheet_of((*ten_runs[:3], bad))
    first = section.runs[0]
    cause = Cause("distance", "distance 1 % long", math.nan)
    blamed = replace(first, tracks=(replace(first.tracks[0], causes=(cause,)), *first.tracks[1:]))
    stationary = (
        stationary_sheet("quiescent", StationaryPlan(Path("parked")), None, LIMITS, (), "no file"),
        stationary_sheet("bounce", StationaryPlan(Path("b"), (0.0, 200.0)), ten_runs[0], LIMITS),
    )
    criteria = judge_readings(DistancePlan(1000.0, (1000.1,)), LIMITS)
    return Worksheet(
        profiler="Van 3",
        device_class=DeviceClass.NOMINAL,
        limits=LIMITS,
        verdict=verdict_of(criteria),
        sections=(replace(section, runs=(blamed, *section.runs[1:])),),
        stationary=stationary,
        criteria=criteria,
        settings={"plan": "plan.toml", "runs": ("a", "b"), "pipeline": None},
        versions={"floatref": "1"},
    )


def numbers_of(value):
    """Return every number in ``value``, in order."""
    if isinstance(value, dict):
        return [n for item in value.values() for n in numbers_of(item)]
    if isinstance(value, list):
        return [n for item in value for n in numbers_of(item)]
    return [value] if isinstance(value, float) else []


def test_the_document_holds_what_the_worksheet_does(worksheet):
    made = as_json(worksheet)
    assert (made["format"], made["class"], made["verdict"]) == (FORMAT, "nominal", "PASS")
    (section,), sheet = made["sections"], worksheet.sections[0]
    for run, entry in zip(sheet.runs, section["runs"], strict=True):
        assert entry["error"] == run.error
        assert [t["accuracy"] for t in entry["tracks"]] == [t.accuracy for t in run.tracks]
    for name, pairs in sheet.pairs.items():
        entry = section["pairs"][name]
        assert [entry[i][j] for i in range(3) for j in range(i + 1, 3)] == [
            pairs[i, j] for i in range(3) for j in range(i + 1, 3)
        ]
    assert [c["judged"] for c in section["criteria"]] == [c.judged for c in sheet.criteria]
    assert made["stationary"][1]["iri_m_per_km"] == worksheet.stationary[1].iri_m_per_km


def test_a_number_that_is_none_is_null(worksheet):
    made = as_json(worksheet)
    (section,) = made["sections"]
    assert section["pairs"]["left"][1][0] is None
    assert section["runs"][0]["tracks"][0]["causes"][0]["explains"] is None
    assert made["stationary"][0]["criteria"][0]["value"] is None
    assert made["stationary"][0]["start_m"] is None
    assert all(math.isfinite(number) for number in numbers_of(made))


def test_what_is_written_is_read_again_and_keeps_the_schema(worksheet, tmp_path):
    path = tmp_path / "worksheet.json"
    path.write_text("older")
    write_worksheet(worksheet, path)
    read = json.loads(path.read_text(encoding="utf-8"))
    enforce(SCHEMA, read)
    assert read == as_json(worksheet)
    assert [entry.name for entry in tmp_path.iterdir()] == ["worksheet.json"]


def test_a_worksheet_that_breaks_the_schema_leaves_the_older_one(worksheet, tmp_path):
    path = tmp_path / "worksheet.json"
    path.write_text("older")
    run = replace(worksheet.sections[0].runs[0], name="")
    section = replace(worksheet.sections[0], runs=(run,))
    with pytest.raises(
        SuiteError, match=r"conformance-worksheet-1 at \$\.sections\[0\]\.runs\[0\]"
    ):
        write_worksheet(replace(worksheet, sections=(section,)), path)
    with pytest.raises(InputError, match=r"worksheet\.settings\.plan is a PosixPath"):
        write_worksheet(replace(worksheet, settings={"plan": tmp_path}), path)
    assert path.read_text() == "older"
    assert [entry.name for entry in tmp_path.iterdir()] == ["worksheet.json"]


@pytest.mark.parametrize("verdict", Verdict)
@pytest.mark.parametrize("device_class", DeviceClass)
def test_every_verdict_and_class_can_be_written(worksheet, verdict, device_class):
    made = as_json(replace(worksheet, verdict=verdict, device_class=device_class))
    assert (made["verdict"], made["class"]) == (verdict.value, device_class.value)
