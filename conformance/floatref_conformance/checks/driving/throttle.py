"""`throttle`: speeding up does not reach the profile."""

from typing import Any

from floatref_conformance.checks.driving import strategies
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.driving.layout import placed
from floatref_conformance.checks.driving.roads import EVERYDAY
from floatref_conformance.checks.driving.rules import LIGHT
from floatref_conformance.checks.driving.wording import EVENT_FLAGS, EVERYWHERE, HOW
from floatref_conformance.proving_ground.scenario import Scenario


def _row(speed: float, final: float, gain_g: float, **others: Any) -> Scenario:
    return Scenario(
        manoeuvre="throttle",
        speed_kmh=speed,
        final_speed_kmh=final,
        deceleration_g=gain_g,
        **others,
    )


ROWS = (
    _row(32.0, 72.0, 0.17),
    _row(20.0, 97.0, 0.25, vehicle="pickup", rate_hz=4000.0),
    _row(20.0, 40.0, 0.2, vehicle="soft-van", rate_hz=4000.0, profile_interval_m=0.025),
    _row(70.0, 97.0, 0.05, vehicle="minivan", rate_hz=8000.0, grade_percent=4.0),
    _row(32.0, 72.0, 0.12, vehicle="trailer", cross_slope_percent=3.0, curvature_per_km=1.0),
    _row(50.0, 55.0, 0.25, vehicle="loaded-van", rate_hz=8000.0, profile_interval_m=0.01),
    _row(25.0, 60.0, 0.1, vehicle="soft-van", grade_percent=-3.0),
    _row(40.0, 80.0, 0.21, vehicle="trailer", rate_hz=4000.0, curvature_per_km=-0.6),
)
"""Section 3.3.6 has 32 to 72 km/h at an average of up to 0.17 g, beginning at up to 0.27 g."""

THROTTLE = DrivingCheck(
    id="throttle",
    title="the profile follows the road under throttle",
    clause="AASHTO R 56-14: correlation 0.92; 3.3.6 of Karamihas 2021 for the accelerations",
    derivation=HOW
    + (
        "Vehicles speed up from 20 to 70 km/h by at least 5 km/h and to at most 97 km/h, at 0.05 "
        "to 0.25 g; section 3.3.6 has up to 0.27 g. The acceleration comes and goes with a jerk "
        "of 0.2 g/s: pitched most, the vehicle accelerates steadily, which only long waves feel. "
        "Scored are the 96 m before and 64.9 m behind both the start and the end. No pass of "
        "section 3.3.6 showed the throttle in its IRI. Class nominal needs correlation 0.92 or "
        "the IRI within 10 %, adequate 0.92 and 5 %, reference 0.98 and 2 %. "
    )
    + EVENT_FLAGS
    + (
        "In 124 such drives the two recommended pipelines came to 44 % of the limit of IRI or "
        "correlation, 50 % of the ends' and 27 % of the bump's at most, and flagged nothing "
        "else."
    ),
    floor=EVERYWHERE,
    rows=ROWS,
    quick=4,
    roads=EVERYDAY,
    scenarios=strategies.throttle,
    simplest_scenario=placed(_row(32.0, 72.0, 0.15)),
    rules={"": LIGHT},
)
