"""Laws of a scenario: it survives JSON, is told apart by its hash, and refuses nonsense."""

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import iri
from floatref_conformance.proving_ground.drives.runs import RECORDING_LENGTH_M, RUNS
from floatref_conformance.proving_ground.scenario import (
    MANOEUVRES,
    ROADS,
    STATIONARY,
    Scenario,
    repeat_passes,
    scenario_of_run,
)
from floatref_conformance.proving_ground.sensors.sensor_suite import SensorSuite
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import (
    course_of,
    drive_of,
    road_of,
    setup_of,
    suite_of,
)
from floatref_conformance.proving_ground.vehicles.parameter_sets import LOADED_VAN, VEHICLES

scenarios = st.builds(
    Scenario,
    seed=st.integers(0, 2**63 - 1),
    road=st.sampled_from(ROADS),
    vehicle=st.sampled_from(sorted(VEHICLES)),
    manoeuvre=st.sampled_from(MANOEUVRES),
    speed_kmh=st.floats(0, 150, exclude_min=True),
    sensors=st.floats(0, 2),
    imu=st.booleans(),
    tracks=st.sampled_from([("main",), ("left", "right"), ("right",)]),
)


@settings(deadline=None, max_examples=50)
@given(scenario=scenarios)
def test_scenario_survives_json(scenario: Scenario) -> None:
    text = json.dumps(scenario.to_dict(), allow_nan=False)
    again = Scenario.from_dict(json.loads(text))
    assert again == scenario
    assert again.hash == scenario.hash


def test_every_field_changes_the_hash() -> None:
    changes: dict[str, Any] = {
        "road_seed": 3,
        "road": "flat",
        "vehicle": "pickup",
        "manoeuvre": "stop",
        "tracks": ("left",),
        "imu": False,
        "gnss": False,
        "stops": 3,
        "wander_m": 0.1,
        "wander_within_m": 0.02,
        "second_distance": "can",
    }
    plain = Scenario()
    hashes = {plain.hash}
    for name, value in vars(plain).items():
        hashes.add(replace(plain, **{name: changes.get(name) or _other(value)}).hash)
    assert len(hashes) == 1 + len(vars(plain))


def _other(value: Any) -> Any:
    return not value if isinstance(value, bool) else value + (1 if value in (0, 72) else value / 8)


def test_a_road_seed_draws_the_road_whatever_the_seed() -> None:
    drawn = [
        road_of(s, 120.0).elevation["left"]
        for s in (
            Scenario(seed=7),
            Scenario(seed=8, road_seed=7),
            Scenario(seed=7, road_seed=8),
        )
    ]
    assert np.array_equal(drawn[0], drawn[1])
    assert not np.array_equal(drawn[0], drawn[2])


def test_equal_numbers_have_one_hash() -> None:
    assert Scenario(rate_hz=16000).hash == Scenario(rate_hz=16000.0).hash


def test_unknown_keys_and_formats_are_refused() -> None:
    assert Scenario.from_dict({"$schema": "mine.json", "seed": 4}) == Scenario(seed=4)
    with pytest.raises(InputError, match="key 'crown_m': unknown; did you mean crown_mm"):
        Scenario.from_dict({"crown_m": 0.1})
    with pytest.raises(InputError, match="format 'floatref-scenario/9': unknown"):
        Scenario.from_dict({"format": "floatref-scenario/9"})


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"seed": -1}, "seed is -1; it must lie between 0"),
        ({"seed": 1.5}, "seed is 1.5; give a whole number"),
        ({"seed": True}, "seed is True; give a number"),
        ({"rate_hz": 500}, "rate_hz is 500; it must lie between 1000"),
        ({"length_m": float("nan")}, "length_m is nan; give a number"),
        ({"speed_kmh": "72"}, "speed_kmh is '72'; give a number"),
        ({"imu": 1}, "imu is 1; give true or false"),
        ({"road": "sayers-norml"}, "did you mean sayers-normal"),
        ({"manoeuvre": "sg_10.7s_0.2g"}, "did you mean sg_10.7s_0.20g"),
        ({"vehicle": "tank"}, "vehicle tank: unknown"),
        ({"tracks": []}, "give a list of different names"),
        ({"tracks": ["left", "left"]}, "give a list of different names"),
        ({"tracks": ["left", "../x"]}, "tracks has '../x'; a name has at most 48 characters"),
        ({"tracks": ["a/b"]}, "tracks has 'a/b'"),
        ({"tracks": [".hidden"]}, "tracks has '.hidden'"),
        ({"tracks": ["x" * 49]}, "tracks has 'x"),
        ({"tracks": [""]}, "tracks has ''"),
        ({"seed": 10**400}, r"seed is 10+\.\.\.0+; it must lie between 0"),
        ({"speed_kmh": -(10**400)}, r"speed_kmh is -10+\.\.\.0+; it must lie between 0 and 150"),
        ({"manoeuvre": "quiescent", "speed_kmh": 0}, "speed_kmh is 0; quiescent needs a speed"),
        ({"manoeuvre": "bounce", "speed_kmh": 0}, "speed_kmh is 0; bounce needs a speed"),
        ({"manoeuvre": "stop", "speed_kmh": 0}, "speed_kmh is 0; stop needs a speed"),
        ([], "a scenario is a JSON object"),
    ],
)
def test_values_that_make_no_scenario_are_refused(fields: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Scenario.from_dict(fields)


@pytest.mark.slow
@given(count=st.integers(1, 5), seed=st.integers(0, 99), road_seed=st.integers(-1, 99))
def test_repeat_passes_meet_one_road_with_errors_of_their_own(count, seed, road_seed) -> None:
    passes = repeat_passes(Scenario(seed=seed, road_seed=road_seed), count)
    assert len({p.seed for p in passes}) == len(passes) == count
    assert {p.road_seed for p in passes} == {seed if road_seed < 0 else road_seed}
    first = road_of(replace(passes[0], length_m=40.0), 40.0)
    again = road_of(Scenario(seed=seed, road_seed=road_seed, length_m=40.0), 40.0)
    assert np.array_equal(first.elevation["left"], again.elevation["left"])


@pytest.mark.parametrize(
    "numbers",
    [
        {"speed_kmh": 0.001, "length_m": 1e5},
        {"manoeuvre": "creeping", "speed_kmh": 1e-7, "event_speed_kmh": 2e-7},
        {"manoeuvre": "stop", "dwell_s": 600.0, "rate_hz": 64000.0},
    ],
)
def test_drive_too_long_for_the_memory_is_refused_before_it_is_made(numbers: Any) -> None:
    with pytest.raises(
        InputError, match=r"length_m .* is above 67108864 samples; shorten length_m"
    ):
        simulate(Scenario(**numbers))


@pytest.mark.parametrize("name", list(RUNS))
def test_published_runs_fit_the_memory_at_the_highest_rate(name: str) -> None:
    drive_of(scenario_of_run(name, rate_hz=64000.0))


@settings(deadline=None, max_examples=100)
@given(
    kind=st.sampled_from(sorted(set(MANOEUVRES) - set(RUNS) - set(STATIONARY))),
    speeds=st.tuples(*3 * [st.floats(0, 150) | st.sampled_from([0.0, 0.5, 1.5, 2.0, 150.0])]),
    deceleration=st.floats(0.01, 1.0),
    places=st.tuples(st.floats(0, 1e5), st.floats(10, 1e5)),
)
@example(kind="stop", speeds=(2.0, 0.0, 0.0), deceleration=1.0, places=(316.0, 500.0))
def test_numbers_make_a_drive_or_a_clear_refusal(
    kind: str,
    speeds: tuple[float, float, float],
    deceleration: float,
    places: tuple[float, float],
) -> None:
    numbers = dict(zip(("speed_kmh", "event_speed_kmh", "final_speed_kmh"), speeds, strict=True))
    numbers |= dict(zip(("event_at_m", "length_m"), places, strict=True))
    try:
        scenario = Scenario(manoeuvre=kind, deceleration_g=deceleration, **numbers)
        drive = drive_of(scenario)
    except InputError:
        return
    assert drive.length_m >= scenario.length_m - 1e-6


@pytest.mark.parametrize("name", list(RUNS))
def test_every_published_run_is_a_scenario(name: str) -> None:
    scenario = scenario_of_run(name, seed=3, sensors=0.0)
    assert (scenario.seed, scenario.sensors) == (3, 0.0)
    assert drive_of(scenario).length_m >= RECORDING_LENGTH_M - 1e-6


@pytest.mark.parametrize("kind", sorted(set(MANOEUVRES) - set(RUNS) - set(STATIONARY)))
def test_every_manoeuvre_is_driven(kind: str) -> None:
    fast = 90.0 if kind == "throttle" else 58.0
    scenario = Scenario(manoeuvre=kind, final_speed_kmh=fast)
    if kind == "creeping":
        scenario = replace(scenario, speed_kmh=4.0, event_speed_kmh=6.0)
    if kind in ("braking", "near-stop"):
        scenario = replace(scenario, event_speed_kmh=12.0, dwell_s=1.0)
    drive = drive_of(scenario)
    assert drive.length_m >= scenario.length_m - 1e-6
    slowest = drive.knot_speeds_mps.min()
    assert (slowest == 0) == (kind in ("stop", "dead-start"))


@pytest.mark.parametrize("kind", ROADS)
def test_road_has_its_roughness_and_its_bump(kind: str) -> None:
    plain = Scenario(seed=5, road=kind, iri_m_per_km=2.0)
    road = road_of(plain, 120.0)
    inside = (road.distance_m > 26.0) & (road.distance_m < 126.0)
    values = [iri(z[inside], road.spacing_m) for z in road.elevation.values()]
    expected = 0.0 if kind == "flat" else 2.0
    assert np.mean(values) == pytest.approx(expected, rel=0.01, abs=1e-12)
    bumped = road_of(replace(plain, bump_mm=20.0, bump_at_m=80.0), 120.0)
    middle = np.array([80.0])
    assert bumped.at("left", middle) - road.at("left", middle) == pytest.approx(0.02, rel=1e-6)


def test_slopes_and_sensors_follow_the_numbers() -> None:
    scenario = Scenario(grade_percent=4.0, cross_slope_percent=-2.0, curvature_per_km=5.0)
    course = course_of(scenario)
    assert np.tan(course.grade_rad) == pytest.approx(0.04)
    assert np.tan(course.cross_slope_rad) == pytest.approx(-0.02)
    assert course.curvature_per_m == pytest.approx(0.005)
    assert suite_of(replace(scenario, sensors=0.0)) == SensorSuite.ideal()
    assert suite_of(scenario) == SensorSuite()
    setup = setup_of(scenario, LOADED_VAN, {"left": 0.86, "right": -0.86})
    assert setup.tracks["right"].reference_point_m == (LOADED_VAN.sensor_x_m, -0.86, 0.282)
