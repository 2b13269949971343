"""`low-speed`: below 16 km/h the profile is that of the road, or says that it is not."""

from floatref_conformance.checks.driving import strategies
from floatref_conformance.checks.driving.check import DrivingCheck
from floatref_conformance.checks.driving.layout import placed
from floatref_conformance.checks.driving.roads import EVERYDAY
from floatref_conformance.checks.driving.rules import SLOW
from floatref_conformance.checks.driving.wording import BUMP_FLOOR, HOW
from floatref_conformance.proving_ground.scenario import Scenario

ROWS = (
    Scenario(speed_kmh=15.9, rate_hz=8000.0),
    Scenario(
        speed_kmh=4.0,
        vehicle="minivan",
        rate_hz=4000.0,
        profile_interval_m=0.025,
        tracks=("left",),
    ),
    Scenario(
        manoeuvre="creeping", speed_kmh=4.0, event_speed_kmh=15.9, vehicle="trailer", rate_hz=4000.0
    ),
    Scenario(speed_kmh=10.0, vehicle="pickup", grade_percent=3.0),
    Scenario(speed_kmh=6.0, vehicle="trailer", rate_hz=4000.0, cross_slope_percent=-3.0),
    Scenario(speed_kmh=8.0, vehicle="soft-van", rate_hz=8000.0, grade_percent=-4.0),
    Scenario(manoeuvre="creeping", speed_kmh=4.0, event_speed_kmh=5.0, rate_hz=4000.0),
    Scenario(manoeuvre="creeping", speed_kmh=10.0, event_speed_kmh=15.0, profile_interval_m=0.01),
)
"""Sections 5.2 and 5.3 have 16 km/h and 4 to 5 km/h."""

LOW_SPEED = DrivingCheck(
    id="low-speed",
    title="the profile follows the road, or says where not, below 16 km/h",
    clause="Karamihas 2021, section 5.1: suppression gives the profile up below 16 km/h",
    derivation=HOW
    + (
        "Vehicles drive at 4 to 15.9 km/h, constantly or wandering between two speeds, and never "
        "reach 16 km/h. The acceleration of a wave falls with the square of the speed: at 5 km/h "
        "that of 42.9 m and 10 mm is 0.4 mm/s², 1/24 of the accelerometer's bias. A "
        "nominal profiler may therefore flag as much as it likes, all of it if need be, and the "
        "IRI of the rest has to be within 5 %; the report says how much was flagged. An adequate "
        "profiler is asked for 0.92 and 5 % over all points, a reference for 0.95 and 3 %: a "
        "point without elevation fails both. The two recommended pipelines flag all of it."
    ),
    floor=BUMP_FLOOR.format(
        where="115 m from the start",
        slow="Where class nominal flags any of these 9 m it does not answer for the bump. ",
    ),
    rows=ROWS,
    quick=3,
    roads=EVERYDAY,
    scenarios=strategies.low_speed,
    simplest_scenario=placed(Scenario(speed_kmh=12.0)),
    rules={"": SLOW},
)
