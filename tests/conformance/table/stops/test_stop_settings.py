"""Which stops are drawn: all of them can be driven, and few are the same as among many."""

from dataclasses import replace
from itertools import product
from math import sqrt

import numpy as np
import pytest

from floatref.errors import InputError
from floatref_conformance.proving_ground.staging import drive_of
from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES
from floatref_conformance.table.stops import StopSettings
from floatref_conformance.table.stops.stop_settings import (
    DECELERATION_G,
    DWELL_S,
    FINAL_SPEED_KMH,
    SPEED_KMH,
    STOP_ROADS,
    draw_stop,
)
from floatref_conformance.table.table_settings import offered_pipelines

NOMINAL = frozenset[str]()


@pytest.mark.parametrize("corner", list(product(SPEED_KMH, DECELERATION_G, FINAL_SPEED_KMH)))
def test_the_farthest_drives_fit(corner):
    speed, deceleration, final = corner
    drawn = draw_stop(0, "minivan", STOP_ROADS[0], 0, NOMINAL)
    changed = {"speed_kmh": speed, "deceleration_g": deceleration, "final_speed_kmh": final}
    drive = drive_of(replace(drawn, dwell_s=DWELL_S[1], **changed))
    assert drive.length_m == pytest.approx(drawn.length_m)
    assert drive.duration_s > DWELL_S[1]


def test_a_stop_has_the_slip_and_the_laser_that_scenarios_have_by_default():
    drawn = draw_stop(0, "minivan", STOP_ROADS[0], 0, NOMINAL)
    assert (drawn.slip_percent_per_g, drawn.laser_ahead_m) == (2.5, 0.105)


def test_numbers_are_drawn_all_over_their_ranges():
    drawn = [draw_stop(5, "trailer", STOP_ROADS[1], number, NOMINAL) for number in range(400)]
    for name, (low, high), middle in (
        ("speed_kmh", SPEED_KMH, sum(SPEED_KMH) / 2),
        ("deceleration_g", DECELERATION_G, sum(DECELERATION_G) / 2),
        ("final_speed_kmh", FINAL_SPEED_KMH, sum(FINAL_SPEED_KMH) / 2),
        ("dwell_s", DWELL_S, sqrt(DWELL_S[0] * DWELL_S[1])),
    ):
        values = np.array([getattr(scenario, name) for scenario in drawn])
        assert low <= values.min() < middle < values.max() <= high
        assert 0.4 < np.mean(values < middle) < 0.6, name
    assert len({scenario.seed for scenario in drawn}) == len(drawn)


def test_every_vehicle_stops_on_every_road_as_often_as_asked():
    settings = StopSettings(stops=2)
    drives = [scenario for _, scenario in settings.scenarios(NOMINAL)]
    assert len(drives) == settings.passes == 2 * 3 * len(VEHICLES)
    found = [(s.vehicle, s.road, s.iri_m_per_km) for s in drives]
    roads = [(road.kind, road.iri_m_per_km) for road in STOP_ROADS]
    assert set(found) == {(v, *road) for v, road in product(VEHICLES, roads)}
    assert all(found.count(one) == 2 for one in found)
    assert len({s.seed for s in drives}) == len(drives)


def test_fewer_stops_and_vehicles_are_the_same_ones():
    many = dict(StopSettings(seed=4, stops=3).scenarios(NOMINAL))
    few = dict(StopSettings(seed=4, stops=2, vehicles=("soft-van",)).scenarios(NOMINAL))
    assert few.items() < many.items()
    other = dict(StopSettings(seed=5, stops=2, vehicles=("soft-van",)).scenarios(NOMINAL))
    assert not {s.seed for s in other.values()} & {s.seed for s in many.values()}


def test_channels_are_recorded_as_they_are_needed():
    road = STOP_ROADS[2]
    rich = draw_stop(1, "pickup", road, 0, frozenset({"imu", "gnss"}))
    assert (rich.imu, rich.gnss) == (True, True)
    assert draw_stop(1, "pickup", road, 0, NOMINAL) == replace(rich, imu=False, gnss=False)


def test_all_is_the_default_in_the_usual_order():
    settings = StopSettings()
    assert settings == StopSettings(vehicles=(), pipelines=())
    assert settings.pipelines == offered_pipelines()
    assert StopSettings(vehicles=("soft-van", "minivan")).vehicles == ("minivan", "soft-van")


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"vehicles": ("soft-vans",)}, "vehicle soft-vans: unknown; did you mean soft-van?"),
        ({"pipelines": ("spatial-basics",)}, "did you mean spatial-basic?"),
        ({"stops": 0}, "stops is 0; give 1 or more"),
        ({"seed": -1}, "seed is -1; give 0 or more"),
    ],
)
def test_settings_that_make_no_table_are_refused(wrong, said):
    with pytest.raises(InputError) as refused:
        StopSettings(**wrong)
    assert said in str(refused.value)
