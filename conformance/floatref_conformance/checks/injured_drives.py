"""The drives and the faults of `faults`: fixed by the edition, or drawn."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from floatref_conformance.checks.augmented_injuries import AUGMENTED
from floatref_conformance.checks.case import Case, Number
from floatref_conformance.checks.injuries import INJURIES
from floatref_conformance.checks.rounded import rounded, seed_of_its_own, seeds
from floatref_conformance.classes import Effort
from floatref_conformance.proving_ground.scenario import Scenario

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn, SearchStrategy

CHECK = "faults"
ROLLING = "encoder-rolling-back"
AT_A_STOP = (ROLLING, "gnss-outage-at-a-stop", "imu-gyro-gap")
"""Faults of drives with a stop; in the others the vehicle does not change its speed."""
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
"""Grades of seeded cases: on a level road a height that is stuck would nearly be right."""
NUMBERS: Mapping[str, tuple[Mapping[str, Number], ...]] = MappingProxyType(
    {
        "laser-dropout": ({"length_s": 1.0}, {"length_s": 0.0}, {"length_s": 2.0}),
        "laser-flicker": (
            {"length_s": 0.005, "count": 20, "span_m": 40.0},
            {"length_s": 0.001, "count": 60, "span_m": 20.0},
            {"length_s": 0.02, "count": 40, "span_m": 60.0},
        ),
        "laser-stuck": ({"length_s": 0.6}, {"length_s": 0.1}, {"length_s": 1.0}),
        "laser-out-of-range": (
            {"length_s": 0.1, "side": 1.0},
            {"length_s": 0.01, "side": -1.0},
            {"length_s": 0.5, "side": -1.0},
        ),
        "accelerometer-dropout": ({"length_s": 0.6}, {"length_s": 0.0}, {"length_s": 1.0}),
        "accelerometer-saturation": (
            {"length_s": 0.008, "full_scale_g": 4.0},
            {"length_s": 0.003, "full_scale_g": -2.0},
            {"length_s": 0.02, "full_scale_g": 2.0},
        ),
        "gap": ({"length_s": 0.5}, {"length_s": 0.05}, {"length_s": 1.0}),
        "gap-in-time": ({"length_s": 0.4}, {"length_s": 1.0}, {"length_s": 0.05}),
        "encoder-dropout": ({"length_s": 0.4}, {"length_s": 0.05}, {"length_s": 1.0}),
        "encoder-leap": ({"size_m": 1.0}, {"size_m": 0.1}, {"size_m": 3.0}),
        "encoder-silence": ({"length_s": 0.3}, {"length_s": 0.05}, {"length_s": 1.0}),
        "encoder-lost-counts": ({"length_s": 0.2}, {"length_s": 0.05}, {"length_s": 1.0}),
        "encoder-counts-back": (
            {"count": 5, "size_m": 0.003},
            {"count": 1, "size_m": 0.05},
            {"count": 10, "size_m": 0.001},
        ),
        ROLLING: ({"size_m": 0.2}, {"size_m": 0.02}, {"size_m": 0.5}),
        "gnss-outage": ({"length_s": 5.0}, {"length_s": 2.0}, {"length_s": 10.0}),
        "gnss-wrong-fix": (
            {"length_s": 3.0, "size_m": 1.0},
            {"length_s": 2.0, "size_m": -0.3},
            {"length_s": 10.0, "size_m": 3.0},
        ),
        "gnss-float": (
            {"length_s": 6.0, "size_m": 0.4},
            {"length_s": 3.0, "size_m": -0.2},
            {"length_s": 10.0, "size_m": 1.0},
        ),
        "gnss-jump": ({"size_m": 1.0}, {"size_m": -0.3}, {"size_m": 3.0}),
        "gnss-stuck": ({"length_s": 4.0}, {"length_s": 2.0}, {"length_s": 8.0}),
        "gnss-never-fixed": ({"size_m": 0.5}, {"size_m": -0.2}, {"size_m": 1.5}),
        "gnss-outage-at-a-stop": ({"length_s": 15.0}, {"length_s": 30.0}, {"length_s": 8.0}),
        "imu-gyro-gap": ({"length_s": 1.0}, {"length_s": 0.2}, {"length_s": 0.5}),
        "imu-flicker": (
            {"count": 20, "span_m": 40.0},
            {"count": 5, "span_m": 10.0},
            {"count": 60, "span_m": 60.0},
        ),
    }
)
"""For each fault, the numbers of the seeded cases in turn."""
PLACES_M = (285.3, 251.7, 316.0)
NEAREST_M, FARTHEST_M = 230.0, 330.0
"""Where faults begin: far enough from both ends for what they spread."""
ROADS = ("sayers-normal", "sayers-asphalt-long-waves", "measured")
VEHICLES = ("loaded-van", "minivan", "pickup", "trailer")
RATES_HZ = (16000.0, 8000.0, 4000.0)
FULL_SCALES_G = (-5.0, -4.0, -2.0, 2.0, 4.0, 5.0)
Numbers = Mapping[str, "SearchStrategy[Any]"]


def fixed(seed: int, effort: Effort) -> tuple[Case, ...]:
    """Return every fault once, in a certification three times; ``seed`` draws their roads.

    No two cases share a road: whoever has seen the one knows nothing of the other.
    """
    rounds = range(1 if effort is Effort.QUICK else len(ROUNDS))
    source = np.random.SeedSequence([seed, *CHECK.encode()])
    roads = iter(source.generate_state(len(rounds) * len(INJURIES)).tolist())
    # Nominal faults come first: their roads are the same for whatever device is judged.
    nominal = [fault for fault in INJURIES if fault not in AUGMENTED]
    return tuple(
        Case(
            CHECK,
            _drive(fault, number, n, next(roads)),
            {"fault": fault, "at_m": PLACES_M[n], **NUMBERS[fault][n]},
            f"{CHECK}-{fault}-{n + 1}",
        )
        for faults in (nominal, AUGMENTED)
        for n in rounds
        for number, fault in enumerate(faults)
    )


def drawn(faults: Sequence[str] = tuple(INJURIES)) -> "SearchStrategy[Case]":
    """Return the strategy of any of ``faults`` in any drive."""
    from hypothesis import strategies as st

    @st.composite
    def case(draw: "DrawFn") -> Case:
        fault = draw(st.sampled_from(faults))
        drives = _stop() if fault in AT_A_STOP else _steady(fault)
        numbers = draw(st.fixed_dictionaries(dict(drives)))
        variation = draw(st.fixed_dictionaries(dict(_numbers(fault))))
        at_m = draw(rounded(NEAREST_M, FARTHEST_M))
        variation = {"fault": fault, "at_m": at_m, **variation}
        seed = seed_of_its_own(draw(seeds()), numbers, variation)
        return Case(CHECK, Scenario(seed=seed, length_m=LENGTH_M, **numbers), variation)

    return case()


def _drive(fault: str, number: int, n: int, seed: int) -> Scenario:
    """Return the drive of a seeded case of round ``n``."""
    fields = dict(STOP if fault in AT_A_STOP else ROUNDS[n][number % 2])
    if fault in SLOPES_PERCENT:
        fields["grade_percent"] = SLOPES_PERCENT[fault][n]
    return Scenario(seed=seed, length_m=LENGTH_M, **fields)


def _common() -> Numbers:
    from hypothesis import strategies as st

    return {
        "road": st.sampled_from(ROADS),
        "vehicle": st.sampled_from(VEHICLES),
        "iri_m_per_km": rounded(1.5, 4.0),
        "rate_hz": st.sampled_from(RATES_HZ),
    }


def _steady(fault: str) -> Numbers:
    drives = {**_common(), "speed_kmh": rounded(40.0, 97.0)}
    if fault in SLOPES_PERCENT:
        drives["grade_percent"] = rounded(-4.0, -2.0) | rounded(2.0, 4.0)
    return drives


def _stop() -> Numbers:
    from hypothesis import strategies as st

    return {
        **_common(),
        "manoeuvre": st.just("stop"),
        "speed_kmh": rounded(40.0, 60.0),
        "deceleration_g": rounded(0.1, 0.3, 2),
        "dwell_s": rounded(2.0, 8.0),
        "event_at_m": st.just(STOP_M),
    }


def _numbers(fault: str) -> Numbers:
    """Return strategies of the numbers of ``fault``."""
    from hypothesis import strategies as st

    numbers: Mapping[str, Numbers] = {
        "laser-dropout": {"length_s": rounded(0.0, 2.0, 2)},
        "laser-flicker": {
            "length_s": rounded(0.001, 0.02, 3),
            "count": st.integers(5, 60),
            "span_m": rounded(5.0, 60.0),
        },
        "laser-stuck": {"length_s": rounded(0.1, 1.0, 2)},
        "laser-out-of-range": {
            "length_s": rounded(0.01, 0.5, 2),
            "side": st.sampled_from((-1.0, 1.0)),
        },
        "accelerometer-dropout": {"length_s": rounded(0.0, 1.0, 2)},
        "accelerometer-saturation": {
            "length_s": rounded(0.002, 0.02, 3),
            "full_scale_g": st.sampled_from(FULL_SCALES_G),
        },
        "encoder-leap": {"size_m": rounded(0.1, 3.0, 2)},
        "encoder-counts-back": {"count": st.integers(1, 10), "size_m": rounded(0.001, 0.05, 3)},
        ROLLING: {"size_m": rounded(0.02, 0.5, 2)},
        "gnss-outage": {"length_s": rounded(2.0, 10.0)},
        "gnss-wrong-fix": {"length_s": rounded(2.0, 10.0), "size_m": rounded(-3.0, 3.0)},
        "gnss-float": {"length_s": rounded(2.0, 10.0), "size_m": rounded(-1.0, 1.0)},
        "gnss-jump": {"size_m": rounded(0.3, 3.0) | rounded(-3.0, -0.3)},
        "gnss-stuck": {"length_s": rounded(2.0, 10.0)},
        "gnss-never-fixed": {"size_m": rounded(-1.5, 1.5)},
        "gnss-outage-at-a-stop": {"length_s": rounded(8.0, 30.0)},
        "imu-flicker": {"count": st.integers(5, 60), "span_m": rounded(5.0, 60.0)},
    }
    return numbers.get(fault, {"length_s": rounded(0.05, 1.0, 2)})
