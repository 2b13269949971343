"""Rows are timed by their ticks, their rate, or what a map states; no other time comes out."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.mapping.channel_map.entries import ClockEntry
from floatref.mapping.clocks.columns import UNKNOWN
from floatref.values.native import Epoch

Make = Callable[..., Any]
STATED = Fraction(48_000, 7)


def test_stamps_in_ms_of_16_khz_are_the_rate_and_lose_no_row(reading: Make, taken: Make) -> None:
    ticks = np.round(np.arange(32_000) / 16.0).astype(np.int64)
    found = taken(reading(ticks, [5000], tick_s=Fraction(1, 1000)))
    assert found.rate == 16_000
    assert found.columns[0].size == 32_000
    assert found.warnings == ()


def test_a_stream_without_any_time_says_so(reading: Make, taken: Make) -> None:
    with pytest.raises(InputError, match="all 5 rows have no time; state rate_hz"):
        taken(reading(np.full(5, np.nan)))
    with pytest.raises(InputError, match="has no time from its adapter"):
        taken(reading(None, size=5))
    with pytest.raises(InputError, match="has no time; state rate_hz for it under"):
        taken(reading(None, size=5, name=UNKNOWN))


@pytest.mark.parametrize("start_s", [None, 0.0, 12.5])
@pytest.mark.parametrize(
    ("ticks", "clock", "begin"),
    [
        (None, {"name": UNKNOWN}, 0),
        (np.array([40, 30, 20]), {}, 40),
        (np.array([40, 40, 40], np.uint8), {"tick_s": Fraction(1, 4)}, 10),
        (np.array([1.5, np.nan, 0]), {"origin_ns": 10**9, "epoch": Epoch.UTC}, 2.5),
        (None, {"rate": Fraction(5), "first_tick": 3, "tick_s": Fraction(2)}, 6),
    ],
)
def test_a_stated_rate_replaces_the_clock_of_the_stream(
    ticks: np.ndarray | None,
    clock: dict,
    begin: float,
    start_s: float | None,
    reading: Make,
    taken: Make,
) -> None:
    stream = reading(ticks, [1], **clock, **({"size": 3} if ticks is None else {}))
    found = taken(stream, ClockEntry(rate=STATED, start_s=start_s))
    assert (found.rate, found.times_s, found.warnings) == (STATED, None, ())
    assert found.columns[0].tolist() == [0, 1, 2]
    origin = clock.get("origin_ns", 0) / 1e9
    assert found.start_s == (begin if start_s is None else origin + start_s)


def test_a_stated_rate_counts_back_from_the_first_row_that_has_a_time(
    reading: Make, taken: Make
) -> None:
    ticks = np.array([np.nan, np.nan, 10.0, 11.0])
    found = taken(reading(ticks, [1]), ClockEntry(rate=Fraction(2)))
    assert found.start_s == 9


def test_an_alignment_without_a_rate_leaves_the_clock_alone(
    reading: Make, taken: Make, times: Make
) -> None:
    found = taken(reading(np.array([0, 30, 50])), ClockEntry(align="offset"))
    assert times(found).tolist() == [0, 30, 50]


@pytest.mark.parametrize(
    ("ticks", "clock"),
    [
        (np.array([0.0, 1e300]), {}),
        (np.array([0.0, 1e308]), {"tick_s": Fraction(1000)}),
        (np.array([-1e300, 0.0]), {"epoch": Epoch.UTC}),
        (np.array([-(2**63), 2**63 - 1]), {}),
        (np.array([2**62, 2**62 + 1]), {}),
        (np.array([0, 1]), {"origin_ns": 2 * 10**21}),
        (np.array([1.7e308, 1.7e308]), {"tick_s": Fraction(10**300)}),
    ],
)
def test_a_time_that_no_epoch_explains_is_refused(
    ticks: np.ndarray, clock: dict, reading: Make, taken: Make
) -> None:
    with pytest.raises(InputError, match=r"time of row \d+ is more than 1e\+12 s from zero"):
        taken(reading(ticks, **clock))


def test_large_integers_lose_nothing(reading: Make, taken: Make) -> None:
    ticks = 2**62 + np.array([0, 1, 5, 6])
    found = taken(reading(ticks, tick_s=Fraction(1, 10**9)))
    assert found.times_s is not None
    assert (1e9 * found.times_s).round().tolist() == [0, 1, 5, 6]
    assert found.start_s == Fraction(2**62, 10**9)


def test_integers_may_go_from_end_to_end(reading: Make, taken: Make, times: Make) -> None:
    found = taken(reading(np.array([-(2**63), 0, 2**63 - 1]), tick_s=Fraction(1, 10**9)))
    assert found.start_s == Fraction(-(2**63), 10**9)
    np.testing.assert_allclose(times(found), [-(2**63) / 1e9, 0, 2**63 / 1e9], atol=1e-5)
