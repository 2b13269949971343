"""The worked closed forms on the page about what a road is paid by are what the measures give."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from floatref.measures import (
    Profilograph,
    TraceRules,
    Waveband,
    bumps_and_dips,
    deviation_from_average,
    half_car_roughness_index,
    join_profile_indices,
    profile_indices,
    profilograph_trace,
    ride_number,
    rolling_straightedge,
    straightedge_deviation,
    waveband_energy,
)

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "roughness.md").read_text(encoding="utf-8")
INTERVAL, INCH = 0.0762, 0.0254


def sine(wavelength: float, points: int = 4001) -> np.ndarray:
    return 0.005 * np.sin(2.0 * np.pi * INTERVAL * np.arange(points) / wavelength)


def largest_mm(values: np.ndarray) -> float:
    return 1000.0 * float(np.nanmax(np.abs(values)))


def bump_mm() -> float:
    z = np.zeros(600)
    z[300:310] = 0.005
    (bump,) = bumps_and_dips(z, INTERVAL)
    return 1000.0 * bump.deviation_m


def index_in_per_mi() -> float:
    trace = np.zeros(2112)
    for place, count, height in ((100, 20, 0.37), (300, 30, 0.23)):
        trace[place : place + count] = height * INCH
        trace[1000 + place : 1000 + place + count] = -height * INCH
    (found,) = profile_indices(trace, np.ones(2112, dtype=bool), INTERVAL)
    return 63.36 * found.profile_index_m_per_km


def half_car() -> float:
    return half_car_roughness_index(sine(5.0), -sine(5.0), INTERVAL)


WORKED: list[Callable[[], float]] = [
    lambda: largest_mm(straightedge_deviation(sine(3.048), INTERVAL)),
    lambda: largest_mm(straightedge_deviation(sine(1.524), INTERVAL)),
    lambda: largest_mm(profilograph_trace(sine(7.62), INTERVAL, Profilograph(low_pass_m=0.0))),
    lambda: largest_mm(deviation_from_average(sine(7.62), INTERVAL)),
    bump_mm,
    lambda: 1000.0 * waveband_energy(sine(4.0), INTERVAL, Waveband(8.0, 1.6)).rms_elevation_m,
    index_in_per_mi,
    half_car,
    lambda: ride_number(join_profile_indices(0.003, 0.004)),
]


def test_every_worked_value_is_what_the_measure_gives() -> None:
    table = PAGE.partition("## Worked closed forms")[2].partition("\n## ")[0]
    shown = re.findall(r"\| (\d+\.\d+)(?: (?:mm|in/mi|m/km))? \|$", table, re.MULTILINE)
    assert len(shown) == len(WORKED)
    for text, measure in zip(shown, WORKED, strict=True):
        # 4000 intervals hold 76.2 waves of 4 m: the continuation has a bend at one end.
        assert measure() == pytest.approx(float(text), rel=2e-3, abs=1e-9), text


def test_the_numbers_of_the_rules_are_on_the_page() -> None:
    rules, edge = TraceRules(), rolling_straightedge(np.zeros(200), INTERVAL)
    page = " ".join(PAGE.split())
    assert f"0.2 in ({1000 * rules.blanking_band_m:g} mm" in page
    assert f"0.3 in ({1000 * rules.bump_height_m:g} mm" in page
    assert f"({Profilograph().low_pass_m} m, `--low-pass`)" in page
    assert (rules.least_height_m, rules.rounding_m) == pytest.approx((0.03 * INCH, 0.05 * INCH))
    assert f"10 ft ({edge.length_m:.3f} m)" in page
