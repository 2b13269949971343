"""The places of a driving check's manoeuvre on the road, and the stretches that it scores.

Every scored point is a cut-off wavelength or more from both ends of the run, where a high-pass
filter may leave points without elevation.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import ceil
from typing import Any

from floatref.errors import InputError
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.checks.driving.bump import BESIDE_M
from floatref_conformance.checks.flags import SLOW_MPS
from floatref_conformance.checks.stretches import END_M, Stretches
from floatref_conformance.editions.edition import Edition
from floatref_conformance.proving_ground.drives.drive import Segment
from floatref_conformance.proving_ground.drives.manoeuvres import RESTART, SLOW_COAST_DRAG
from floatref_conformance.proving_ground.drives.phases import (
    brake,
    brake_to_stop,
    extent,
    set_off,
    speed_change,
)
from floatref_conformance.proving_ground.drives.runs import KMH, RUNS
from floatref_conformance.proving_ground.scenario import STATIONARY, Scenario
from floatref_conformance.proving_ground.staging import BUMP_LENGTH_M

STRETCH_M = 160.9
"""Length of road of one IRI value, in m: 0.1 mile."""
AHEAD_M = 96.0
"""Distance in m from the begin of a stretch to its event, as on the section with stops at 216 m."""
BUMP_MM = 20.0
BUMP_REACH_M = BUMP_LENGTH_M / 2 + BESIDE_M
"""Length in m on each side of the bump's middle that is fitted."""
BUMP_AT_M = 115.0
"""Place of the known bump's middle in m, where the speed is still constant."""
EVENT_M = 316.0
"""Place of the first event in m, unless the brake before it is too long."""
CALM_M = 10.0
"""Distance in m between the bump's stretch and the start of a brake."""
STEADY_M = {"constant": 220.0, "creeping": 130.0, "dead-start": 110.0}
"""Begin in m of the stretch of a drive without an event."""
SLOW_START_M = 130.0
"""The same for drives below 16 km/h, which take long."""
ABRUPT = ("braking", "near-stop", "stop")
"""The manoeuvres with a brake ahead of their event."""
RUN_OUT_M = 119.1
"""Length in m of the drive after the scored stretch, as in the published runs."""
GRADE_RUN_OUT_M = 350.0
"""The same where the road's grade changes. The run-in of the high-pass, from the end backward,
begins with the error of a grade that has just begun, 0.6 m at 6 %, and falls to a tenth within 66 m
(-3 dB at 91.44 m): 10 mm is left after 119 m, 0.01 mm after 350 m."""


@dataclass(frozen=True)
class Layout:
    """The scored stretches and the events of a drive, in m of true distance.

    Attributes:
        events_m: places of events, around which points may be flagged.
        stretches: start and end of each stretch over which every point counts.
    """

    events_m: tuple[float, ...]
    stretches: Stretches


def layout_of(scenario: Scenario) -> Layout:
    """Return the layout of ``scenario``.

    Raises InputError for a manoeuvre of another kind, and if a stretch or the bump comes within
    `END_M` of an end of the run.
    """
    if scenario.manoeuvre in (*STATIONARY, *RUNS):
        raise InputError(f"manoeuvre {scenario.manoeuvre}: not one that a driving check scores")
    events = _events(scenario)
    around = [event - AHEAD_M for event in (*events, *_extra_scored(scenario))]
    starts = around or [_steady_start(scenario)]
    layout = Layout(events, tuple((start, start + STRETCH_M) for start in starts))
    scored = [place for stretch in layout.stretches for place in stretch]
    if scenario.bump_mm:
        scored += [scenario.bump_at_m - BUMP_REACH_M, scenario.bump_at_m + BUMP_REACH_M]
    if min(scored) < END_M or max(scored) > scenario.length_m - END_M:
        raise InputError(
            f"the drive of {scenario.length_m:g} m is scored from {min(scored):g} m to "
            f"{max(scored):g} m, which must lie {END_M:g} m from its ends"
        )
    return layout


def place(scenario: Scenario, edition: Edition) -> Scenario:
    """Return ``scenario`` with bump, event and length such that all scored points fit.

    A crown or a break of grade lies at the event, else in the middle of the scored stretch; so
    does the bump of a drive with an event, if the ``edition`` says so.
    """
    clear = BUMP_AT_M + BUMP_REACH_M + CALM_M
    event = max(EVENT_M, ceil(clear + brake_length_m(scenario)))
    there = replace(scenario, bump_mm=BUMP_MM, bump_at_m=BUMP_AT_M, event_at_m=event)
    if scenario.manoeuvre == "dead-start":
        there = replace(there, event_at_m=EVENT_M, bump_at_m=_steady_start(there) + 175.0)
    elif scenario.manoeuvre in ABRUPT and edition.document["drives"]["bump_at_event"]:
        there = replace(there, bump_at_m=event)
    ends = [*_events(there), *_extra_scored(there)] or [_steady_start(there) + AHEAD_M]
    scored = max(*ends, there.bump_at_m) - AHEAD_M + STRETCH_M
    driven = max(_events(there), default=0.0) + speed_change_after_m(there)
    run_out = GRADE_RUN_OUT_M if scenario.break_percent else RUN_OUT_M
    there = replace(there, length_m=float(ceil(max(scored + run_out, driven + 1.0))))
    return _shape(there, float(ends[0]))


def _shape(s: Scenario, middle_m: float) -> Scenario:
    """Return ``s`` with its crown and its break of grade, if it has them, at ``middle_m``."""
    at_m: dict[str, Any] = {
        **({"crown_at_m": middle_m} if s.crown_mm else {}),
        **({"break_at_m": middle_m} if s.break_percent else {}),
    }
    return replace(s, **at_m) if at_m else s


def brake_length_m(s: Scenario) -> float:
    """Return the length in m of the brake ahead of the scenario's event."""
    speed, deceleration = s.speed_kmh * KMH, s.deceleration_g * STANDARD_GRAVITY
    if s.manoeuvre == "stop":
        return extent(speed, brake_to_stop(speed, deceleration))[0]
    if s.manoeuvre in ("braking", "near-stop"):
        return extent(speed, brake(speed, s.event_speed_kmh * KMH, deceleration))[0]
    return 0.0


def least_spacing_m(s: Scenario) -> float:
    """Return the smallest possible distance between stops, in m."""
    speed, deceleration = s.final_speed_kmh * KMH, s.deceleration_g * STANDARD_GRAVITY
    return _set_off_m(s) + extent(speed, brake_to_stop(speed, deceleration))[0]


def speed_change_after_m(s: Scenario) -> float:
    """Return the length in m of the change of speed after the last event."""
    length = _DRIVEN_ON.get(s.manoeuvre)
    return length(s) if length else 0.0


def _speed_changed_m(s: Scenario) -> float:
    speeds = s.speed_kmh * KMH, s.final_speed_kmh * KMH
    return extent(speeds[0], speed_change(*speeds, s.deceleration_g * STANDARD_GRAVITY))[0]


def _set_off_m(s: Scenario) -> float:
    return extent(0.0, set_off(0.0, s.final_speed_kmh * KMH, RESTART))[0]


def _crawled_m(s: Scenario) -> float:
    coast = Segment(s.dwell_s, -SLOW_COAST_DRAG)
    distance, slowest = extent(s.event_speed_kmh * KMH, (coast,))
    return distance + extent(slowest, set_off(slowest, s.final_speed_kmh * KMH, RESTART))[0]


_DRIVEN_ON: Mapping[str, Callable[[Scenario], float]] = {
    "coasting": _speed_changed_m,
    "throttle": _speed_changed_m,
    "near-stop": _crawled_m,
    "stop": _set_off_m,
    "dead-start": _set_off_m,
}


def _events(s: Scenario) -> tuple[float, ...]:
    if s.manoeuvre in STEADY_M:
        return ()
    count = s.stops if s.manoeuvre == "stop" else 1
    return tuple(s.event_at_m + n * s.stop_spacing_m for n in range(count))


def _extra_scored(s: Scenario) -> tuple[float, ...]:
    """Return the end of a slow change of speed, which is scored too."""
    if s.manoeuvre in ("coasting", "throttle"):
        return (s.event_at_m + speed_change_after_m(s),)
    return ()


def _steady_start(s: Scenario) -> float:
    slow = s.manoeuvre == "constant" and s.speed_kmh * KMH < SLOW_MPS
    return SLOW_START_M if slow else STEADY_M[s.manoeuvre]
