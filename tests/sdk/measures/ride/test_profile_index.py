"""What is read off a trace: blanking band, scallops, profile index, and what must be ground."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.measures import TraceRules, must_grind, profile_indices
from floatref.measures.ride.profile_index import scallop_heights

INTERVAL = 0.0762
INCH = 0.0254
TENTH = 2112
"""Intervals of 3 in of 0.1 mile."""
ALL_VALID = np.ones(TENTH + 1, dtype=bool)


def trace_of(*pulses: tuple[int, int, float], points: int = TENTH) -> np.ndarray:
    """Return a flat trace with pulses of first point, count and height in m."""
    trace = np.zeros(points)
    for first, count, height in pulses:
        trace[first : first + count] = height
    return trace


def balanced(*pulses: tuple[int, int, float]) -> np.ndarray:
    """Return a trace whose mean is zero: every pulse has its like upside down."""
    return trace_of(*pulses) - trace_of(*((1000 + a, n, h) for a, n, h in pulses))


def test_worked_example() -> None:
    """Scallops of 0.27 and 0.13 in beyond the band, twice: 0.25 + 0.15, twice, in 0.1 mile."""
    trace = balanced((100, 20, 0.37 * INCH), (300, 30, 0.23 * INCH))
    sound = np.ones(TENTH, dtype=bool)
    (found,) = profile_indices(trace, sound, INTERVAL)
    assert found.scallops == 4
    assert found.measured_m == pytest.approx(160.9344)
    # 0.8 in in 0.1 mile are 8 in/mi.
    assert found.profile_index_m_per_km * 63.36 == pytest.approx(8.0)


def test_the_zero_blanking_band_counts_all_of_it() -> None:
    trace = balanced((100, 20, 0.37 * INCH), (300, 30, 0.23 * INCH))
    rules = TraceRules(blanking_band_m=0.0, rounding_m=0.0)
    heights = sorted(scallop_heights(trace, INTERVAL, rules))
    assert heights == pytest.approx([0.23 * INCH] * 2 + [0.37 * INCH] * 2)


@pytest.mark.parametrize(
    ("count", "height_in", "expected"),
    [(7, 0.3, 0), (8, 0.3, 2), (20, 0.128, 0), (20, 0.132, 2)],
)
def test_low_and_short_scallops_do_not_count(count: int, height_in: float, expected: int) -> None:
    """From 2 ft, 8 intervals of 3 in, and from 0.03 in beyond the band of ±0.1 in on."""
    trace = balanced((100, count, height_in * INCH))
    assert len(list(scallop_heights(trace, INTERVAL))) == expected


@given(seed=st.integers(0, 2**32 - 1), level=st.floats(-1.0, 1.0))
@settings(deadline=None, max_examples=10)
def test_the_band_follows_the_level_of_the_trace(seed: int, level: float) -> None:
    trace = np.cumsum(np.random.default_rng(seed).normal(0.0, 5e-4, 600))
    sound = np.ones(600, dtype=bool)
    (one,), (other,) = (profile_indices(t, sound, INTERVAL) for t in (trace, trace + level))
    assert one.profile_index_m_per_km == pytest.approx(other.profile_index_m_per_km)


def test_segments_are_cut_and_unknown_parts_are_not_counted_as_length() -> None:
    trace = np.zeros(3000)
    trace[:100] = np.nan
    sound = np.arange(3000) >= 1100
    first, last = profile_indices(trace, sound, INTERVAL, start_m=10.0)
    assert (first.start_m, first.length_m) == (10.0, pytest.approx(160.9344))
    assert first.measured_m == pytest.approx(2012 * INTERVAL)
    assert first.valid_share == pytest.approx(1012 / 2012)
    assert (last.length_m, last.valid_share) == (pytest.approx(888 * INTERVAL), 1.0)
    (nothing,) = profile_indices(np.full(50, np.nan), np.ones(50, bool), INTERVAL)
    assert np.isnan(nothing.profile_index_m_per_km)


def test_one_bump_must_be_ground() -> None:
    trace, sound = trace_of((500, 10, 0.010)), np.ones(TENTH, dtype=bool)
    sound[500:505] = False
    (found,) = must_grind(trace, sound, INTERVAL, start_m=7.0)
    assert found.start_m == pytest.approx(7.0 + 500 * INTERVAL)
    assert found.end_m == pytest.approx(7.0 + 509 * INTERVAL)
    assert found.height_m == pytest.approx(0.010)
    assert found.valid_share == 0.5


@pytest.mark.parametrize(
    ("pulse", "why"),
    [
        ((500, 10, 0.0076), "not above 0.3 in"),
        ((500, 100, 0.010), "longer than the template"),
        ((500, 10, -0.010), "a dip, whose edges are not ground"),
        ((500, 2000, 0.010), "a step"),
    ],
)
def test_what_need_not_be_ground(pulse: tuple[int, int, float], why: str) -> None:
    assert must_grind(trace_of(pulse), np.ones(TENTH, dtype=bool), INTERVAL) == (), why


def test_the_longest_bump_under_the_template() -> None:
    """25 ft are 100 intervals: a bump of 99 points has lower points 100 intervals apart."""
    sound = np.ones(TENTH, dtype=bool)
    assert len(must_grind(trace_of((500, 99, 0.010)), sound, INTERVAL)) == 1


def test_the_height_is_above_the_higher_side() -> None:
    trace = trace_of((500, 10, 0.020), (510, 400, 0.008))
    (found,) = must_grind(trace, np.ones(TENTH, dtype=bool), INTERVAL)
    assert found.height_m == pytest.approx(0.012)


@pytest.mark.parametrize(
    "rules",
    [{"blanking_band_m": -1.0}, {"segment_m": 0.0}, {"bump_height_m": float("nan")}],
)
def test_impossible_rules_are_refused(rules: dict[str, float]) -> None:
    (name,) = rules
    with pytest.raises(InputError, match=name):
        TraceRules(**rules)
