"""The drives whose recordings `invariance` changes: fixed by the edition, or drawn."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.checks.case import Case, Number
from floatref_conformance.checks.rounded import rounded_numbers, seed_of_its_own, seeds
from floatref_conformance.checks.sameness.change import number
from floatref_conformance.checks.sameness.changes import (
    AUGMENTED_CHANGES,
    CHANGES,
    SLOPE,
    UNIT_BIAS,
)
from floatref_conformance.classes import Effort
from floatref_conformance.editions.edition import Edition
from floatref_conformance.proving_ground.drives.phases import brake_to_stop, extent
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

CHECK = "invariance"
STOP = "longer-stop"
FREE_M, STOP_M = 200.0, 316.0
"""Smallest distances in m of the begin of a brake and of its stop: the adaptive cut-off of
section 5.7 needs about 20 s to settle."""
BEFORE_M, BEHIND_M = 96.0, 64.9
"""Lengths in m before and behind a stop: 160.9 m in total."""
END_M = 110.0
"""Length in m of the recording after the scored stretch."""
LENGTH_M = 500.0
ROUNDS: tuple[Mapping[str, Any], ...] = (
    {"speed_kmh": 65.0, "rate_hz": 8000.0, "iri_m_per_km": 1.4},
    {"speed_kmh": 93.0, "rate_hz": 4000.0, "iri_m_per_km": 1.5, "vehicle": "pickup"},
    {"speed_kmh": 41.0, "rate_hz": 16000.0, "iri_m_per_km": 1.1, "vehicle": "minivan"},
)
"""Drives of the seeded cases; the first is that of a quick run."""
STOPS: tuple[Mapping[str, Any], ...] = (
    {"speed_kmh": 60.0, "rate_hz": 4000.0, "dwell_s": 5.0, "deceleration_g": 0.2},
    {"speed_kmh": 45.0, "rate_hz": 4000.0, "dwell_s": 30.0, "deceleration_g": 0.1},
    {"speed_kmh": 75.0, "rate_hz": 8000.0, "dwell_s": 0.5, "deceleration_g": 0.3},
)
"""Drives of the seeded cases with a stop."""
THROTTLES: tuple[Mapping[str, Any], ...] = tuple(
    {"manoeuvre": "throttle", "event_at_m": 190.0, "final_speed_kmh": 70.0, **numbers}
    for numbers in (
        {"speed_kmh": 45.0, "rate_hz": 4000.0, "deceleration_g": 0.2},
        {"speed_kmh": 32.0, "rate_hz": 8000.0, "deceleration_g": 0.15, "vehicle": "minivan"},
        {"speed_kmh": 50.0, "rate_hz": 4000.0, "deceleration_g": 0.18, "vehicle": "pickup"},
    )
)
"""Drives of the seeded cases in which the body pitches and the speed changes."""
UNSTEADY: Mapping[str, tuple[Mapping[str, Any], ...]] = MappingProxyType(
    {STOP: STOPS, SLOPE: THROTTLES, UNIT_BIAS: THROTTLES}
)
NUMBERS: Mapping[str, tuple[Mapping[str, Number], ...]] = MappingProxyType(
    {
        "later-start": ({"samples": 6007}, {"samples": 1}, {"samples": 4096}),
        "clock-storage": ({}, {}, {}),
        "accelerometer-bias": ({"bias": 0.03}, {"bias": -0.03}, {"bias": 0.012}),
        "clock-origin": ({"shift_s": 1e5}, {"shift_s": -86400.0}, {"shift_s": 0.1}),
        "distance-origin": ({"shift_m": 98765.43}, {"shift_m": -300.0}, {"shift_m": 1234.5}),
        "road-height": ({"factor": 2.5}, {"factor": 0.4}, {"factor": 1.5}),
        "sample-rate": ({"rate_hz": 4000.0}, {"rate_hz": 16000.0}, {"rate_hz": 5000.0}),
        STOP: ({}, {}, {}),
        "gnss-datum": ({"shift_m": 100.0}, {"shift_m": -100.0}, {"shift_m": 2500.0}),
        "gnss-rate": ({"every": 2}, {"every": 4}, {"every": 2}),
        "gyro-rate": ({"gyro_rate_hz": 200.0}, {"gyro_rate_hz": 400.0}, {"gyro_rate_hz": 160.0}),
        UNIT_BIAS: (
            {"bias": 0.03, "rate_bias": 0.0005},
            {"bias": -0.03, "rate_bias": -0.0005},
            {"bias": 0.015, "rate_bias": 0.0002},
        ),
        SLOPE: (
            {"grade_percent": 2.0, "cross_slope_percent": -2.0},
            {"grade_percent": -2.0, "cross_slope_percent": 1.5},
            {"grade_percent": 1.5, "cross_slope_percent": 2.0},
        ),
    }
)
"""For each change, the numbers of the seeded cases in turn."""
RATES_HZ = (16000.0, 8000.0, 5000.0, 4000.0, 2000.0)
ROADS = ("sayers-normal", "sayers-asphalt-long-waves", "measured")
VEHICLES = ("loaded-van", "minivan", "pickup", "trailer")
LATEST_S = 1.4
"""Largest delay of a recording's begin in s: 38 m at 97 km/h."""


def seeded_cases(seed: int, effort: Effort, edition: Edition) -> tuple[Case, ...]:
    """Return every change once, in a certification three times, each on another road."""
    rounds = range(1 if effort is Effort.QUICK else len(ROUNDS))
    source = np.random.SeedSequence([seed, *CHECK.encode()])
    roads = iter(source.generate_state(len(rounds) * len(CHANGES)).tolist())
    # Nominal changes come first: their roads are the same for every device.
    nominal = [change for change in CHANGES if change not in AUGMENTED_CHANGES]
    return tuple(
        Case(
            CHECK,
            drive(change, next(roads), edition, **UNSTEADY.get(change, ROUNDS)[n]),
            {"change": change, **NUMBERS[change][n]},
            f"{CHECK}-{change}-{n + 1}",
        )
        for changes in (nominal, AUGMENTED_CHANGES)
        for n in rounds
        for change in changes
    )


def drive(change: str, seed: int, edition: Edition, **numbers: Any) -> Scenario:
    """Return a drive of one wheel path for ``change``, long enough for the scored stretch."""
    fields: dict[str, Any] = {"length_m": LENGTH_M, "tracks": ("left",), **numbers}
    if change == "road-height":
        fields["sensors"] = 0.0
    if change == STOP:
        speed, deceleration = fields["speed_kmh"] * KMH, fields["deceleration_g"]
        brake_m, _ = extent(speed, brake_to_stop(speed, deceleration * STANDARD_GRAVITY))
        fields["manoeuvre"] = "stop"
        fields["event_at_m"] = max(STOP_M, float(np.ceil(FREE_M + brake_m)))
        fields["length_m"] = float(np.ceil(fields["event_at_m"] + BEHIND_M + END_M))
    return edition.make_scenario(**edition.without_slip, seed=seed, **fields)


def later_m(scenario: Scenario, numbers: Mapping[str, Number]) -> float:
    """Return the distance in m that is driven before a delayed recording begins.

    Raises InputError for numbers without a valid count of samples.
    """
    begin_s = number(numbers, "samples") / scenario.rate_hz
    return float(drive_of(scenario).motion(np.array([begin_s])).distance[0])


def case_strategy(
    edition: Edition, changes: Sequence[str] = tuple(CHANGES)
) -> "SearchStrategy[Case]":
    """Return the strategy of any of ``changes`` of any drive."""
    from hypothesis import strategies as st

    @st.composite
    def case(draw: "DrawFn") -> Case:
        change = draw(st.sampled_from(changes))
        numbers = draw(_DRAWN.get(change, _travel)())
        variation = draw(_numbers(change, numbers["rate_hz"]))
        variation = {"change": change, **variation}
        seed = seed_of_its_own(draw(seeds()), numbers, variation)
        return Case(CHECK, drive(change, seed, edition, **numbers), variation)

    return case()


def _travel() -> "SearchStrategy[dict[str, Any]]":
    """Return a strategy of drives at constant speed or under throttle."""
    from hypothesis import strategies as st

    throttle = {
        "manoeuvre": st.just("throttle"),
        "speed_kmh": rounded_numbers(30.0, 60.0),
        "final_speed_kmh": rounded_numbers(62.0, 72.0),
        "deceleration_g": rounded_numbers(0.15, 0.2, 2),
        "event_at_m": rounded_numbers(180.0, 240.0, 0),
    }
    return _steady() | st.fixed_dictionaries({**_common(4.0), **throttle})


def _steady(highest_iri: float = 4.0) -> "SearchStrategy[dict[str, Any]]":
    """Return a strategy of drives at constant speed."""
    from hypothesis import strategies as st

    return st.fixed_dictionaries({**_common(highest_iri), "speed_kmh": rounded_numbers(30.0, 97.0)})


def _smooth() -> "SearchStrategy[dict[str, Any]]":
    """Return a strategy of drives over roads that can be made higher.

    Their speed is constant: the tilt under throttle does not increase with the road.
    """
    return _steady(1.5)


def _common(highest_iri: float) -> "dict[str, SearchStrategy[Any]]":
    from hypothesis import strategies as st

    return {
        "road": st.sampled_from(ROADS),
        "vehicle": st.sampled_from(VEHICLES),
        "iri_m_per_km": rounded_numbers(1.0, highest_iri),
        "rate_hz": st.sampled_from(RATES_HZ),
    }


def _stop() -> "SearchStrategy[dict[str, Any]]":
    """Return a strategy of drives with a stop that can be twice as long."""
    from hypothesis import strategies as st

    return st.fixed_dictionaries(
        {
            "road": st.sampled_from(ROADS),
            "vehicle": st.sampled_from(VEHICLES),
            "iri_m_per_km": rounded_numbers(1.5, 4.0),
            "rate_hz": st.sampled_from((4000.0, 8000.0)),
            "speed_kmh": rounded_numbers(30.0, 80.0),
            "deceleration_g": rounded_numbers(0.1, 0.4, 2),
            "dwell_s": st.sampled_from((0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0)),
            "final_speed_kmh": rounded_numbers(30.0, 65.0),
        }
    )


_DRAWN = MappingProxyType({STOP: _stop, "road-height": _smooth})


def _numbers(change: str, rate_hz: float) -> "SearchStrategy[dict[str, Number]]":
    """Return a strategy of the numbers of ``change`` in a recording at ``rate_hz``."""
    from hypothesis import strategies as st

    others = tuple(rate for rate in RATES_HZ if rate != rate_hz)
    strategies: Mapping[str, Mapping[str, SearchStrategy[Any]]] = {
        "later-start": {"samples": st.integers(1, int(LATEST_S * rate_hz))},
        "accelerometer-bias": {"bias": rounded_numbers(-0.03, 0.03, 3)},
        "clock-origin": {"shift_s": rounded_numbers(-1e6, 1e6)},
        "distance-origin": {"shift_m": rounded_numbers(-1e5, 1e5, 2)},
        "road-height": {"factor": rounded_numbers(0.4, 0.8) | rounded_numbers(1.3, 2.7)},
        "sample-rate": {"rate_hz": st.sampled_from(others)},
        "gnss-datum": {"shift_m": rounded_numbers(-3000.0, 3000.0)},
        "gnss-rate": {"every": st.integers(2, 4)},
        "gyro-rate": {"gyro_rate_hz": st.sampled_from((125.0, 160.0, 200.0, 400.0))},
        UNIT_BIAS: {
            "bias": rounded_numbers(-0.03, 0.03, 3),
            "rate_bias": rounded_numbers(-0.0005, 0.0005, 5),
        },
        SLOPE: {
            "grade_percent": rounded_numbers(-2.0, -1.0) | rounded_numbers(1.0, 2.0),
            "cross_slope_percent": rounded_numbers(-2.0, 2.0),
        },
    }
    return st.fixed_dictionaries(dict(strategies.get(change, {})))
