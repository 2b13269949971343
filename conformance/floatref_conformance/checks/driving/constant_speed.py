"""`constant-speed`: from 16 to 97 km/h the profile is that of the road."""

from floatref_conformance.checks.driving import strategies
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.driving.layout import placed
from floatref_conformance.checks.driving.roads import EVERYDAY
from floatref_conformance.checks.driving.rules import CONSTANT
from floatref_conformance.checks.driving.wording import BUMP_FLOOR, HOW, NO_EVENT_FLAGS
from floatref_conformance.proving_ground.scenario import Scenario

ROWS = (
    Scenario(speed_kmh=72.0),
    Scenario(speed_kmh=16.1, vehicle="minivan", rate_hz=8000.0),
    Scenario(speed_kmh=97.0, vehicle="pickup", grade_percent=2.0, profile_interval_m=0.01),
    Scenario(
        speed_kmh=40.0,
        vehicle="soft-van",
        rate_hz=4000.0,
        grade_percent=-4.0,
        cross_slope_percent=3.0,
        curvature_per_km=1.0,
        profile_interval_m=0.025,
    ),
    Scenario(speed_kmh=24.0, vehicle="trailer", rate_hz=4000.0),
    Scenario(speed_kmh=32.0, vehicle="pickup", rate_hz=8000.0, cross_slope_percent=-2.0),
    Scenario(speed_kmh=48.0, vehicle="loaded-van", rate_hz=4000.0, grade_percent=4.0),
    Scenario(speed_kmh=56.0, vehicle="minivan", curvature_per_km=-1.0, profile_interval_m=0.025),
    Scenario(speed_kmh=64.0, vehicle="trailer", cross_slope_percent=3.0),
    Scenario(speed_kmh=80.0, vehicle="soft-van", rate_hz=8000.0, profile_interval_m=0.01),
    Scenario(speed_kmh=90.0, vehicle="loaded-van", rate_hz=4000.0, curvature_per_km=0.6),
    Scenario(speed_kmh=97.0, vehicle="trailer", rate_hz=8000.0, grade_percent=-2.0),
)
"""Section 3.3.3 has 16 to 97 km/h; 16.1 km/h is 10 mph."""

CONSTANT_SPEED = DrivingCheck(
    id="constant-speed",
    title="the profile follows the road at constant speed",
    clause="AASHTO R 56-14: correlation 0.92 (nominal); 3.3.3 of Karamihas 2021 for the speeds",
    derivation=HOW
    + (
        "Vehicles drive at 16.1 to 97 km/h, on grades of up to 4 %, cross slopes of up to 3 % and "
        "in curves of 1000 m radius or more, on roads of 0.8 to 5 m/km. Nothing in this needs "
        "suppression, so that every point counts whether it is flagged or not: correlation 0.92 "
        "and IRI within 5 %, where three profilers of section 3.3.3 stayed at all speeds; 0.95 "
        "and 3 % of an adequate profiler, 0.98 and 2 % of a reference. "
    )
    + NO_EVENT_FLAGS
    + (
        "In 136 such drives the two recommended pipelines came to 16 % of the correlation's "
        "limit, 25 % of the IRI's, 50 % of the ends' and 40 % of the bump's at most, and "
        "flagged nothing else."
    ),
    floor=BUMP_FLOOR.format(where="115 m from the start", slow=""),
    rows=ROWS,
    quick=4,
    roads=EVERYDAY,
    scenarios=strategies.constant_speed,
    simplest_scenario=placed(Scenario()),
    rules={"": CONSTANT},
)
