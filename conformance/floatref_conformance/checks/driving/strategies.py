"""Hypothesis strategies of the drives of each check; they shrink to the defaults.

Numbers are rounded, so that a case is easy to read. Hypothesis is imported when a strategy is
requested.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import ceil, floor, inf
from typing import TYPE_CHECKING, Any

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.checks.driving.layout import least_spacing_m, place
from floatref_conformance.editions.drawn import STEP_M_PER_KM, Drawn
from floatref_conformance.editions.edition import Edition, Table
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

INTERVALS_M = (0.00508, 0.01, 0.025)
STOPS_APART_M = 120.0
"""Smallest distance of stops in m: the filter spreads an error over a cut-off wavelength."""
GRADE_PERCENT, CROSS_SLOPE_PERCENT, CURVATURE_PER_KM = 4.0, 3.0, 1.0
"""Steepest slopes, up or down and to either side, and the sharpest curve to either side."""


@dataclass(frozen=True)
class Draws:
    """Draws the numbers of one drive of an edition.

    Attributes:
        edition: names the roads, the vehicles and the shapes of the road.
        draw: of Hypothesis.
    """

    edition: Edition
    draw: "DrawFn"

    def make(self, surroundings: str, **numbers: Any) -> Scenario:
        """Return a drive of ``numbers`` with the ``surroundings`` of this name."""
        found = {**numbers, **self._surround(self.edition.document["surroundings"][surroundings])}
        drawn = {name: self.draw(each.strategy()) for name, each in self.edition.drawn.items()}
        return self.edition.make_scenario(**found, **drawn, **self._shape())

    def number(self, low: float, high: float, step: float, simplest: float = 0.0) -> float:
        """Return a number from ``low`` to ``high``."""
        return self.draw(number(low, high, step, simplest))

    def _surround(self, table: Table) -> dict[str, Any]:
        """Return road, vehicle, slopes and rates of a table of the edition."""
        from hypothesis import strategies as st

        draw, roads = self.draw, self.edition.roads[table["roads"]]
        return {
            "seed": draw(st.integers(0, 2**32 - 1)),
            "road": draw(st.sampled_from(roads.kinds)),
            "iri_m_per_km": self.number(roads.smoothest, roads.roughest, STEP_M_PER_KM, 1.8),
            "vehicle": draw(st.sampled_from(tuple(table["vehicles"]))),
            "grade_percent": self.number(-GRADE_PERCENT, GRADE_PERCENT, 0.5),
            "cross_slope_percent": self.number(-CROSS_SLOPE_PERCENT, CROSS_SLOPE_PERCENT, 0.5),
            "curvature_per_km": self.number(-CURVATURE_PER_KM, CURVATURE_PER_KM, 0.2),
            "rate_hz": draw(st.sampled_from(tuple(table["rates_hz"]))),
            "profile_interval_m": draw(st.sampled_from(INTERVALS_M)),
        }

    def _shape(self) -> dict[str, float]:
        """Return the numbers of a crown, a dip or a break of grade, or no numbers."""
        from hypothesis import strategies as st

        shapes = self.edition.document["shapes"]
        if not shapes:
            return {}
        chosen = shapes.get(self.draw(st.sampled_from(("", *shapes))), {})
        return {name: self.draw(Drawn(**ends).strategy()) for name, ends in chosen.items()}


def number(low: float, high: float, step: float, simplest: float = 0.0) -> "SearchStrategy[float]":
    """Return numbers from ``low`` to ``high`` in whole steps of ``step`` from the simplest."""
    return Drawn(low, high, step, simplest).strategy()


def hardest_release_g(speed_kmh: float, soonest_stand_s: float) -> float:
    """Return the hardest brake in g for a release at ``speed_kmh``.

    At that deceleration the vehicle would stand ``soonest_stand_s`` later; infinite for 0.
    """
    if soonest_stand_s == 0:
        return inf
    return floor(100 * speed_kmh * KMH / STANDARD_GRAVITY / soonest_stand_s) / 100


def drives(check: str, edition: Edition) -> "SearchStrategy[Scenario]":
    """Return the strategy of all drives of the driving check with id ``check``."""
    from hypothesis import strategies as st

    @st.composite
    def scenarios(draw: "DrawFn") -> Scenario:
        return place(_DRIVES[check](Draws(edition, draw)), edition)

    return scenarios()


def _constant(draws: Draws) -> Scenario:
    """Return a drive at 16.1 to 97 km/h."""
    return draws.make("steady", speed_kmh=draws.number(16.1, 97.0, 0.1, 72.0))


def _slow(draws: Draws) -> Scenario:
    """Return a drive at 4 to 15.9 km/h, constant or wandering between two such speeds.

    It takes long, and has one wheel path.
    """
    from hypothesis import strategies as st

    wandering = draws.draw(st.booleans())
    speed = draws.number(4.0, 12.0 if wandering else 15.9, 0.1, 12.0)
    drive = draws.make("creep", speed_kmh=speed, tracks=("left",))
    if not wandering:
        return drive
    fastest = draws.number(speed + 0.5, 15.9, 0.1, 15.0)
    return replace(drive, manoeuvre="creeping", event_speed_kmh=fastest)


def _coasting(draws: Draws) -> Scenario:
    """Return a drive that rolls from 30 to 97 km/h down by 5 km/h or more, at 0.02 to 0.05 g."""
    speed = draws.number(30.0, 97.0, 1.0, 72.0)
    return draws.make(
        "steady",
        manoeuvre="coasting",
        speed_kmh=speed,
        final_speed_kmh=draws.number(20.0, speed - 5.0, 1.0, 58.0),
        deceleration_g=draws.number(0.02, 0.05, 0.005, 0.04),
    )


def _throttle(draws: Draws) -> Scenario:
    """Return a drive that speeds up from 20 to 70 km/h by 5 km/h or more, at 0.05 to 0.25 g."""
    speed = draws.number(20.0, 70.0, 1.0, 32.0)
    return draws.make(
        "steady",
        manoeuvre="throttle",
        speed_kmh=speed,
        final_speed_kmh=draws.number(speed + 5.0, 97.0, 1.0, 72.0),
        deceleration_g=draws.number(0.05, 0.25, 0.01, 0.15),
    )


def _braking(draws: Draws) -> Scenario:
    """Return a brake of 0.05 to 0.84 g from 30 to 100 km/h down to 15 to 60 km/h.

    It is no harder than `hardest_release_g` of the speed at which it is released, and not released
    at 16 km/h, where the encoder's scale decides whether what follows is slow.
    """
    speed = draws.number(30.0, 100.0, 1.0, 72.0)
    released = draws.draw(number(15.0, min(60.0, speed - 5.0), 1.0, 30.0).map(_off_16))
    soonest_s = draws.edition.document["drives"]["soonest_stand_s"]
    hardest = min(0.84, hardest_release_g(released, soonest_s))
    return draws.make(
        "event",
        manoeuvre="braking",
        speed_kmh=speed,
        event_speed_kmh=released,
        deceleration_g=draws.number(0.05, hardest, 0.01, 0.2),
    )


def _off_16(speed_kmh: float) -> float:
    """Return a speed that an encoder measures on the correct side of 16 km/h."""
    return 17.0 if speed_kmh == 16.0 else speed_kmh


def _near_stop(draws: Draws) -> Scenario:
    """Return a brake of 0.1 to 0.25 g to a crawl of 11 to 15 km/h for 0.5 s or more."""
    longest_s = draws.edition.document["drives"]["longest_crawl_s"]
    return draws.make(
        "crawl",
        manoeuvre="near-stop",
        speed_kmh=draws.number(40.0, 90.0, 1.0, 72.0),
        event_speed_kmh=draws.number(11.0, 15.0, 0.5, 11.0),
        deceleration_g=draws.number(0.1, 0.25, 0.01, 0.2),
        dwell_s=draws.number(0.5, longest_s, 0.5, 2.0),
        final_speed_kmh=draws.number(30.0, 72.0, 1.0, 58.0),
    )


def _stop(draws: Draws) -> Scenario:
    """Return one to three stops of 0.5 to 120 s, `STOPS_APART_M` apart, at 0.1 to 0.3 g."""
    from hypothesis import strategies as st

    once = draws.make(
        "stand",
        manoeuvre="stop",
        speed_kmh=draws.number(30.0, 90.0, 1.0, 72.0),
        deceleration_g=draws.number(0.1, 0.3, 0.01, 0.2),
        dwell_s=draws.draw(number(0.5, 20.0, 0.5, 5.0) | number(20.0, 120.0, 10.0, 20.0)),
        final_speed_kmh=draws.number(30.0, 58.0, 1.0, 58.0),
    )
    stops = draws.draw(st.integers(1, 3))
    if stops == 1:
        return once
    least = max(STOPS_APART_M, float(ceil(least_spacing_m(once))))
    spacing = least + draws.number(0.0, 100.0, 10.0)
    return replace(once, stops=stops, stop_spacing_m=spacing)


def _dead_start(draws: Draws) -> Scenario:
    """Return a start from rest after 1 to 60 s, up to 30 to 72 km/h."""
    return draws.make(
        "event",
        manoeuvre="dead-start",
        dwell_s=draws.number(1.0, 60.0, 1.0, 5.0),
        final_speed_kmh=draws.number(30.0, 72.0, 1.0, 58.0),
    )


_DRIVES: Mapping[str, Callable[[Draws], Scenario]] = {
    "constant-speed": _constant,
    "low-speed": _slow,
    "coasting": _coasting,
    "throttle": _throttle,
    "braking": _braking,
    "near-stop": _near_stop,
    "stop": _stop,
    "dead-start": _dead_start,
}
