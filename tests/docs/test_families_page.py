"""The page of families: its columns are the code's, and its figures those of the command."""

import importlib
import json
import re
from pathlib import Path

import pytest

from floatref_conformance.table.families import CONDITIONS, FamilySettings, make_family_table
from floatref_conformance.table.families.family_table import summarize

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "families.md").read_text(encoding="utf-8")
DATA = json.loads((Path(__file__).parent / "data" / "families.json").read_text(encoding="utf-8"))
HEAD = re.findall(r"^\| condition \|(.+)\|$", PAGE, re.M)
PIPELINES = re.findall(r"`([\w-]+)`", HEAD[0])
ROWS = {
    cells[0].strip(): [
        (tuple(map(float, re.findall(r"[\d.]+", cell))), "**" in cell) for cell in cells[1:]
    ]
    for line in re.findall(r"^\| ((?:[^|`]+\|){5})$", PAGE, re.M)
    for cells in (line.rstrip("|").split("|"),)
    if re.search(r"\d\.\d{3}, \d\.\d{3}", line)
}
OFTEN_WRONG: dict[str, set[str]] = {
    "road-prior-smoother": set(),
    "kalman-smoother-reflection": set(),
}
"""Frames of `single`, and what is off by about 5 %, so that a frame depends on the seed."""


def test_every_condition_has_a_row_and_every_pipeline_of_the_table_a_cell():
    assert set(ROWS) == {condition.name for condition in CONDITIONS}
    assert all(len(cells) == len(PIPELINES) for cells in ROWS.values())
    assert f"on {len(CONDITIONS)} conditions" in PAGE
    assert (DOCS / "images" / "families.png").exists()
    assert "--drives 2" in PAGE


def test_the_list_of_what_is_wrong_is_complete(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS.parent / ".ci"))
    tool = importlib.import_module("families_wrong")
    assert tool.fill(PAGE, DATA) == PAGE
    counts = dict(re.findall(r"^\| `([\w-]+)` \| (\d+) \| (?:\w+:|–) ", PAGE, re.M))
    assert counts == {name: str(len(found)) for name, found in DATA["wrong"].items()}


def test_counts_tell_wrong_along_both_distances_from_the_true_one_alone(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS.parent / ".ci"))
    tool = importlib.import_module("families_wrong")
    right, wrong = {"valid_is_right": True}, {"valid_is_right": False}
    axes = [(wrong, wrong), (wrong, right), (wrong, wrong), (right, wrong), (right, right)]
    paths = [
        {
            "pipeline": "one",
            "family": "urban",
            "condition": "stop",
            "scores": {"true": true, "encoder": encoder},
        }
        for true, encoder in axes
    ]
    lost = {**paths[0], "pipeline": "two", "scores": None}
    document = {"family": "all", "seed": 0, "drives": 2, "paths": [*paths, lost]}
    data = tool.shorten(document)
    assert data["wrong"] == {"one": {"urban: stop": 2}, "two": {}}
    assert data["wrong_along_true_distance_alone"] == {"one": {"urban: stop": 1}, "two": {}}
    assert "| `one` | urban: stop 2 |\n| `two` | – |" in tool.make_table(data)


def single(names, pipelines, monkeypatch, **settings):
    """Return the table of some conditions of `single`."""
    wanted = FamilySettings("single", pipelines=pipelines, **settings)
    chosen = tuple(c for c in wanted.conditions if c.name in names)
    monkeypatch.setattr(FamilySettings, "conditions", chosen)
    return make_family_table(wanted)


@pytest.mark.slow
def test_figures_are_those_of_the_command(monkeypatch):
    names = ("crown 50 mm", "slip 12 %/g")
    pipelines = ("road-prior-smoother", "kalman-smoother-reflection")
    table = single(names, pipelines, monkeypatch, drives=2)
    for condition in table.settings.conditions:
        for pipeline in pipelines:
            found = summarize(table.of(pipeline, condition))
            figures, bold = ROWS[condition.name][PIPELINES.index(pipeline)]
            ours = [axis.cross_correlation_percentile_10 for axis in (found.true, found.encoder)]
            assert figures == pytest.approx(ours, abs=2e-3)
            wrong = {(p.pipeline, p.condition.name) for p in table.wrong()}
            assert bold == ((pipeline, condition.name) in wrong)


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", OFTEN_WRONG)
def test_what_is_valid_is_right_where_the_page_has_no_frame(pipeline, monkeypatch):
    """Of another seed: one thing at a time, and nothing else is wrong."""
    names = set(ROWS) - OFTEN_WRONG[pipeline]
    table = single(names, (pipeline,), monkeypatch, seed=11, drives=1)
    assert len(table.paths) == 2 * len(table.settings.conditions)
    assert [(p.condition.name, p.track) for p in table.wrong()] == []
