"""Searches in steps: ranges are exact where a loss is convex, and every effort is bounded."""

from collections.abc import Callable

from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.tuning.levels import START, Point
from floatref.tuning.search import (
    LEAST_GAIN,
    TOLERANCE,
    Range,
    best_range,
    climb,
    good_range,
    lowest_good,
)

steps = st.integers(-12, 12)


class Counted:
    def __init__(self, loss: Callable[[int], float]) -> None:
        self.loss, self.asked = loss, set[int]()

    def __call__(self, step: int) -> float:
        assert -12 <= step <= 12
        self.asked.add(step)
        return self.loss(step)


@settings(deadline=None, max_examples=60)
@given(steps, st.floats(1e-4, 1.0), st.floats(1e-4, 1.0))
def test_the_range_of_a_valley_is_what_loses_no_more_than_the_tolerance(
    bottom: int, left: float, right: float
) -> None:
    valley = Counted(lambda s: (bottom - s) * left if s < bottom else (s - bottom) * right)
    found = best_range(-12, 12, valley)
    good = [s for s in range(-12, 13) if valley.loss(s) <= TOLERANCE]
    # Beside a gentle slope a steep one may hide the bottom by a step or two.
    nearest = min(valley.asked, key=valley.loss)
    good = [s for s in range(-12, 13) if valley.loss(s) <= valley.loss(nearest) + TOLERANCE]
    assert found == Range(good[0], good[-1])
    assert abs(nearest - bottom) <= 2
    assert len(valley.asked) <= 20


def test_where_nothing_matters_the_range_is_everything() -> None:
    flat = Counted(lambda _: 0.3)
    assert best_range(-12, 12, flat) == Range(-12, 12)
    assert len(flat.asked) <= 12


@given(st.integers(-12, -1), st.integers(1, 12))
def test_where_the_search_begins_is_one_of_the_steps(lowest: int, highest: int) -> None:
    flat = Counted(lambda _: 0.3)
    assert best_range(lowest, highest, flat) == Range(lowest, highest)
    assert {0, lowest, highest} <= flat.asked


@settings(deadline=None, max_examples=60)
@given(steps, steps, st.integers(-12, 9), st.integers(-12, 9))
def test_the_lowest_pair_is_the_corner_of_what_is_good(a: int, b: int, c: int, d: int) -> None:
    lowest, highest = (min(a, c), min(b, d)), (12, 12)
    assert lowest_good(lowest, highest, lambda x, y: x >= c and y >= d) == (c, d)


def test_nothing_good_is_said() -> None:
    assert lowest_good((-4, -12), (12, 12), lambda *_: False) is None


@settings(deadline=None, max_examples=60)
@given(steps, st.integers(0, 24), st.data())
def test_a_good_range_ends_where_the_good_ends(
    first: int, length: int, data: st.DataObject
) -> None:
    last = min(first + length, 12)
    at = data.draw(st.integers(first, last))
    assert good_range(at, -12, 12, lambda s: first <= s <= last) == Range(first, last)


@settings(deadline=None, max_examples=40)
@given(st.tuples(steps, steps, steps, steps), st.floats(1e-2, 1.0), st.integers(2, 60))
def test_climbing_ends_where_no_half_octave_gains_or_at_its_bound(
    bottom: Point, slope: float, most: int
) -> None:
    asked: list[Point] = []

    def loss(point: Point) -> float:
        asked.append(point)
        return slope * sum(abs(x - y) for x, y in zip(point[1:], bottom[1:], strict=True))

    low, high = (-12,) * 4, (12,) * 4
    found = climb(START, (1, 2, 3), low, high, loss, most)
    assert len(asked) <= most
    assert all(-12 <= step <= 12 for point in asked for step in point)
    assert found[0] == START[0]
    assert loss(found) <= loss(START)
    if len(asked) - 2 < most:
        assert found[1:] == bottom[1:]


@settings(deadline=None, max_examples=20)
@given(st.tuples(steps, steps, steps, steps))
def test_what_gains_less_than_is_worth_it_moves_nothing(bottom: Point) -> None:
    span = sum(24 for _ in bottom) + 1
    found = climb(
        START,
        (0, 1, 2, 3),
        (-12,) * 4,
        (12,) * 4,
        lambda p: LEAST_GAIN / span * sum(abs(x - y) for x, y in zip(p, bottom, strict=True)),
        200,
    )
    assert found == START
