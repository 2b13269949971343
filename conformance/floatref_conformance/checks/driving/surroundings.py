"""What a searched drive happens on and in, drawn by Hypothesis; imported when it is asked for."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, floor
from typing import TYPE_CHECKING, Any

from floatref_conformance.checks.driving.roads import EVERYDAY, LEVEL, STEP_M_PER_KM, WORN, Roads

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

INTERVALS_M = (0.00508, 0.01, 0.025)


@dataclass(frozen=True)
class Surroundings:
    """What a drive may happen on and in.

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


STEADY = Surroundings(EVERYDAY, ("loaded-van", "minivan", "pickup", "trailer", "soft-van"))
"""Drives whose speed changes little or slowly."""
CREEP = replace(STEADY, rates_hz=(8000.0, 4000.0))
"""Drives that take so long that 16 kHz would be too many samples."""
EVENT = Surroundings(WORN, ("loaded-van", "minivan", "pickup", "trailer"))
"""Brakes: not in the van whose dampers are worn."""
STAND = replace(EVENT, roads=LEVEL)
"""Stops."""
CRAWL = Surroundings(LEVEL, ("loaded-van", "minivan", "trailer"))
"""Near stops: the profiler sits less than 3 m from the middle of the vehicle."""


def number(low: float, high: float, step: float, simplest: float = 0.0) -> "SearchStrategy[float]":
    """Return numbers from ``low`` to ``high`` a whole count of ``step`` from the simplest."""
    from hypothesis import strategies as st

    base = min(max(simplest, low), high)
    counts = st.integers(ceil((low - base) / step - 1e-9), floor((high - base) / step + 1e-9))
    return counts.map(lambda count: round(base + count * step, 6))
