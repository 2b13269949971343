"""The drives and the faults of `faults`: fixed by the edition, or drawn."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref_conformance.checks.case import Case
from floatref_conformance.checks.faults.augmented_faults import AUGMENTED, RESPONSE
from floatref_conformance.checks.faults.fault_numbers import NUMBERS, Numbers, number_strategies
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS
from floatref_conformance.checks.rounded import rounded_numbers, seed_of_its_own, seeds
from floatref_conformance.classes import Effort
from floatref_conformance.editions.edition import Edition
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

CHECK = "faults"
ROLLING = "encoder-rolling-back"
AT_A_STOP = (ROLLING, "gnss-outage-at-a-stop", "imu-gyro-gap")
"""Faults in drives with a stop; in the others the speed is constant."""
LENGTH_M = 560.0
STOP_M = 320.0
ROUNDS: tuple[tuple[Mapping[str, Any], ...], ...] = (
    (
        {"speed_kmh": 72.0, "rate_hz": 8000.0},
        {"speed_kmh": 50.0, "rate_hz": 4000.0, "iri_m_per_km": 2.5},
    ),
    (
        {"speed_kmh": 97.0, "rate_hz": 16000.0, "iri_m_per_km": 1.5},
        {"speed_kmh": 40.0, "rate_hz": 4000.0, "vehicle": "pickup"},
    ),
    (
        {"speed_kmh": 60.0, "rate_hz": 16000.0, "vehicle": "minivan"},
        {"speed_kmh": 85.0, "rate_hz": 4000.0, "road": "measured"},
    ),
)
"""Drives of the seeded cases, two in turn; the first pair is that of a quick run."""
STOP: Mapping[str, Any] = {
    "manoeuvre": "stop",
    "speed_kmh": 50.0,
    "rate_hz": 4000.0,
    "event_at_m": STOP_M,
}
SLOPES_PERCENT: Mapping[str, tuple[float, ...]] = MappingProxyType({"gnss-stuck": (3.0, -2.0, 4.0)})
"""Grades of seeded cases: on a level road a stuck height would be nearly right."""
PLACES_M = (285.3, 251.7, 316.0)
NEAREST_M, FARTHEST_M = 230.0, 330.0
"""Range in m where faults begin; their effect does not reach the ends."""
ROADS = ("sayers-normal", "sayers-asphalt-long-waves", "measured")
VEHICLES = ("loaded-van", "minivan", "pickup", "trailer")
RATES_HZ = (16000.0, 8000.0, 4000.0)


def seeded_cases(seed: int, effort: Effort, edition: Edition) -> tuple[Case, ...]:
    """Return every fault once, in a certification three times; ``seed`` draws their roads.

    No two cases have the same road, so that a device cannot use what it stored.
    """
    rounds = range(1 if effort is Effort.QUICK else len(ROUNDS))
    source = np.random.SeedSequence([seed, *CHECK.encode()])
    roads = iter(source.generate_state(len(rounds) * len(SENSOR_FAULTS)).tolist())
    # Faults of nominal sensors come first: their roads are the same for every device.
    nominal = [fault for fault in SENSOR_FAULTS if fault not in {*AUGMENTED, *RESPONSE}]
    return tuple(
        Case(
            CHECK,
            _drive(fault, number, n, next(roads), edition),
            {"fault": fault, "at_m": PLACES_M[n], **NUMBERS[fault][n]},
            f"{CHECK}-{fault}-{n + 1}",
        )
        for faults in (nominal, AUGMENTED, RESPONSE)
        for n in rounds
        for number, fault in enumerate(faults)
    )


def case_strategy(
    edition: Edition, faults: Sequence[str] = tuple(SENSOR_FAULTS)
) -> "SearchStrategy[Case]":
    """Return the strategy of any of ``faults`` in any drive."""
    from hypothesis import strategies as st

    @st.composite
    def case(draw: "DrawFn") -> Case:
        fault = draw(st.sampled_from(faults))
        drives = _stop() if fault in AT_A_STOP else _steady(fault)
        numbers = draw(st.fixed_dictionaries(dict(drives)))
        variation = draw(st.fixed_dictionaries(dict(number_strategies(fault))))
        at_m = draw(rounded_numbers(NEAREST_M, FARTHEST_M))
        variation = {"fault": fault, "at_m": at_m, **variation}
        seed = seed_of_its_own(draw(seeds()), numbers, variation)
        return Case(CHECK, make_drive(edition, seed=seed, **numbers), variation)

    return case()


def _drive(fault: str, number: int, n: int, seed: int, edition: Edition) -> Scenario:
    """Return the drive of a seeded case of round ``n``."""
    fields = dict(STOP if fault in AT_A_STOP else ROUNDS[n][number % 2])
    if fault in SLOPES_PERCENT:
        fields["grade_percent"] = SLOPES_PERCENT[fault][n]
    return make_drive(edition, seed=seed, **fields)


def make_drive(edition: Edition, **numbers: Any) -> Scenario:
    """Return the drive of ``numbers``: its encoder does not slip where ``edition`` judges slip."""
    return edition.make_scenario(**edition.without_slip, length_m=LENGTH_M, **numbers)


def _common() -> Numbers:
    from hypothesis import strategies as st

    return {
        "road": st.sampled_from(ROADS),
        "vehicle": st.sampled_from(VEHICLES),
        "iri_m_per_km": rounded_numbers(1.5, 4.0),
        "rate_hz": st.sampled_from(RATES_HZ),
    }


def _steady(fault: str) -> Numbers:
    drives = {**_common(), "speed_kmh": rounded_numbers(40.0, 97.0)}
    if fault in SLOPES_PERCENT:
        drives["grade_percent"] = rounded_numbers(-4.0, -2.0) | rounded_numbers(2.0, 4.0)
    return drives


def _stop() -> Numbers:
    from hypothesis import strategies as st

    return {
        **_common(),
        "manoeuvre": st.just("stop"),
        "speed_kmh": rounded_numbers(40.0, 60.0),
        "deceleration_g": rounded_numbers(0.1, 0.3, 2),
        "dwell_s": rounded_numbers(2.0, 8.0),
        "event_at_m": st.just(STOP_M),
    }
