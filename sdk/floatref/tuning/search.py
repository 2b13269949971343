"""Searches on steps of half an octave: coarse ones first, then finer, of bounded effort.

A loss may be flat, as it is where the GNSS or the inertial sensors decide alone, and then values
that lose no more than a tolerance are as good as the best: the result is a range, not a number.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from floatref.tuning.levels import Point, move

COARSE = 4
"""Steps between the values that are tried first: two octaves."""
LEAST_GAIN = 1e-3
"""Least improvement that counts: 0.1 % of cross correlation, or of roughness."""
TOLERANCE = 5e-3
"""Values that lose no more than this against the best are as good."""


@dataclass(frozen=True)
class Range:
    """Steps of one setting, both ends included, that are as good as the best."""

    lowest: int
    highest: int


def best_range(lowest: int, highest: int, loss: Callable[[int], float]) -> Range:
    """Return the steps around the best one that lose no more than `TOLERANCE` against it.

    ``loss`` is calculated at every fourth step, then around the lowest, then towards both ends of
    the range, where it should rise.
    """
    coarse = _coarse(lowest, highest)
    best = min(coarse, key=lambda step: (loss(step), step))
    for width in (COARSE // 2, COARSE // 4):
        around = [s for s in (best, best - width, best + width) if lowest <= s <= highest]
        best = min(around, key=loss)
    limit = loss(best) + TOLERANCE

    def good(step: int) -> bool:
        return loss(step) <= limit

    below = [s for s in reversed(coarse) if s < best]
    above = [s for s in coarse if s > best]
    return Range(_edge(best, below, good), _edge(best, above, good))


def lowest_good(
    lowest: tuple[int, int], highest: tuple[int, int], good: Callable[[int, int], bool]
) -> tuple[int, int] | None:
    """Return the pair of steps with the lowest sum that is ``good``; None if no coarse pair is.

    Pairs of every fourth step are tried in the order of their sums, then finer ones below.
    """
    grids = [_coarse(low, high) for low, high in zip(lowest, highest, strict=True)]
    pairs = sorted(((a, b) for a in grids[0] for b in grids[1]), key=lambda pair: (sum(pair), pair))
    found = next((pair for pair in pairs if good(*pair)), None)
    if found is None:
        return None
    a, b = found
    for width in (COARSE // 2, COARSE // 4):
        if a - width >= lowest[0] and good(a - width, b):
            a -= width
        if b - width >= lowest[1] and good(a, b - width):
            b -= width
    return a, b


def good_range(at: int, lowest: int, highest: int, good: Callable[[int], bool]) -> Range:
    """Return the unbroken range of ``good`` steps around ``at``, which is good."""
    below, above = (
        range(at - COARSE, lowest - COARSE, -COARSE),
        range(at + COARSE, highest + COARSE, COARSE),
    )
    return Range(
        _edge(at, [max(step, lowest) for step in below], good),
        _edge(at, [min(step, highest) for step in above], good),
    )


def climb(
    point: Point,
    free: tuple[int, ...],
    lowest: Point,
    highest: Point,
    loss: Callable[[Point], float],
    most: int,
) -> Point:
    """Return the best of the points reached from ``point`` in steps along the ``free`` settings.

    Steps are of two octaves, then one, then half an octave; each has to gain `LEAST_GAIN`. At most
    ``most`` points are tried.
    """
    best, known = loss(point), 1
    for width in (COARSE, COARSE // 2, COARSE // 4):
        gained = True
        while gained:
            gained = False
            for there in _around(point, free, width, lowest, highest):
                if known >= most:
                    return point
                found, known = loss(there), known + 1
                if found < best - LEAST_GAIN:
                    point, best, gained = there, found, True
                    break
    return point


def _around(
    point: Point, free: tuple[int, ...], width: int, lowest: Point, highest: Point
) -> Iterator[Point]:
    for which in free:
        for step in (point[which] - width, point[which] + width):
            if lowest[which] <= step <= highest[which]:
                yield move(point, which, step)


def _coarse(lowest: int, highest: int) -> list[int]:
    """Return every fourth step, zero among them, and both ends."""
    first = lowest + (-lowest) % COARSE
    return sorted({lowest, *range(first, highest + 1, COARSE), highest})


def _edge(inside: int, outwards: list[int], good: Callable[[int], bool]) -> int:
    """Return the farthest good step from ``inside``, itself good, through ``outwards``."""
    for outer in outwards:
        if not good(outer):
            return _halve(inside, outer, good)
        inside = outer
    return inside


def _halve(inside: int, outside: int, good: Callable[[int], bool]) -> int:
    """Return the farthest good step between one that is good and one that is not."""
    while abs(outside - inside) > 1:
        middle = (inside + outside) // 2
        inside, outside = (middle, outside) if good(middle) else (inside, middle)
    return inside
