"""What is shown of drawn stops: text, JSON and picture."""

import json
from io import StringIO

import pytest
from jsonschema import Draft202012Validator
from rich.console import Console

from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.schemas import read_schema
from floatref_conformance.table.stops import StopScores, StopSettings
from floatref_conformance.table.stops.stop_document import stop_document
from floatref_conformance.table.stops.stops_picture import draw_stops
from floatref_conformance.table.stops.stops_text import print_stops

ONE = StopSettings(seed=2, stops=1, vehicles=("minivan",), pipelines=("temporal-basic",))
SCORES = (
    StopScores(0.97, -2.5, 3.0, 91.0, 82.0),
    StopScores(-0.25, 1234.5, 80.0, 99.5, 64.0),
    StopScores(0.99, 0.5, 2.0, 95.0, 73.0),
)


@pytest.fixture
def table(hand_stops):
    return hand_stops(SCORES, ONE)


def printed(table, **settings):
    file = StringIO()
    print_stops(table, Console(file=file, emoji=False, **settings))
    return file.getvalue().splitlines()


def test_each_group_has_its_figures(table):
    lines = printed(table)
    assert lines[0].strip() == "temporal-basic"
    rows = {line.split("  ")[0].strip(): line.split()[-9:] for line in lines}
    together = ["3", "0.970", "-0.226", "-0.250", "2.5", "1,234", "91.0", "95.0", "99.5"]
    assert rows["all"] == rows["minivan"] == together
    assert rows["fair road"] == ["1", *["-0.250"] * 3, *["1,234"] * 2, *["99.5"] * 3]
    assert "% in 2 sigma along the true distance: 64.0 to 82.0, median 73.0" in lines
    assert lines[-1].endswith("smooth 0.8 m/km, fair 1.8 m/km, rough 4 m/km; seed 2.")


def test_the_lowest_can_be_simulated_again(table):
    (line,) = [line for line in printed(table) if line.startswith("lowest (left): ")]
    scenario = Scenario.from_dict(json.loads(line.partition(": ")[2]))
    assert scenario == table.lowest("temporal-basic").scenario
    assert scenario.road == "sayers-asphalt-long-waves"


def test_a_pipeline_without_sigma_has_dashes(hand_stops):
    lines = printed(hand_stops([StopScores(0.9, 1.0, 2.0)], ONE))
    (row,) = [line.split() for line in lines if line.startswith(" all ")]
    assert row[-3:] == ["–"] * 3
    assert not any("true distance" in line for line in lines)


@pytest.mark.slow
def test_all_pipelines_stand_together_in_80_columns(hand_stops):
    """The errors of the IRI are as large as the basic algorithms make them at long stops."""
    settings = StopSettings(stops=7)
    worst = StopScores(-0.25, 538123.4, 9999.0, 100.0, 100.0)
    lines = printed(hand_stops([worst], settings), width=80, force_terminal=True, color_system=None)
    assert [line for line in lines if "…" in line] == []
    assert max(len(line.rstrip()) for line in lines if not line.startswith(("lowest", "Ag"))) <= 80
    for pipeline in settings.pipelines:
        row, beside = (line.split() for line in lines if line.startswith(f" {pipeline} "))
        assert beside[1:] == ["–"] * 3
        assert row[1:] == ["-0.250"] * 3 + ["538,123"] * 2


def test_the_document_holds_every_wheel_path(table):
    made = json.loads(json.dumps(stop_document(table), allow_nan=False))
    Draft202012Validator(read_schema("conformance-stops-1")).validate(made)
    assert made["format"] == "conformance-stops/1"
    assert [road["iri_m_per_km"] for road in made["roads"]] == [0.8, 1.8, 4.0]
    paths = [drive["wheel_paths"] for drive in made["passes"]]
    assert [len(each) for each in paths] == [1, 1, 1]
    assert paths[1][0] == {
        "pipeline": "temporal-basic",
        "track": "left",
        "cross_correlation": -0.25,
        "iri_error_percent": 1234.5,
        "peak_m_per_km": 80.0,
        "within_two_sigma_percent": 99.5,
        "within_two_sigma_true_distance_percent": 64.0,
        "cross_correlation_encoder": None,
        "iri_error_encoder_percent": None,
        "nees": None,
        "nees_true_distance": None,
    }
    (pipeline,) = made["pipelines"]
    assert pipeline["all"] == pipeline["vehicles"]["minivan"]
    assert pipeline["all"]["within_two_sigma_percent"] == {
        "lowest": 91.0, "median": 95.0, "highest": 99.5,
    }  # fmt: skip
    assert pipeline["roads"]["rough"]["cross_correlation_lowest"] == 0.99
    lowest = Scenario.from_dict(pipeline["lowest"]["scenario"])
    assert lowest == Scenario.from_dict(made["passes"][1]["scenario"])


def test_the_document_has_null_for_what_is_not_told(hand_stops):
    made = stop_document(hand_stops([StopScores(float("nan"), 1.0, 2.0)], ONE))
    assert made["passes"][0]["wheel_paths"][0]["cross_correlation"] is None
    assert made["pipelines"][0]["all"]["within_two_sigma_percent"] is None


def drawn(table, path):
    draw_stops(table, path)
    return path.read_bytes()


@pytest.mark.slow
def test_the_picture_is_a_png_that_shows_the_data(hand_stops, table, tmp_path):
    first = drawn(table, tmp_path / "a.png")
    assert first.startswith(b"\x89PNG\r\n\x1a\n")
    assert drawn(table, tmp_path / "a.png") == first
    other = hand_stops((*SCORES[:2], StopScores(0.98, 0.5, 2.0)), ONE)
    assert drawn(other, tmp_path / "b.png") != first


@pytest.mark.slow
def test_the_picture_takes_what_lies_beyond_its_ends(hand_stops, tmp_path):
    def of(*correlations):
        scores = [StopScores(value, 0.0, 1.0) for value in correlations]
        return drawn(hand_stops(scores, ONE), tmp_path / "a.png")

    assert of(-0.8, -0.8, 1.0) == of(0.0, 0.0, 0.9999)
    assert of(0.1, 0.0, 0.9999) != of(0.0, 0.0, 0.9999)
