"""The procedure on losses that are functions of the four steps: its order, its guards, its end."""

from collections.abc import Callable, Mapping, Sequence
from zlib import crc32

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.tuning.levels import START, TUNED, Levels, Point
from floatref.tuning.preliminary_runs import Kind
from floatref.tuning.procedure import MOST, Procedure, first_point
from floatref.tuning.search import LEAST_GAIN, TOLERANCE

USUAL = dict.fromkeys(TUNED, 1e-4)
LEVELS = Levels.of(USUAL, USUAL)
DENSITY, WALK, PITCH, ROLL = TUNED
SIX = {
    "slow": Kind.LOW,
    "fast": Kind.HIGH,
    "light": Kind.LIGHT,
    "heavy": Kind.HEAVY,
    "short": Kind.SHORT,
    "long": Kind.LONG,
}
Loss = Callable[[str, int, Point], float]
"""Of a run, the number of a wheel path, and a point."""


class Bench:
    """Runs whose losses are a function, and a count of the points that were looked at."""

    def __init__(
        self, loss: Loss, kinds: Mapping[str, Kind] = SIX, begin: Point = START, tracks: int = 2
    ) -> None:
        self.loss, self.tracks, self.points = loss, tracks, list[Point]()
        nominal = {name: [0.1] * tracks for name in kinds}
        self.procedure = Procedure(kinds, nominal, LEVELS, self.evaluate, begin)
        self.found = self.procedure.search()

    def evaluate(self, point: Point, runs: Sequence[str]) -> dict[str, list[float]]:
        assert all(
            low <= step <= high
            for low, step, high in zip(LEVELS.lowest, point, LEVELS.highest, strict=True)
        )
        if point not in self.points:
            self.points.append(point)
        return {name: [self.loss(name, t, point) for t in range(self.tracks)] for name in runs}


def valley(step: int, bottom: int, slope: float = 0.02) -> float:
    return slope * abs(step - bottom)


@settings(deadline=None, max_examples=20)
@given(st.integers(-12, 12), st.integers(-12, 12), st.integers(-12, 12))
def test_the_best_of_separate_valleys_is_found(walk: int, pitch: int, roll: int) -> None:
    def loss(run: str, _: int, p: Point) -> float:
        if run in ("fast", "light"):
            return 0.05
        return valley(p[1], walk) + valley(p[2], pitch) + valley(p[3], roll)

    assert Bench(loss).found.point[1:] == (walk, pitch, roll)


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 2**31), st.integers(1, 2))
def test_the_end_is_never_worse_than_the_start_and_the_effort_is_bounded(
    seed: int, tracks: int
) -> None:
    def loss(run: str, track: int, p: Point) -> float:
        return crc32(repr((seed, run, track, p)).encode()) % 1000 / 1000.0

    bench = Bench(loss, tracks=tracks)
    assert bench.procedure.collective(bench.found.point) <= bench.procedure.collective(START)
    assert len(bench.points) <= MOST
    assert bench.found.rounds <= 3


def test_where_nothing_matters_the_start_stays() -> None:
    bench = Bench(lambda *_: 0.1)
    assert bench.found.point == START
    assert bench.found.rounds == 2
    for which, name in enumerate(TUNED):
        found = bench.found.ranges[name]
        assert (found.lowest, found.highest) == (LEVELS.lowest[which], LEVELS.highest[which])


@pytest.mark.parametrize("which", [1, 2, 3])
def test_what_does_not_matter_stays_where_it_was(which: int) -> None:
    found = Bench(lambda _, __, p: valley(p[which], 7)).found
    assert found.point == tuple(7 if k == which else 0 for k in range(4))


def test_a_start_that_nothing_leads_back_to_is_kept() -> None:
    def loss(run: str, _: int, p: Point) -> float:
        return 0.1 if run == "fast" else 0.02 if p == START else 0.4 + 0.001 * p[1]

    assert Bench(loss, begin=(0, 0, -12, -12)).found.point == START


def test_of_a_better_place_far_away_only_what_matters_is_taken() -> None:
    """From the start, steps of two octaves and less along the pitch gain nothing."""
    found = Bench(lambda _, __, p: 0.05 if p[2] <= -10 else 0.2, begin=(0, 0, -12, -12)).found
    assert found.point == (0, 0, -12, 0)


def test_each_step_goes_on_from_the_lowest_values_of_the_one_before() -> None:
    def loss(run: str, _: int, p: Point) -> float:
        if run in ("fast", "light"):
            return 0.2 if p[1] < -7 or p[1] > 3 else 0.1
        return 0.0 if 2 <= p[2] <= 6 else 0.1

    begin = (0, 0, -12, -12)
    bench = Bench(loss, begin=begin)
    pitched = next(p for p in bench.points if p[2] != begin[2])
    assert pitched[1] == bench.found.ranges[WALK].lowest == -7
    rolled = next(p for p in bench.points if p[3] != begin[3])
    assert rolled[2] == bench.found.ranges[PITCH].lowest == 2


def test_the_same_losses_are_looked_at_in_the_same_order() -> None:
    def loss(_: str, track: int, p: Point) -> float:
        return 0.01 * sum(abs(x - 3 + track) for x in p)

    assert Bench(loss).points == Bench(loss).points


def test_no_harm_at_speed_comes_before_a_gain_at_stops() -> None:
    def loss(run: str, _: int, p: Point) -> float:
        if run in ("fast", "light"):
            return 0.1 + (0.5 if p[0] > 4 or p[1] > -3 else 0.0)
        return 0.02 * (12 - p[1])

    found = Bench(loss).found
    assert found.harmless
    assert found.point[1] == -3
    assert found.ranges[WALK].highest == -3
    assert found.ranges[DENSITY].highest == 4


def test_light_braking_guards_as_well_as_high_speed() -> None:
    def loss(run: str, _: int, p: Point) -> float:
        return 0.1 + (0.5 if run == "light" and p[0] < 2 else 0.0)

    assert Bench(loss).found.ranges[DENSITY].lowest == 2


def test_as_well_as_nominal_allows_for_the_tolerance_alone() -> None:
    within, beyond = (Bench(lambda *_, x=x: 0.1 + x).found for x in (TOLERANCE / 2, 2 * TOLERANCE))
    assert within.harmless
    assert not beyond.harmless
    assert beyond.point == START
    assert DENSITY not in beyond.ranges


@pytest.mark.parametrize(("name", "which", "first"), [(PITCH, 2, 0), (ROLL, 3, 1)])
def test_the_pitch_follows_the_first_wheel_path_and_the_roll_the_last(
    name: str, which: int, first: int
) -> None:
    def loss(_: str, track: int, p: Point) -> float:
        return valley(p[which], 6 if track == first else -6)

    found = Bench(loss).found.ranges[name]
    assert found.lowest == found.highest == 6


@pytest.mark.parametrize(
    ("name", "which", "runs"),
    [(PITCH, 2, ("heavy", "short", "long")), (ROLL, 3, ("slow", "heavy"))],
)
def test_each_walk_is_told_by_its_own_runs(name: str, which: int, runs: tuple[str, ...]) -> None:
    def loss(run: str, _: int, p: Point) -> float:
        return valley(p[which], 5) if run in runs else 0.05

    found = Bench(loss).found.ranges[name]
    assert (found.lowest, found.highest) == (5, 5)
    kinds = {run: kind for run, kind in SIX.items() if run not in runs}
    assert name not in Bench(loss, kinds).found.ranges


@pytest.mark.parametrize(("name", "which", "others"), [(PITCH, 2, "light"), (ROLL, 3, "long")])
def test_what_other_runs_lose_speaks_against_a_value(name: str, which: int, others: str) -> None:
    def loss(run: str, _: int, p: Point) -> float:
        if run == others:
            return 0.5 if p[which] > 0 else 0.05
        return valley(p[which], 8, 0.005)

    assert Bench(loss).found.ranges[name].highest <= 0


def test_walks_of_the_rates_that_are_not_given_begin_at_the_lowest() -> None:
    low = LEVELS.lowest
    assert first_point({}, LEVELS) == (0, 0, low[2], low[3])
    assert first_point({PITCH: 1e-6}, LEVELS) == (0, 0, 0, low[3])
    assert first_point([PITCH, ROLL], LEVELS) == START


def test_where_the_rates_walks_begin_is_where_step_2_looks() -> None:
    begin = (0, 0, -12, -7)
    assert Bench(lambda *_: 0.1, begin=begin).points[0][2:] == begin[2:]


def test_steps_go_on_while_they_gain() -> None:
    """The lowest walk is harmless only once the pitch has been found."""

    def loss(run: str, _: int, p: Point) -> float:
        if run in ("fast", "light"):
            return 0.1 + (0.5 if p[1] < 0 and p[2] < 4 else 0.0)
        return valley(p[2], 6) + 0.01 * (12 + p[1])

    bench = Bench(loss)
    assert bench.found.rounds == 3
    assert bench.found.point[1:3] == (-12, 6)


def test_what_is_worse_than_nominal_counts_twice() -> None:
    """The other runs' gain is smaller than what is lost at high speed, seen twice."""

    def loss(run: str, _: int, p: Point) -> float:
        if run in ("fast", "light"):
            return 0.1 + 0.02 * max(p[1], 0)
        return 0.012 * (12 - p[1])

    bench = Bench(loss)
    step = bench.found.point[1]
    assert (
        bench.procedure.collective(bench.found.point)
        <= min(bench.procedure.collective((0, s, 0, 0)) for s in range(-12, 13)) + 2 * LEAST_GAIN
    )
    assert step <= 0
