"""Hypothesis strategies of the drives that each check may ask for; they shrink to the defaults.

Numbers are rounded, so that a case reads well. Hypothesis is imported when a strategy is asked
for.
"""

from collections.abc import Callable
from dataclasses import replace
from math import ceil, floor
from typing import TYPE_CHECKING

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.checks.driving.layout import least_spacing_m, placed
from floatref_conformance.checks.driving.surroundings import (
    CRAWL,
    CREEP,
    EVENT,
    STAND,
    STEADY,
    number,
)
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

STOPS_APART_M = 120.0
"""Distance of two stops at least: the filter spreads the error of one over a cut-off wavelength."""
SOONEST_STAND_S = 1.1
"""Where a brake is released the vehicle is at least so far in s from a standstill."""


def hardest_release_g(speed_kmh: float) -> float:
    """Return the hardest brake in g that is released at ``speed_kmh``, by `SOONEST_STAND_S`."""
    return floor(100 * speed_kmh * KMH / STANDARD_GRAVITY / SOONEST_STAND_S) / 100


def constant_speed() -> "SearchStrategy[Scenario]":
    """Return drives at 16.1 to 97 km/h."""
    return _all_of(_constant)


def low_speed() -> "SearchStrategy[Scenario]":
    """Return drives at 4 to 15.9 km/h, constant or wandering between two such speeds.

    They take long, and have one wheel path.
    """
    return _all_of(_slow)


def coasting() -> "SearchStrategy[Scenario]":
    """Return drives that roll from 30 to 97 km/h down by 5 km/h or more, at 0.02 to 0.05 g."""
    return _all_of(_coasting)


def throttle() -> "SearchStrategy[Scenario]":
    """Return drives that speed up from 20 to 70 km/h by 5 km/h or more, at 0.05 to 0.25 g."""
    return _all_of(_throttle)


def braking() -> "SearchStrategy[Scenario]":
    """Return brakes of 0.05 to 0.84 g from 30 to 100 km/h down to 15 to 60 km/h.

    None is harder than `hardest_release_g` of the speed at which it is released, or released at
    16 km/h, where the encoder's scale decides whether what follows is slow.
    """
    return _all_of(_braking)


def near_stop() -> "SearchStrategy[Scenario]":
    """Return brakes of 0.1 to 0.25 g to a crawl of 11 to 15 km/h for 0.5 to 2 s."""
    return _all_of(_near_stop)


def stop() -> "SearchStrategy[Scenario]":
    """Return one to three stops of 0.5 to 120 s, `STOPS_APART_M` apart, at 0.1 to 0.3 g."""
    return _all_of(_stop)


def dead_start() -> "SearchStrategy[Scenario]":
    """Return starts from rest after 1 to 60 s, up to 30 to 72 km/h."""
    return _all_of(_dead_start)


def _all_of(drive: Callable[["DrawFn"], Scenario]) -> "SearchStrategy[Scenario]":
    from hypothesis import strategies as st

    @st.composite
    def scenarios(draw: "DrawFn") -> Scenario:
        return placed(drive(draw))

    return scenarios()


def _constant(draw: "DrawFn") -> Scenario:
    return Scenario(speed_kmh=draw(number(16.1, 97.0, 0.1, 72.0)), **STEADY.draw(draw))


def _slow(draw: "DrawFn") -> Scenario:
    from hypothesis import strategies as st

    wandering = draw(st.booleans())
    speed = draw(number(4.0, 12.0 if wandering else 15.9, 0.1, 12.0))
    drive = Scenario(speed_kmh=speed, tracks=("left",), **CREEP.draw(draw))
    if not wandering:
        return drive
    fastest = draw(number(speed + 0.5, 15.9, 0.1, 15.0))
    return replace(drive, manoeuvre="creeping", event_speed_kmh=fastest)


def _coasting(draw: "DrawFn") -> Scenario:
    speed = draw(number(30.0, 97.0, 1.0, 72.0))
    return Scenario(
        manoeuvre="coasting",
        speed_kmh=speed,
        final_speed_kmh=draw(number(20.0, speed - 5.0, 1.0, 58.0)),
        deceleration_g=draw(number(0.02, 0.05, 0.005, 0.04)),
        **STEADY.draw(draw),
    )


def _throttle(draw: "DrawFn") -> Scenario:
    speed = draw(number(20.0, 70.0, 1.0, 32.0))
    return Scenario(
        manoeuvre="throttle",
        speed_kmh=speed,
        final_speed_kmh=draw(number(speed + 5.0, 97.0, 1.0, 72.0)),
        deceleration_g=draw(number(0.05, 0.25, 0.01, 0.15)),
        **STEADY.draw(draw),
    )


def _braking(draw: "DrawFn") -> Scenario:
    speed = draw(number(30.0, 100.0, 1.0, 72.0))
    released = draw(number(15.0, min(60.0, speed - 5.0), 1.0, 30.0).map(_off_16))
    hardest = min(0.84, hardest_release_g(released))
    return Scenario(
        manoeuvre="braking",
        speed_kmh=speed,
        event_speed_kmh=released,
        deceleration_g=draw(number(0.05, hardest, 0.01, 0.2)),
        **EVENT.draw(draw),
    )


def _off_16(speed_kmh: float) -> float:
    """Return a speed that an encoder tells to be above or below 16 km/h as it is."""
    return 17.0 if speed_kmh == 16.0 else speed_kmh


def _near_stop(draw: "DrawFn") -> Scenario:
    return Scenario(
        manoeuvre="near-stop",
        speed_kmh=draw(number(40.0, 90.0, 1.0, 72.0)),
        event_speed_kmh=draw(number(11.0, 15.0, 0.5, 11.0)),
        deceleration_g=draw(number(0.1, 0.25, 0.01, 0.2)),
        dwell_s=draw(number(0.5, 2.0, 0.5, 2.0)),
        final_speed_kmh=draw(number(30.0, 72.0, 1.0, 58.0)),
        **CRAWL.draw(draw),
    )


def _stop(draw: "DrawFn") -> Scenario:
    from hypothesis import strategies as st

    once = Scenario(
        manoeuvre="stop",
        speed_kmh=draw(number(30.0, 90.0, 1.0, 72.0)),
        deceleration_g=draw(number(0.1, 0.3, 0.01, 0.2)),
        dwell_s=draw(number(0.5, 20.0, 0.5, 5.0) | number(20.0, 120.0, 10.0, 20.0)),
        final_speed_kmh=draw(number(30.0, 58.0, 1.0, 58.0)),
        **STAND.draw(draw),
    )
    stops = draw(st.integers(1, 3))
    if stops == 1:
        return once
    least = max(STOPS_APART_M, float(ceil(least_spacing_m(once))))
    spacing = least + draw(number(0.0, 100.0, 10.0))
    return replace(once, stops=stops, stop_spacing_m=spacing)


def _dead_start(draw: "DrawFn") -> Scenario:
    return Scenario(
        manoeuvre="dead-start",
        dwell_s=draw(number(1.0, 60.0, 1.0, 5.0)),
        final_speed_kmh=draw(number(30.0, 72.0, 1.0, 58.0)),
        **EVENT.draw(draw),
    )
