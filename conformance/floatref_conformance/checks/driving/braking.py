"""`braking`: light brakes do not reach the profile; what hard ones leave is bounded and flagged."""

from typing import Any

from floatref_conformance.checks.driving import strategies
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.driving.layout import placed
from floatref_conformance.checks.driving.roads import WORN
from floatref_conformance.checks.driving.rules import HARD, LIGHT
from floatref_conformance.checks.driving.wording import EVENT_FLAGS, EVENTS, EVERYWHERE, HOW
from floatref_conformance.proving_ground.scenario import Scenario


def _row(speed: float, released: float, deceleration_g: float, **others: Any) -> Scenario:
    return Scenario(
        manoeuvre="braking",
        speed_kmh=speed,
        event_speed_kmh=released,
        deceleration_g=deceleration_g,
        **others,
    )


ROWS = (
    _row(48.8, 34.1, 0.84),
    _row(100.0, 15.0, 0.05, vehicle="minivan", rate_hz=4000.0),
    _row(100.0, 15.0, 0.38, vehicle="trailer", rate_hz=8000.0, profile_interval_m=0.01),
    _row(30.0, 15.0, 0.16, vehicle="pickup", rate_hz=4000.0, profile_interval_m=0.025),
    _row(71.4, 29.9, 0.2, vehicle="pickup", cross_slope_percent=3.0, curvature_per_km=1.0),
    _row(100.0, 60.0, 0.84, vehicle="minivan", rate_hz=4000.0, grade_percent=-4.0),
    _row(71.8, 29.1, 0.39, vehicle="loaded-van", rate_hz=8000.0),
    _row(49.1, 22.1, 0.16, vehicle="trailer", grade_percent=4.0),
    _row(49.1, 19.6, 0.25, vehicle="loaded-van", rate_hz=4000.0, curvature_per_km=-1.0),
    _row(30.0, 17.0, 0.3, vehicle="minivan", profile_interval_m=0.025),
    _row(90.0, 50.0, 0.12, vehicle="pickup", rate_hz=8000.0, cross_slope_percent=-3.0),
    _row(100.0, 30.0, 0.17, vehicle="loaded-van", rate_hz=4000.0, grade_percent=2.0),
)
"""The first, fifth and seventh to ninth are brakes of Table 5.2."""

BRAKING = DrivingCheck(
    id="braking",
    title="the profile follows the road under braking",
    clause="AASHTO R 56-14: correlation 0.92; 3.3.5 and 5.2 of Karamihas 2021 for the brakes",
    derivation=HOW
    + EVENTS
    + (
        "Brakes of 0.05 to 0.84 g, from 30 to 100 km/h to 15 to 60 km/h, are released at once. Up "
        "to 0.16 g they rarely raised the roughness (3.3.1.3): class nominal needs correlation "
        "0.92 or the IRI within 10 %, adequate 0.92 and 5 %, reference 0.98 and 2 %. Beyond, a "
        "nominal profiler cannot know the tilt of its accelerometer: deceleration a on pitch "
        "proportional to a curves the profile by a²/v², at once gone where the brake is released "
        "at speed v. Points that it vouches for have to have the road's IRI within 5 % or 0.1 "
        "m/km, all points together within 50 % or 1 m/km; adequate and reference are limited as "
        "before. So that nominal sensors can keep this, a brake is no harder than v divided by "
        "1.1 s (0.38 g at 15 km/h, 0.84 g from 33 km/h on), roads have 1.5 to 4 m/km, and the van "
        "with worn dampers, which pitches by up to 5 degrees per g, stays at home. "
    )
    + EVENT_FLAGS
    + (
        "In 323 such drives the two recommended pipelines came to 59 % of the limit of all "
        "points, 24 % of that of the unflagged part, 31 % of that of light brakes, 60 % of the "
        "flagged length and 22 % of the bump's limit at most."
    ),
    floor=EVERYWHERE,
    rows=ROWS,
    quick=6,
    roads=WORN,
    scenarios=strategies.braking,
    simplest_scenario=placed(_row(72.0, 30.0, 0.2)),
    rules={"up to 0.16 g": LIGHT, "above 0.16 g": HARD},
)
