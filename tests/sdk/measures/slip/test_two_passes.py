"""Two passes over one road show the slip of the one that brakes, or why they do not."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures.slip.two_passes import slip_of_passes
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile, ProfileTrack

STEP_M, LENGTH_M = 0.05, 300.0
ALONG_M = np.arange(0.0, LENGTH_M, STEP_M)


def profile(slip: float, brakes: bool, seed: int = 0, scale: float = 1.0) -> Profile:
    """Return a pass from 20 m/s, which brakes to 6 m/s between 120 and 180 m, with noise."""
    road = np.cumsum(np.random.default_rng(9).normal(size=ALONG_M.size)) * 1e-3
    low = 36.0 if brakes else 400.0
    squared = np.interp(ALONG_M, [120.0, 180.0], [400.0, low])
    counted = scale * ALONG_M + slip * (squared - 400.0) / (2.0 * STANDARD_GRAVITY)
    z = np.interp(np.arange(0.0, counted[-1], STEP_M), counted, road)
    z = z + 2e-4 * np.random.default_rng(seed).normal(size=z.size)
    knots = np.interp([0.0, 120.0, 180.0, LENGTH_M - STEP_M], ALONG_M, counted)
    speeds = np.sqrt([400.0, 400.0, low, low])
    record = {"source": "encoder", "along_m": knots.tolist(), "speed_mps": speeds.tolist()}
    return Profile(STEP_M, (ProfileTrack.of("left", z),), provenance={"distance": record})


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(st.floats(0.0, 0.12), st.floats(0.999, 1.001), st.booleans())
def test_the_slip_of_the_pass_that_brakes_is_found(slip: float, scale: float, swap: bool) -> None:
    passes = profile(slip, True, 1, scale), profile(slip, False, 2)
    found = slip_of_passes(*(passes[::-1] if swap else passes))
    assert found.slip_per_g == pytest.approx(slip, abs=3e-3)
    assert found.stretches >= 20


def without(key: str) -> Callable[[Profile], Profile]:
    def change(one: Profile) -> Profile:
        record = {k: v for k, v in one.provenance["distance"].items() if k != key}
        return replace(one, provenance={"distance": record})

    return change


def renamed(one: Profile) -> Profile:
    return replace(one, tracks=(replace(one.tracks[0], name="right"),))


def corrected(one: Profile) -> Profile:
    return replace(
        one, provenance={"distance": {**one.provenance["distance"], "source": "setting"}}
    )


def of_noise(one: Profile) -> Profile:
    z = np.random.default_rng(5).normal(size=one.tracks[0].elevation.size)
    return replace(one, tracks=(ProfileTrack.of("left", z),))


REFUSALS: list[tuple[str, Callable[[Profile], Profile], str]] = [
    ("no record", lambda p: replace(p, provenance={}), "no record of an encoder's distance"),
    ("no speed", without("speed_mps"), "no record of its speed"),
    ("corrected", corrected, "corrected already, by setting"),
    ("interval", lambda p: replace(p, interval_m=0.1), "process both alike"),
    ("wheel path", renamed, "no wheel path in common"),
    ("another road", of_noise, "give two of one road"),
]


@pytest.mark.parametrize(
    ("change", "said"), [r[1:] for r in REFUSALS], ids=[r[0] for r in REFUSALS]
)
def test_passes_that_show_nothing_are_refused_with_the_reason(change: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        slip_of_passes(profile(0.05, True), change(profile(0.05, False)))


def test_without_a_brake_there_is_nothing_to_learn() -> None:
    with pytest.raises(InputError, match="neither pass has a brake"):
        slip_of_passes(profile(0.05, False, 1), profile(0.05, False, 2))
