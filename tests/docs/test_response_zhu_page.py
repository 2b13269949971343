"""The page on Zhu's simulations: its numbers are the code's."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest

from floatref.vehicle_response import ZHU_HALF_CAR, Hold

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "response-zhu.md").read_text(encoding="utf-8")


@pytest.fixture
def bench(monkeypatch):
    """Return the module of the three simulations."""
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "benchmarks"))
    return importlib.import_module("bench_zhu")


def row(begin):
    """Return the numbers of the first row of a table that begins so."""
    cells = re.search(rf"^\| {begin} \| (.*) \|$", PAGE, re.MULTILINE).group(1).split(" | ")
    return np.array(cells, dtype=float)


def test_the_drive_is_the_one_that_is_told(bench):
    text = " ".join(PAGE.split())
    for said in (
        f"read as {ZHU_HALF_CAR.equipment_ns_per_m:g} and {ZHU_HALF_CAR.suspension_ns_per_m:g}",
        f"over {bench.LENGTH_M:g} m at {bench.SPEED:g} m/s",
        f"rate of {bench.RATE:g} Hz",
        f"noise of {100 * bench.zhu.NOISE:g} %",
    ):
        assert said in text, said


@pytest.mark.slow
def test_the_errors_of_the_first_road_are_found_again(bench):
    front, rear, both = bench.random_road(0, 0.05, Hold.ZERO_ORDER)
    linear, rough = (bench.random_road(0, each, Hold.FIRST_ORDER)[2] for each in (0.05, 0.005))
    found = [front, rear, both, linear, rough, bench.PRINTED[0]]
    np.testing.assert_allclose(row("1"), found, atol=0.011)


def test_the_errors_at_the_obstacle_are_found_again(bench):
    printed = re.search(r"elsewhere, %.*\n.*\n\| 1 \| (\S+) \| (\S+)", PAGE).groups()
    found = bench.obstacles(1)[0][1:]
    np.testing.assert_allclose(np.array(printed, float), np.array(found, float), atol=0.11)
