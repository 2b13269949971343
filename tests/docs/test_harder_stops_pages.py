"""What the road prior's and the Kalman smoother's pages say of harder stops, as measured."""

import importlib
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ROWS = json.loads((Path(__file__).parent / "data" / "harder-stops.json").read_text("utf-8"))
CELLS = {(row["pipeline"], row["change"]): row for row in ROWS}
PAGES = {
    name: (ROOT / "docs" / f"{name}.md").read_text("utf-8")
    for name in ("road-prior", "kalman-smoother")
}
PRIOR, REFLECTION = "road-prior-smoother", "kalman-smoother-reflection"
CONSTANT = "kalman-smoother-constant-height-attitude"
TRUE, ENCODER = "cross_correlation_true", "cross_correlation_encoder"
SHAPES = ("crown 50 mm", "crown 100 mm", "hump 150 mm over 10 m", "grade break 4 %")


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "benchmarks"))
    return importlib.import_module("bench_harder_stops")


def test_the_tables_are_those_measured(bench):
    assert set(CELLS) == {
        (pipeline, change) for pipeline in bench.PIPELINES for change in bench.CHANGES
    }
    for page in PAGES.values():
        assert bench.fill(page, ROWS) == page
    for pipeline in bench.PIPELINES:
        assert bench.marks(pipeline)[0] in "".join(PAGES.values())


def test_every_point_is_marked_valid():
    for page in PAGES.values():
        assert "**Every point of every row is\nmarked valid.**" in page
    assert {row["valid_percent"] for row in ROWS} == {100.0}


def test_slip_costs_every_pipeline_alike_and_the_elevation_is_right():
    for pipeline in (PRIOR, REFLECTION, CONSTANT):
        assert CELLS[pipeline, "no slip"][TRUE] > 0.99
        assert CELLS[pipeline, "nothing"][TRUE] < 0.95
        assert CELLS[pipeline, "slip 12 % per g"][TRUE] < 0.3
        assert CELLS[pipeline, "slip 12 % per g"][ENCODER] > 0.99


def test_the_road_prior_takes_the_tilt_of_a_crown_for_road():
    for change in SHAPES:
        assert CELLS[PRIOR, change][ENCODER] < 0.93
        assert CELLS[PRIOR, change]["within_percent_encoder"] < 25.0
        assert CELLS[REFLECTION, change][ENCODER] > 0.99
    assert CELLS[PRIOR, "crown 100 mm, 60 m ahead"][ENCODER] > 0.99


def test_without_gnss_a_change_of_grade_is_a_loss():
    lost = {n: 1.0 - CELLS[CONSTANT, f"grade break {n} %"][ENCODER] for n in (1, 2, 4)}
    assert lost[1] < lost[2] < lost[4]
    assert lost[2] == pytest.approx(0.2, abs=0.03)
    assert lost[4] == pytest.approx(0.5, abs=0.05)
    assert CELLS[CONSTANT, "grade break 4 %"]["iri_error_percent_true"] == pytest.approx(25, abs=2)


@pytest.mark.parametrize("pipeline", [PRIOR, REFLECTION, CONSTANT])
def test_the_laser_beside_its_accelerometer_costs_what_a_late_one_does(pipeline):
    near, far, late = (
        CELLS[pipeline, change][ENCODER]
        for change in ("laser 0.105 m ahead", "laser 0.3 m ahead", "latency 3 ms")
    )
    assert near == pytest.approx(late, abs=0.005)
    assert far < near - 0.04
    for mild in ("friction 2000 N·m", "progressive springs 50 1/m²"):
        assert CELLS[pipeline, mild][ENCODER] > 0.995


@pytest.mark.slow
def test_a_row_comes_out_again(bench):
    processing = bench.Processing((PRIOR,))
    paths = bench.measured(processing, "grade break 4 %")[PRIOR]
    found, kept = bench.mean(paths), CELLS[PRIOR, "grade break 4 %"]
    assert found[ENCODER] == pytest.approx(kept[ENCODER], abs=5e-4)
    assert found["rms_mm_true"] == pytest.approx(kept["rms_mm_true"], rel=1e-2)
