"""The page on the observer: its numbers are the code's, its example and its refusal are real."""

import importlib
import re
from pathlib import Path

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.vehicle_response import Kind, QuarterCar, Reading, UnknownInputObserver
from floatref.vehicle_response.estimators.gains import POSITION_HZ, RATE_HZ, TIME_CONSTANTS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "response-observer.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())


@pytest.fixture
def cases(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "benchmarks"))
    return importlib.import_module("imine_cases")


def test_the_numbers_of_the_observer_are_the_codes():
    assert f"poles, at {POSITION_HZ:g} and {RATE_HZ:g} Hz" in TEXT
    assert TIME_CONSTANTS == 10.0
    assert "ten time constants" in TEXT
    bias_mm = 1e3 * 0.05 / (4 * np.pi**2 * POSITION_HZ * RATE_HZ)
    assert f"which is {bias_mm:.2f} mm" in TEXT


def test_the_numbers_of_the_cases_are_the_codes(cases):
    low, high = cases.CHIRP_HZ
    bench, field = cases.BENCH, cases.FIELD
    for said in (
        f"{cases.F_S:g} Hz and {cases.POINTS} points",
        f"chirp of {1e3 * cases.CHIRP_M:g} mm, from {low:g} to {high:g} Hz",
        f"from {cases.ROAD_HZ[0]:g} to {cases.ROAD_HZ[1]:g} Hz, up to {1e3 * cases.ROAD_M:g} mm",
        f"noise of {1e6 * bench.displacement_sigma:g} µm and {bench.displacement_bits} bit",
        f"noise of {bench.acceleration_sigma:g} m/s²",
        f"{1e6 * field.displacement_sigma:g} µm and {field.displacement_bits} bit, "
        f"{field.acceleration_sigma:g} m/s² and a bias of the same size",
        f"calibration errors of {100 * field.scale:g} %",
    ):
        assert said in TEXT, said
    assert field.acceleration_bias == field.acceleration_sigma


@pytest.mark.slow
def test_the_figures_of_the_chirp_are_found_again(cases):
    case = cases.observed(cases.drive(cases.chirps))
    largest = 1e6 * np.nanmax(np.abs(case.error), axis=0)
    printed = re.findall(r"V\.A chirp, (?:left|right) \| ideal \| ([\d.]+) µm", PAGE)
    np.testing.assert_allclose(largest, np.array(printed, dtype=float), atol=0.06)


def test_the_refusal_is_the_one_that_comes():
    model = QuarterCar(400.0, 40.0, 2e4, 1500.0, 2e5).model()
    measured = [Reading(Kind.DISPLACEMENT, freedom.name, 1e-4) for freedom in model.freedoms]
    with pytest.raises(InputError) as refusal:
        UnknownInputObserver.of(model, 0.005, np.zeros(4), measured, 0.05)
    assert str(refusal.value) in PAGE.splitlines()


def test_the_example_runs():
    code = re.search(r"```python\n(.*?)```", PAGE, re.DOTALL).group(1)
    names = {}
    exec(code, names)
    found = names["observer"].estimate(np.zeros((200, 5)), np.zeros((200, 2)))
    assert not found.road[-1].any()
