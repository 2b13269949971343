"""The page of scenarios: its table is that of the fields, its example a scenario."""

import importlib
import json
import re
from dataclasses import fields
from pathlib import Path

import pytest

from floatref_conformance.proving_ground.roads.random_roads import CASES, CLASSES
from floatref_conformance.proving_ground.scenario import ROADS, Scenario

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "scenario.md").read_text(encoding="utf-8")


@pytest.fixture
def tool(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("scenario_table")


def test_the_table_is_that_of_the_fields(tool):
    assert tool.fill(PAGE) == PAGE
    assert tool.main(check=True) == 0
    for field in fields(Scenario):
        assert f"| `{field.name}` | " in PAGE


def test_a_changed_default_is_noticed(tool, monkeypatch):
    monkeypatch.setattr(tool, "make_table", lambda: "| key |\n")
    assert tool.main(check=True) == 1


def test_the_example_is_a_scenario_that_says_what_it_changes():
    (text,) = re.findall(r"^```json\n(.+?)^```", PAGE, re.M | re.S)
    document = json.loads(text)
    made = Scenario.from_dict(document)
    for name in set(document) - {"format"}:
        assert getattr(made, name) != getattr(Scenario(), name)


def test_every_kind_of_road_is_on_the_page():
    assert CASES
    assert [f"iso-{name}" for name in (min(CLASSES), max(CLASSES))] == ["iso-A", "iso-H"]
    for road in ROADS:
        kind = road.partition("-")[0]
        assert f"`{kind}" in PAGE or f"`{kind}`" in PAGE
