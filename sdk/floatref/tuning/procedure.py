"""The procedure of section 6.4.4: do no harm at speed, then braking and stops, then low speed."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field

from floatref.tuning.levels import START, TUNED, Levels, Point, move
from floatref.tuning.preliminary_runs import STOPS, Kind
from floatref.tuning.search import (
    LEAST_GAIN,
    TOLERANCE,
    Range,
    best_range,
    climb,
    good_range,
    lowest_good,
)

DENSITY, WALK, PITCH, ROLL = range(len(TUNED))
PRIORITY = 2.0
"""Weight of the preferred wheel path relative to another one."""
ROUNDS = 3
"""Most repetitions of steps 2 to 4."""
MOST_CLIMBED = 40
"""Combinations that step 6 tries from either of its starting points."""
MOST = 850
"""Most combinations of values that a tuning tries."""

Losses = Mapping[str, Sequence[float]]
"""Of every wheel path of the runs, by the runs' names."""
Evaluate = Callable[[Point, Sequence[str]], Losses]


@dataclass(frozen=True)
class Found:
    """The result of the search.

    Attributes:
        point: the values that do best.
        ranges: of the settings, steps that were as good in steps 2 to 4, where runs determine them.
        rounds: number of repetitions of these steps.
        harmless: whether any values did no harm at high speed and in light braking.
    """

    point: Point
    ranges: Mapping[str, Range]
    rounds: int
    harmless: bool


@dataclass
class Procedure:
    """One tuning: its runs, their losses, and the result so far.

    Attributes:
        kinds: of the runs by name, one at high speed among them.
        nominal: losses of the nominal profiler.
        levels: the values that may be tried.
        evaluate: gives the losses of the runs asked for at a point.
        begin: where step 1 puts the walks of the rates: what sensors at rest showed, else lowest.
        tell: is called with each step.
    """

    kinds: Mapping[str, Kind]
    nominal: Losses
    levels: Levels
    evaluate: Evaluate
    begin: Point
    tell: Callable[[str], None] = field(default=lambda _: None)
    ranges: dict[str, Range] = field(default_factory=dict)
    harmless: bool = True

    def search(self) -> Found:
        """Do steps 2 to 6 and return the best of their results.

        The start is returned if nothing is better, and each value without influence is unchanged.
        """
        point, total, rounds = self.begin, float("inf"), 0
        for number in range(ROUNDS):
            there = self._low_speed(self._braking(self._no_harm(point)))
            found = self.collective(there)
            rounds = number + 1
            if found > total - LEAST_GAIN:
                break
            point, total = there, found
        self.tell("Step 6: the three walks together")
        best = self._climb(START)
        other = self._climb(point)
        if self.collective(other) < self.collective(best) - LEAST_GAIN:
            best = other
        return Found(self._restore(best), dict(self.ranges), rounds, self.harmless)

    def collective(self, point: Point) -> float:
        """Return the mean loss of all runs, plus the harm against nominal at speed."""
        return self._mean(point, self._all) + max(self._harm(point) - TOLERANCE, 0.0)

    def _no_harm(self, point: Point) -> Point:
        """Step 2: the lowest accelerations that are as good as nominal, at speed and braking."""
        self.tell("Step 2: no harm at high speed and in light braking")

        def good(density: int, walk: int) -> bool:
            return self._harm(move(move(point, DENSITY, density), WALK, walk)) <= TOLERANCE

        low, high = self.levels.lowest, self.levels.highest
        pair = lowest_good((low[DENSITY], low[WALK]), (high[DENSITY], high[WALK]), good)
        self.harmless = pair is not None
        if pair is None:
            return move(move(point, DENSITY, START[DENSITY]), WALK, START[WALK])
        density, walk = pair
        self.ranges[TUNED[DENSITY]] = good_range(
            density, low[DENSITY], high[DENSITY], lambda step: good(step, walk)
        )
        self.ranges[TUNED[WALK]] = good_range(
            walk, low[WALK], high[WALK], lambda step: good(density, step)
        )
        return move(move(point, DENSITY, density), WALK, walk)

    def _braking(self, point: Point) -> Point:
        """Step 3: the walk of the pitch rate for heavy braking and stops, left side first."""
        self.tell("Step 3: pitch rate walk, heavy braking and stops")
        return self._lowest_best(point, PITCH, self._of(Kind.HEAVY, *STOPS), self._guarded, 0)

    def _low_speed(self, point: Point) -> Point:
        """Step 4: the walk of the roll rate for low speed and heavy braking, right side first."""
        self.tell("Step 4: roll rate walk, low speed and heavy braking")
        runs = self._of(Kind.LOW, Kind.HEAVY)
        others = [name for name in self._all if name not in runs]
        return self._lowest_best(point, ROLL, runs, others, -1)

    def _lowest_best(
        self, point: Point, which: int, runs: list[str], others: list[str], favoured: int
    ) -> Point:
        """Return ``point`` with setting ``which`` at the lowest step that is best for ``runs``.

        The losses of ``others`` against ``point`` count as well.
        """
        if not runs:
            return point
        before = self._each(point, others)

        def loss(step: int) -> float:
            there = move(point, which, step)
            worse = [
                max(a - b, 0.0) for a, b in zip(self._each(there, others), before, strict=True)
            ]
            return self._mean(there, runs, favoured) + (sum(worse) / len(worse) if worse else 0.0)

        found = best_range(self.levels.lowest[which], self.levels.highest[which], loss)
        self.ranges[TUNED[which]] = found
        return move(point, which, found.lowest)

    def _climb(self, point: Point) -> Point:
        free = (WALK, PITCH, ROLL)
        low, high = self.levels.lowest, self.levels.highest
        return climb(point, free, low, high, self.collective, MOST_CLIMBED)

    def _restore(self, point: Point) -> Point:
        """Return ``point`` with every setting at its start where that loses nothing."""
        limit = self.collective(point) + LEAST_GAIN
        for which, step in enumerate(START):
            there = move(point, which, step)
            if self.collective(there) <= limit:
                point = there
        return point

    def _harm(self, point: Point) -> float:
        """Return by how much the worst of the runs of step 2 is worse than nominal."""
        found = self._each(point, self._guarded)
        nominal = [_weigh(self.nominal[name]) for name in self._guarded]
        return max(a - b for a, b in zip(found, nominal, strict=True))

    def _mean(self, point: Point, runs: Sequence[str], favoured: int | None = None) -> float:
        return sum(self._each(point, runs, favoured)) / len(runs)

    def _each(self, point: Point, runs: Sequence[str], favoured: int | None = None) -> list[float]:
        losses = self.evaluate(point, runs) if runs else {}
        return [_weigh(losses[name], favoured) for name in runs]

    @property
    def _all(self) -> list[str]:
        return list(self.kinds)

    @property
    def _guarded(self) -> list[str]:
        return self._of(Kind.HIGH, Kind.LIGHT)

    def _of(self, *kinds: Kind) -> list[str]:
        return [name for name, kind in self.kinds.items() if kind in kinds]


def first_point(given: Collection[str], levels: Levels) -> Point:
    """Step 1: the walks of the rates that sensors at rest showed, else the lowest."""
    point = START
    for which in (PITCH, ROLL):
        point = point if TUNED[which] in given else move(point, which, levels.lowest[which])
    return point


def _weigh(losses: Sequence[float], favoured: int | None = None) -> float:
    """Return the mean over the wheel paths, that of number ``favoured`` counting more."""
    weights = [1.0] * len(losses)
    if favoured is not None:
        weights[favoured] = PRIORITY
    return sum(w * x for w, x in zip(weights, losses, strict=True)) / sum(weights)
