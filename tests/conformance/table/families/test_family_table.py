"""The table of families: made, summed up, shown."""

import json
from dataclasses import replace
from io import StringIO

import pytest
from jsonschema import Draft202012Validator
from rich.console import Console

from floatref_conformance.errors import SuiteError
from floatref_conformance.schemas import read_schema
from floatref_conformance.table.families import FamilySettings, make_family_table
from floatref_conformance.table.families.family_document import family_document
from floatref_conformance.table.families.family_picture import draw_families
from floatref_conformance.table.families.family_table import summarize
from floatref_conformance.table.families.family_text import closing_lines, print_families
from floatref_conformance.table.passes import Processing


def test_wrong_is_what_is_wrong_along_both_distances(hand_families, axis):
    wrong = axis(right=False, wrong_by=7.0)
    table = hand_families(
        {
            "stop": (wrong, axis()),
            "stop, crown": (wrong, axis(right=False, wrong_by=9.0)),
            "stop, hump": None,
        }
    )
    (found,) = table.wrong()
    assert found.condition.name == "stop, crown"
    lines = closing_lines(table)
    assert any("temporal-basic: urban, stop, crown: left, 7.0 %" in line for line in lines)


def test_a_path_without_a_profile_counts_as_no_correlation(hand_families):
    table = hand_families({"stop": None})
    (none,) = [c for c in table.settings.conditions if c.name == "stop"]
    found = summarize(table.of("temporal-basic", none))
    assert found.without_profile == 1
    assert found.true.cross_correlation_lowest == 0.0
    assert found.true.iri_error_median_percent is None
    assert found.true.right_percent == 0.0


def test_the_document_keeps_its_schema(hand_families, axis):
    table = hand_families({"stop": None, "stop, dip": (axis(float("nan")), axis())})
    made = json.loads(json.dumps(family_document(table), allow_nan=False))
    Draft202012Validator(read_schema("conformance-families-1")).validate(made)
    assert len(made["summaries"]) == len(table.settings.conditions)
    assert made["paths"][0]["failure"] == "no profile"


def test_the_terminal_has_a_row_for_each_condition_and_both_axes(hand_families):
    table = hand_families({})
    out = StringIO()
    print_families(table, Console(file=out, width=140, emoji=False))
    text = out.getvalue()
    assert "…" not in text
    for condition in table.settings.conditions:
        assert f"urban: {condition.name}" in text
    assert "What is valid is right (5 % or 0.1 m/km) on every drive." in text


@pytest.mark.slow
def test_the_picture_is_a_png(hand_families, axis, tmp_path):
    wrong = (axis(0.4, right=False, wrong_by=9.0),) * 2
    table = hand_families({"coast": wrong}, ("temporal-basic", "spatial-basic"), "rural")
    draw_families(table, tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")


@pytest.mark.slow
def test_figures_and_their_order_do_not_depend_on_the_number_of_processes(monkeypatch):
    settings = FamilySettings("stops", drives=1, pipelines=("temporal-basic",))
    drives = list(settings.scenarios(frozenset()))[:3]
    monkeypatch.setattr(FamilySettings, "scenarios", lambda self, capabilities: iter(drives))
    watched = []
    alone = make_family_table(settings)
    together = make_family_table(replace(settings, jobs=2), watched.append)
    assert together.paths == alone.paths
    assert watched == [name for _, name, _ in drives]
    assert [path.scenario for path in alone.paths[::2]] == [scenario for *_, scenario in drives]


@pytest.mark.slow
def test_a_pipeline_that_fails_on_a_drive_does_not_end_the_table(monkeypatch):
    settings = FamilySettings("urban", drives=1, pipelines=("temporal-basic", "spatial-basic"))
    drives = list(settings.scenarios(frozenset()))[:1]
    monkeypatch.setattr(FamilySettings, "scenarios", lambda self, capabilities: iter(drives))
    process = Processing._process

    def fail(self, name, pipeline, given):
        if pipeline == "spatial-basic":
            raise SuiteError(f"pipeline {pipeline}, {name}: it broke")
        return process(self, name, pipeline, given)

    monkeypatch.setattr(Processing, "_process", fail)
    table = make_family_table(settings)
    failures = {path.pipeline: path.failure for path in table.paths}
    assert failures["temporal-basic"] == ""
    assert "it broke" in failures["spatial-basic"]
    assert len(table.paths) == 4


def test_the_nees_of_wheel_paths_is_summed_up_by_its_median(hand_families):
    table = hand_families({})
    paths = [
        replace(path, scores=replace(path.scores, true=replace(path.scores.true, nees=nees)))
        for path, nees in zip(3 * table.paths[:1], (1.0, 9.0, None), strict=True)
    ]
    found = summarize(paths)
    assert found.true.nees_median == 5.0
    assert found.encoder.nees_median is None
