"""Tables that SDK, proving ground and reference transcribed apart hold the same figures."""

import pytest

from floatref.measures.roughness.thresholds import SAMPLE_ROADS
from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.proving_ground.roads.random_roads import CASES
from floatref_reference.chapter_2.section_2_1_4_1_spectral_models import TABLE_2_2, TABLE_2_3
from floatref_reference.chapter_5.section_5_2 import TABLE_5_1, TABLE_5_2


@pytest.mark.cites("Table 2.2")
def test_the_four_sample_roads() -> None:
    ours = [tuple(vars(case).values()) for case in CASES.values()]
    assert ours == [(road.G_a, road.G_s, road.G_e) for road in TABLE_2_2.values()]


@pytest.mark.cites("Table 2.3")
def test_the_four_cases_for_analysis() -> None:
    ours = {name: tuple(vars(road).values()) for name, road in SAMPLE_ROADS.items()}
    assert ours == {n: (r.G_a / r.G_s, r.G_e / r.G_s) for n, r in TABLE_2_3.items()}


@pytest.mark.cites("Table 5.1")
def test_the_seven_stops() -> None:
    runs = [run for run in RUNS.values() if run.kind == "stop"]
    ours = [(run.mean_deceleration_g, run.dwell_s, run.event_location_m) for run in runs]
    assert ours == [tuple(row[1:]) for row in TABLE_5_1]


@pytest.mark.cites("Table 5.2")
def test_the_seven_brakes_and_the_near_stop() -> None:
    runs = [run for run in RUNS.values() if run.kind in {"braking", "near-stop"}]
    ours = {
        (r.mean_deceleration_g, r.initial_speed_kmh, r.event_speed_kmh, r.event_location_m)
        for r in runs
    }
    assert ours == {tuple(row[1:]) for row in TABLE_5_2}
