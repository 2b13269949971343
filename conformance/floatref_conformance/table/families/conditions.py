"""The conditions of each family: what is drawn for a drive, and between which values.

Family `single` changes one thing at a time in one neutral stop, so that one sees what breaks a
pipeline. The others draw everything together, as streets, roads and profilers have it.

Figures of roads are the geometry of streets: crowns of 25 to 100 mm over 10 to 20 m, humps of 75 to
150 mm over 4 to 10 m, dips and gutters likewise below, grades that change by 1 to 6 % within 20 to
60 m; joints and patches give the slope a kurtosis in the hundreds, as nine runs on a concrete
motorway have it. Slip: 3 to 12 % per g (Karamihas 2021, 3.3.1.3, 3.3.9); rolling radius: up to 1 %
over 16 to 97 km/h (3.3.1.1); laser: up to 0.3 m from its accelerometer, by default 0.105 m (4.2.1);
its line 100 mm (4.3). Latency up to 3 ms, friction of 1000 to 2500 N·m about pitch, and progressive
springs of 10 to 100 1/m² are ranges of ours.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from floatref_conformance.proving_ground.vehicles.parameter_sets import VEHICLES

Numbers = dict[str, Any]
Draw = Callable[[np.random.Generator], Numbers]
"""Draws the numbers of one drive."""
ROADS = ("sayers-normal", "measured", "sayers-asphalt-long-waves", "sayers-rough", "iso-B")


@dataclass(frozen=True, eq=False)
class Condition:
    """What the drives of one column of the table have in common.

    Attributes:
        family: of the condition.
        name: unique within the family.
        fixed: numbers that all its drives have.
        draws: what draws the others, in order.
        beside_m: distance of the road's shape from the event, in m.
    """

    family: str
    name: str
    fixed: Mapping[str, Any] = field(default_factory=dict)
    draws: tuple[Draw, ...] = ()
    beside_m: float = 0.0

    @property
    def full_name(self) -> str:
        """Family and name."""
        return f"{self.family}: {self.name}"

    def numbers(self, source: np.random.Generator) -> Numbers:
        """Return the numbers of one drive that ``source`` draws."""
        found: Numbers = {}
        for draw in self.draws:
            found |= draw(source)
        return found | dict(self.fixed)


def number(low: float, high: float, digits: int = 1) -> Callable[[np.random.Generator], float]:
    """Return what draws numbers between two ends, rounded to be read."""
    return lambda source: round(float(source.uniform(low, high)), digits)


def numbers(**ranges: tuple[float, float] | tuple[float, float, int]) -> Draw:
    """Return what draws each number between its ends."""
    drawn = {name: number(*ends) for name, ends in ranges.items()}
    return lambda source: {name: one(source) for name, one in drawn.items()}


def one_of(*draws: Draw) -> Draw:
    """Return what draws by one of ``draws``."""
    return lambda source: draws[int(source.integers(len(draws)))](source)


def turned(draw: Draw, name: str) -> Draw:
    """Return ``draw`` with its number ``name`` below zero."""
    return lambda source: {key: -v if key == name else v for key, v in draw(source).items()}


def surroundings(source: np.random.Generator) -> Numbers:
    """Return a road, its roughness and a vehicle."""
    return {
        "road": str(source.choice(ROADS)),
        "iri_m_per_km": round(float(source.uniform(0.8, 4.0)), 1),
        "vehicle": str(source.choice(tuple(VEHICLES))),
    }


CROWN = numbers(crown_mm=(25, 100, 0), crown_length_m=(10, 20))
HUMP = numbers(crown_mm=(75, 150, 0), crown_length_m=(4, 10))
DIP, GUTTER = turned(CROWN, "crown_mm"), turned(HUMP, "crown_mm")
RISE = numbers(break_percent=(1, 6), break_length_m=(20, 60))
BREAK = one_of(RISE, turned(RISE, "break_percent"))
SHAPE = one_of(CROWN, HUMP, DIP, GUTTER, BREAK)
CONCRETE = numbers(joint_mm=(2, 6), patch_mm=(5, 20), patches_per_km=(10, 40, 0))
SENSORS = numbers(
    slip_percent_per_g=(3, 12),
    radius_percent=(0, 1, 2),
    warming_percent=(0, 1, 2),
    laser_ahead_m=(-0.3, 0.3, 3),
    latency_ms=(0, 3),
)
SPRINGS = numbers(friction_nm=(1000, 2500, 0), progression_per_m2=(10, 100, 0))
WANDER = numbers(wander_m=(0.05, 0.3, 2), wander_within_m=(0.01, 0.05, 2))
EVERYTHING = (surroundings, SENSORS)
STOP = numbers(
    speed_kmh=(30, 80), deceleration_g=(0.1, 0.35, 2), dwell_s=(0.5, 60), final_speed_kmh=(30, 58)
)
NEAR_STOP = numbers(
    speed_kmh=(40, 80),
    event_speed_kmh=(8, 15),
    deceleration_g=(0.1, 0.25, 2),
    dwell_s=(0.5, 3),
    final_speed_kmh=(30, 58),
)
SINGLE_FAMILY = "single"
NEUTRAL: Mapping[str, Any] = {
    "manoeuvre": "stop",
    "speed_kmh": 72.0,
    "deceleration_g": 0.2,
    "dwell_s": 5.8,
    "final_speed_kmh": 58.0,
    "iri_m_per_km": 1.8,
    "slip_percent_per_g": 0.0,
    "laser_ahead_m": 0.0,
}
"""A stop of print on a plain road, with an encoder that rolls and a laser in its place."""
SINGLE: Mapping[str, Mapping[str, Any]] = {
    "plain stop": {},
    "crown 50 mm": {"crown_mm": 50.0},
    "crown 100 mm": {"crown_mm": 100.0},
    "hump 150 mm": {"crown_mm": 150.0, "crown_length_m": 10.0},
    "dip 60 mm": {"crown_mm": -60.0, "crown_length_m": 10.0},
    "break 2 %": {"break_percent": 2.0},
    "break 4 %": {"break_percent": 4.0},
    "concrete": {"joint_mm": 4.0, "patch_mm": 10.0, "patches_per_km": 30.0},
    "slip 2.5 %/g": {"slip_percent_per_g": 2.5},
    "slip 12 %/g": {"slip_percent_per_g": 12.0},
    "radius 1 %": {"radius_percent": 1.0},
    "laser 0.105 m": {"laser_ahead_m": 0.105},
    "laser 0.3 m": {"laser_ahead_m": 0.3},
    "line laser": {"laser_line_mm": 100.0},
    "latency 3 ms": {"latency_ms": 3.0},
    "friction": {"friction_nm": 2000.0},
    "springs": {"progression_per_m2": 50.0},
    "wander": {"wander_m": 0.2, "wander_within_m": 0.03},
}
"""What each column of `single` changes in `NEUTRAL`."""


def _make(family: str, name: str, kind: str, *draws: Draw, **fixed: Any) -> Condition:
    return Condition(family, name, {"manoeuvre": kind, **fixed}, (*EVERYTHING, *draws))


CONDITIONS: tuple[Condition, ...] = (
    *(Condition(SINGLE_FAMILY, name, {**NEUTRAL, **change}) for name, change in SINGLE.items()),
    _make("urban", "stop", "stop", STOP),
    _make("urban", "stop, crown", "stop", STOP, CROWN),
    _make("urban", "stop, hump", "stop", STOP, HUMP),
    _make("urban", "stop, dip", "stop", STOP, one_of(DIP, GUTTER)),
    _make("urban", "stop, break", "stop", STOP, BREAK),
    Condition("urban", "stop, 40 m off", {"manoeuvre": "stop"}, (*EVERYTHING, STOP, SHAPE), 40.0),
    _make("urban", "near stop", "near-stop", NEAR_STOP, SHAPE),
    _make("rural", "constant", "constant", numbers(speed_kmh=(20, 97))),
    _make("rural", "constant, shape", "constant", numbers(speed_kmh=(20, 97)), SHAPE),
    _make("rural", "constant, concrete", "constant", numbers(speed_kmh=(40, 97)), CONCRETE),
    _make(
        "rural", "curve, grade", "constant", numbers(speed_kmh=(30, 80), grade_percent=(-6, 6)),
        numbers(curvature_per_km=(-5, 5), cross_slope_percent=(-4, 4)),
    ),
    _make(
        "rural", "coast", "coasting", numbers(speed_kmh=(60, 97), final_speed_kmh=(30, 55)),
        deceleration_g=0.04,
    ),
    _make(
        "rural", "throttle", "throttle", numbers(speed_kmh=(25, 50), final_speed_kmh=(55, 90)),
        numbers(deceleration_g=(0.08, 0.2, 2)),
    ),
    _make(
        "rural", "light brake", "braking", numbers(speed_kmh=(60, 97), event_speed_kmh=(20, 50)),
        numbers(deceleration_g=(0.05, 0.16, 2)), SHAPE,
    ),
    _make(
        "harsh", "hard brake", "braking", numbers(speed_kmh=(50, 100), event_speed_kmh=(15, 40)),
        numbers(deceleration_g=(0.3, 0.84, 2)), SHAPE,
    ),
    _make("harsh", "three stops", "stop", STOP, SHAPE, stops=3),
    _make("harsh", "stop, concrete", "stop", STOP, CONCRETE),
    _make("harsh", "stop, leaf springs", "stop", STOP, SPRINGS),
    _make("harsh", "stop, line laser", "stop", STOP, SHAPE, laser_line_mm=100.0, laser_ahead_m=0.0),
    _make("harsh", "stop, everything", "stop", STOP, SHAPE, CONCRETE, SPRINGS, WANDER),
)  # fmt: skip
"""All conditions, family by family, in the order of the table."""
FAMILIES = tuple(dict.fromkeys(condition.family for condition in CONDITIONS))
STOPS_FAMILY = "stops"
"""Family of its own, not of the map of all pipelines: many stops for few pipelines."""
USUAL_STOP = numbers(
    speed_kmh=(30, 80), deceleration_g=(0.1, 0.35, 2), dwell_s=(1, 60), final_speed_kmh=(30, 58)
)
GENTLE = numbers(break_percent=(1, 4), break_length_m=(20, 60))
STEEP = numbers(break_percent=(6, 6), break_length_m=(20, 60))


def _stop_on(name: str, *shapes: Draw) -> Condition:
    """Return stops of every vehicle on one shape, or its mirror image, with the usual sensors."""
    shape = (one_of(*shapes),) if shapes else ()
    return Condition(STOPS_FAMILY, name, {"manoeuvre": "stop"}, (surroundings, USUAL_STOP, *shape))


STOPS: tuple[Condition, ...] = (
    _stop_on("plain"),
    _stop_on("crown, dip", CROWN, DIP),
    _stop_on("hump, gutter", HUMP, GUTTER),
    _stop_on("break of 1 to 4 %", GENTLE, turned(GENTLE, "break_percent")),
    _stop_on("break of 6 %", STEEP, turned(STEEP, "break_percent")),
)
"""Stops of 1 to 60 s where streets have them: what is asked of the road prior."""
