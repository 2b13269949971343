"""Hypothesis strategies of the drives of each check; they shrink to the defaults.

Numbers are rounded, so that a case is easy to read. Hypothesis is imported when a strategy is
requested.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, floor
from typing import TYPE_CHECKING, Any

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.checks.driving.edition import ROADS, STEP_M_PER_KM, Roads
from floatref_conformance.checks.driving.layout import least_spacing_m, place
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

INTERVALS_M = (0.00508, 0.01, 0.025)
STOPS_APART_M = 120.0
"""Smallest distance of stops in m: the filter spreads an error over a cut-off wavelength."""
SOONEST_STAND_S = 1.1
"""Smallest time in s from the release of a brake to a standstill at that deceleration."""


@dataclass(frozen=True)
class Surroundings:
    """The roads and vehicles of a drive, and the sampling rates.

    Attributes:
        roads: kind and roughness.
        vehicles: names; the first is the simplest.
        grade_percent: steepest slope, up or down.
        cross_slope_percent: steepest slope to either side.
        curvature_per_km: sharpest curve to either side.
        rates_hz: of the accelerometers.
    """

    roads: Roads
    vehicles: Sequence[str]
    grade_percent: float = 4.0
    cross_slope_percent: float = 3.0
    curvature_per_km: float = 1.0
    rates_hz: Sequence[float] = (16000.0, 8000.0, 4000.0)

    def draw(self, draw: "DrawFn") -> dict[str, Any]:
        """Return a scenario's numbers apart from its drive."""
        from hypothesis import strategies as st

        grade, cross, bend = self.grade_percent, self.cross_slope_percent, self.curvature_per_km
        roads = self.roads
        return {
            "seed": draw(st.integers(0, 2**32 - 1)),
            "road": draw(st.sampled_from(roads.kinds)),
            "iri_m_per_km": draw(number(roads.smoothest, roads.roughest, STEP_M_PER_KM, 1.8)),
            "vehicle": draw(st.sampled_from(tuple(self.vehicles))),
            "grade_percent": draw(number(-grade, grade, 0.5)),
            "cross_slope_percent": draw(number(-cross, cross, 0.5)),
            "curvature_per_km": draw(number(-bend, bend, 0.2)),
            "rate_hz": draw(st.sampled_from(tuple(self.rates_hz))),
            "profile_interval_m": draw(st.sampled_from(INTERVALS_M)),
        }


STEADY = Surroundings(ROADS["everyday"], ("loaded-van", "minivan", "pickup", "trailer", "soft-van"))
"""Drives whose speed changes little or slowly."""
CREEP = replace(STEADY, rates_hz=(8000.0, 4000.0))
"""Long drives, without the rate of 16 kHz, which would need too many samples."""
EVENT = Surroundings(ROADS["worn"], ("loaded-van", "minivan", "pickup", "trailer"))
"""Brakes: all vehicles except the van with worn dampers."""
STAND = replace(EVENT, roads=ROADS["level"])
"""Stops."""
CRAWL = Surroundings(ROADS["level"], ("loaded-van", "minivan", "trailer"))
"""Near stops: vehicles whose profiler is less than 3 m from the middle."""


def number(low: float, high: float, step: float, simplest: float = 0.0) -> "SearchStrategy[float]":
    """Return numbers from ``low`` to ``high`` in whole steps of ``step`` from the simplest."""
    from hypothesis import strategies as st

    base = min(max(simplest, low), high)
    counts = st.integers(ceil((low - base) / step - 1e-9), floor((high - base) / step + 1e-9))
    return counts.map(lambda count: round(base + count * step, 6))


def hardest_release_g(speed_kmh: float) -> float:
    """Return the hardest brake in g for a release at ``speed_kmh``, by `SOONEST_STAND_S`."""
    return floor(100 * speed_kmh * KMH / STANDARD_GRAVITY / SOONEST_STAND_S) / 100


def drives(check: str) -> "SearchStrategy[Scenario]":
    """Return the strategy of all drives of the driving check with id ``check``."""
    from hypothesis import strategies as st

    @st.composite
    def scenarios(draw: "DrawFn") -> Scenario:
        return place(_DRIVES[check](draw))

    return scenarios()


def _constant(draw: "DrawFn") -> Scenario:
    """Return a drive at 16.1 to 97 km/h."""
    return Scenario(speed_kmh=draw(number(16.1, 97.0, 0.1, 72.0)), **STEADY.draw(draw))


def _slow(draw: "DrawFn") -> Scenario:
    """Return a drive at 4 to 15.9 km/h, constant or wandering between two such speeds.

    It takes long, and has one wheel path.
    """
    from hypothesis import strategies as st

    wandering = draw(st.booleans())
    speed = draw(number(4.0, 12.0 if wandering else 15.9, 0.1, 12.0))
    drive = Scenario(speed_kmh=speed, tracks=("left",), **CREEP.draw(draw))
    if not wandering:
        return drive
    fastest = draw(number(speed + 0.5, 15.9, 0.1, 15.0))
    return replace(drive, manoeuvre="creeping", event_speed_kmh=fastest)


def _coasting(draw: "DrawFn") -> Scenario:
    """Return a drive that rolls from 30 to 97 km/h down by 5 km/h or more, at 0.02 to 0.05 g."""
    speed = draw(number(30.0, 97.0, 1.0, 72.0))
    return Scenario(
        manoeuvre="coasting",
        speed_kmh=speed,
        final_speed_kmh=draw(number(20.0, speed - 5.0, 1.0, 58.0)),
        deceleration_g=draw(number(0.02, 0.05, 0.005, 0.04)),
        **STEADY.draw(draw),
    )


def _throttle(draw: "DrawFn") -> Scenario:
    """Return a drive that speeds up from 20 to 70 km/h by 5 km/h or more, at 0.05 to 0.25 g."""
    speed = draw(number(20.0, 70.0, 1.0, 32.0))
    return Scenario(
        manoeuvre="throttle",
        speed_kmh=speed,
        final_speed_kmh=draw(number(speed + 5.0, 97.0, 1.0, 72.0)),
        deceleration_g=draw(number(0.05, 0.25, 0.01, 0.15)),
        **STEADY.draw(draw),
    )


def _braking(draw: "DrawFn") -> Scenario:
    """Return a brake of 0.05 to 0.84 g from 30 to 100 km/h down to 15 to 60 km/h.

    It is no harder than `hardest_release_g` of the speed at which it is released, and not released
    at 16 km/h, where the encoder's scale decides whether what follows is slow.
    """
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
    """Return a speed that an encoder measures on the correct side of 16 km/h."""
    return 17.0 if speed_kmh == 16.0 else speed_kmh


def _near_stop(draw: "DrawFn") -> Scenario:
    """Return a brake of 0.1 to 0.25 g to a crawl of 11 to 15 km/h for 0.5 to 2 s."""
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
    """Return one to three stops of 0.5 to 120 s, `STOPS_APART_M` apart, at 0.1 to 0.3 g."""
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
    """Return a start from rest after 1 to 60 s, up to 30 to 72 km/h."""
    return Scenario(
        manoeuvre="dead-start",
        dwell_s=draw(number(1.0, 60.0, 1.0, 5.0)),
        final_speed_kmh=draw(number(30.0, 72.0, 1.0, 58.0)),
        **EVENT.draw(draw),
    )


_DRIVES: Mapping[str, Callable[["DrawFn"], Scenario]] = {
    "constant-speed": _constant,
    "low-speed": _slow,
    "coasting": _coasting,
    "throttle": _throttle,
    "braking": _braking,
    "near-stop": _near_stop,
    "stop": _stop,
    "dead-start": _dead_start,
}
