"""`coasting`: lifting the throttle and rolling does not reach the profile."""

from typing import Any

from floatref_conformance.checks.driving import strategies
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.driving.layout import placed
from floatref_conformance.checks.driving.roads import EVERYDAY
from floatref_conformance.checks.driving.rules import LIGHT
from floatref_conformance.checks.driving.wording import EVENT_FLAGS, EVERYWHERE, HOW
from floatref_conformance.proving_ground.scenario import Scenario


def _row(speed: float, final: float, drag_g: float, **others: Any) -> Scenario:
    return Scenario(
        manoeuvre="coasting",
        speed_kmh=speed,
        final_speed_kmh=final,
        deceleration_g=drag_g,
        **others,
    )


ROWS = (
    _row(72.0, 54.0, 0.037),
    _row(97.0, 20.0, 0.05, vehicle="pickup", rate_hz=4000.0),
    _row(30.0, 20.0, 0.02, vehicle="minivan", rate_hz=8000.0, profile_interval_m=0.01),
    _row(72.5, 49.0, 0.048, vehicle="soft-van", rate_hz=4000.0, grade_percent=4.0),
    _row(72.0, 40.4, 0.036, vehicle="trailer", cross_slope_percent=3.0, curvature_per_km=1.0),
    _row(90.0, 60.0, 0.03, vehicle="loaded-van", rate_hz=4000.0, profile_interval_m=0.025),
    _row(50.0, 25.0, 0.045, vehicle="soft-van", grade_percent=-3.0),
    _row(35.0, 30.0, 0.05, vehicle="pickup", rate_hz=8000.0, curvature_per_km=-0.6),
)
"""The first, fourth and fifth are passes of Table 3.6."""

COASTING = DrivingCheck(
    id="coasting",
    title="the profile follows the road while the vehicle coasts",
    clause="AASHTO R 56-14: correlation 0.92; 3.3.4 of Karamihas 2021 for the decelerations",
    derivation=HOW
    + (
        "Vehicles roll from 30 to 97 km/h down to 20 km/h or more at 0.02 to 0.05 g; Table 3.6 "
        "has 0.036 to 0.048 g. Scored are the 96 m before and 64.9 m behind both the start and "
        "the end of the coast. No profiler of section 3.3.4 showed a coast in its profile. Class "
        "nominal needs correlation 0.92 or the IRI within 10 %, adequate 0.92 and 5 %, reference "
        "0.98 and 2 %. "
    )
    + EVENT_FLAGS
    + (
        "In 124 such drives the two recommended pipelines came to 19 % of the limit of IRI or "
        "correlation, 50 % of the ends' and 24 % of the bump's at most, and flagged nothing "
        "else."
    ),
    floor=EVERYWHERE,
    rows=ROWS,
    quick=4,
    roads=EVERYDAY,
    scenarios=strategies.coasting,
    simplest_scenario=placed(_row(72.0, 58.0, 0.04)),
    rules={"": LIGHT},
)
