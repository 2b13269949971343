"""Matching the pulses of two trains, each timed by a clock of its own (4.4).

Pulses of either train may be missing or false, and a train may begin earlier and end later. The
pattern of the intervals around a few pulses locates them in the other train; from there the trains
are followed both ways.
"""

from bisect import bisect_left
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.measures.clocks.pulse_pattern import (
    FASTEST_DRIFT,
    NEIGHBOURS,
    Fits,
    fit_pattern,
)
from floatref.values.arrays import FloatArray, IndexArray

JITTER_SHARE, MOST_JITTER_S = 0.05, 0.02
"""Largest error of a pulse as a share of the usual interval, and in s."""
ANCHORS = 12
"""Number of anchor pulses; nearly twice as many where no anchor fits."""
GOOD = 0.6
"""Fit of a place relative to the best one, above which the two are ambiguous."""
FEW, CHANCE = 10, 1e-3
"""From this number of pulses on, a place is one that less than this share of strangers have."""
LEAST_FIT, CLEAR = 0.2, 0.4
"""Or else, in trains that repeat, the least share of the pulses about one that fit; from which
share on no evidence is asked for."""
LEAST_SHARE = 0.35
"""Least share of the pulses in the common time that are found in both trains."""
IN_A_ROW = 12
"""Unmatched pulses in a row from which on the clocks are taken to have jumped there."""
UNSURE = 0.4
"""Largest distance of a shift from the stated one, as a share of a period."""
FOLLOWED = 7
"""Pulses whose median predicts the next one."""


class Matching(NamedTuple):
    """Indices of the same pulses in both trains, each of shape (pairs,), and lines about them."""

    own: IndexArray
    base: IndexArray
    warnings: tuple[str, ...]


def match_pulses(own_s: FloatArray, base_s: FloatArray, near_s: float = 0.0) -> Matching:
    """Return the matching of the pulses at ``own_s`` and at ``base_s``, both increasing, in s.

    ``near_s`` is about what base time less own time is when both begin; it decides between shifts
    where the trains are periodic, with a warning. Raises InputError if the trains have nothing in
    common, or if two shifts lie equally near.
    """
    own, base = _train(own_s, "this clock"), _train(base_s, "the base clock")
    jitter = min(MOST_JITTER_S, JITTER_SHARE * min(_interval(own), _interval(base)))
    places = _places(own, base, jitter)
    chosen, warnings = _nearest(base[places.base] - own[places.own], places.own, near_s, 3 * jitter)
    anchor, at = int(places.own[chosen]), int(places.base[chosen])
    pairs = _follow_both_ways(own, base, anchor, at, jitter)
    _check_share(own, base, pairs)
    mine, others = np.array(pairs, np.int64).T
    return Matching(mine, others, (*warnings, *_warn_of_jump(own, base, mine, others)))


def _train(times_s: FloatArray, whose: str) -> FloatArray:
    """Return the times as float64; InputError unless there are some, finite and increasing."""
    times = np.asarray(times_s, dtype=np.float64)
    if times.ndim != 1 or times.size == 0:
        raise InputError(f"{whose} has no pulses; name the channel that holds them, or an offset")
    if not np.isfinite(times).all() or (np.diff(times) <= 0).any():
        raise InputError(f"the pulses of {whose} are not at increasing times in s; sort them")
    return times


def _interval(times: FloatArray) -> float:
    return float(np.median(np.diff(times))) if times.size > 1 else np.inf


def _anchors(count: int) -> IndexArray:
    most = min(2 * ANCHORS - 1, count)
    return np.unique(np.linspace(0, count - 1, most).round().astype(np.int64))


def _places(own: FloatArray, base: FloatArray, jitter: float) -> Matching:
    """Return pairs that fit well: the first few such pulses of ``own``, and their possible places.

    Later ones would fit as well, at a shift that drift has changed.
    """
    found, needed = _search(own, base, jitter)
    best = max(float(each.share_beyond(needed).max()) for each in found.values())
    first = min(i for i in found if found[i].share_beyond(needed).max() >= GOOD * best)
    mine, others = [], []
    for i in range(first, min(first + FOLLOWED, own.size)):
        share = fit_pattern(own, base, i, jitter).share_beyond(needed)
        there = np.flatnonzero(share >= GOOD * best)
        mine.append(np.full(there.size, i))
        others.append(there)
    return Matching(np.concatenate(mine), np.concatenate(others), ())


def _search(own: FloatArray, base: FloatArray, jitter: float) -> tuple[dict[int, Fits], float]:
    """Return how the pattern about each anchor fits, and the evidence that a place needs."""
    anchors, needed = _anchors(own.size), 0.0
    if own.size >= FEW:
        needed = float(np.log(2 * anchors.size * base.size / CHANCE))
    least = min(own.size, base.size, 2) / min(own.size, 2 * NEIGHBOURS + 1)
    least = max(least, LEAST_FIT) if own.size >= FEW else least
    found = {int(i): fit_pattern(own, base, int(i), jitter) for i in anchors[::2]}
    share = max(float(each.share.max()) for each in found.values())
    if share >= max(CLEAR, least):
        return found, 0.0
    # Every second pulse is nearly always enough.
    for part in ((), anchors[1::2]):
        found |= {int(i): fit_pattern(own, base, int(i), jitter) for i in part}
        if max(float(each.evidence.max()) for each in found.values()) > needed:
            return found, needed
    if share < least - 1e-9:
        raise InputError(_nothing(own, base, "no pattern of intervals is the same in both"))
    return found, 0.0


def _nearest(
    shifts: FloatArray, pulses: IndexArray, near_s: float, alike_s: float
) -> tuple[int, tuple[str, ...]]:
    """Return which of the ``shifts`` in s lies nearest to ``near_s``, and warnings.

    ``pulses`` are the pulses of the shifts: two shifts of one pulse are two places, unless they
    differ by less than ``alike_s``.
    """
    chosen = int(np.argmin(np.abs(shifts - near_s)))
    first = float(shifts[chosen])
    same = np.sort(shifts[pulses == pulses[chosen]])
    others = same[np.abs(same - first) > alike_s]
    if others.size == 0:
        return chosen, ()
    second = float(others[np.argmin(np.abs(others - near_s))])
    gaps = np.diff(same)
    period = float(gaps[gaps > alike_s].min())
    if abs(first - near_s) > UNSURE * period and (first - near_s) * (second - near_s) < 0:
        raise InputError(
            f"the pulses fit with a shift of {first:.6g} s as well as of {second:.6g} s, and "
            f"{near_s:g} s lies between them; state an offset within {UNSURE * period:.3g} s"
        )
    return chosen, (
        f"the pulses repeat every {period:.3g} s; of the shifts that fit, {first:.6g} s was taken, "
        f"as the nearest to {near_s:g} s",
    )


def _follow_both_ways(
    own: FloatArray, base: FloatArray, anchor: int, at: int, jitter: float
) -> list[tuple[int, int]]:
    """Return the pairs of indices in order, followed from one pair both ways."""
    onward = _follow(own, base, anchor, at, jitter)
    back = _follow(-own[::-1], -base[::-1], own.size - 1 - anchor, base.size - 1 - at, jitter)
    before = [(own.size - 1 - i, base.size - 1 - j) for i, j in reversed(back[1:])]
    return before + onward


def _follow(
    own: FloatArray, base: FloatArray, anchor: int, at: int, jitter: float
) -> list[tuple[int, int]]:
    """Return the pairs from (``anchor``, ``at``) onward."""
    usual = _interval(own) if own.size > 1 else 0.0
    mine, others = own.tolist(), base.tolist()
    pairs, recent = [(anchor, at)], [others[at] - mine[anchor]]
    for i in range(anchor + 1, own.size):
        shift = sorted(recent)[len(recent) // 2]
        gap = mine[i] - mine[pairs[-1][0]] + FOLLOWED * usual
        j = _at(others, mine[i] + shift, pairs[-1][1] + 1)
        if j < len(others) and abs(others[j] - mine[i] - shift) <= jitter + FASTEST_DRIFT * gap:
            pairs.append((i, j))
            recent = [*recent[1 - FOLLOWED :], others[j] - mine[i]]
    return pairs


def _at(times: list[float], near: float, first: int) -> int:
    """Return the index from ``first`` on of the time nearest to ``near``."""
    after = bisect_left(times, near, first)
    if first < after < len(times):
        return after - 1 if near - times[after - 1] <= times[after] - near else after
    return after - 1 if after == len(times) and after > first else after


def _check_share(own: FloatArray, base: FloatArray, pairs: list[tuple[int, int]]) -> None:
    """Refuse trains with too few matched pulses in their common time."""
    shift = base[pairs[0][1]] - own[pairs[0][0]]
    begin, end = max(own[0] + shift, base[0]), min(own[-1] + shift, base[-1])
    there = min(np.count_nonzero((x >= begin) & (x <= end)) for x in (own + shift, base))
    if len(pairs) < LEAST_SHARE * there:
        found = f"only {len(pairs)} of {there} pulses in their common time match"
        raise InputError(_nothing(own, base, found))


def _warn_of_jump(
    own: FloatArray, base: FloatArray, mine: IndexArray, others: IndexArray
) -> tuple[str, ...]:
    """Return a warning if many pulses in a row have no match in the common time of both trains."""
    before, behind = base[others[0]] - own[mine[0]], base[others[-1]] - own[mine[-1]]
    begin, end = max(own[0], base[0] - before), min(own[-1], base[-1] - behind)
    at = np.concatenate([[begin], own[mine], [end]])
    to = np.concatenate([[begin + before], base[others], [end + behind]])
    lonely = np.minimum(*(np.diff(np.searchsorted(x, t)) for x, t in ((own, at), (base, to))))
    k = int(lonely.argmax())
    if lonely[k] <= IN_A_ROW:
        return ()
    return (
        f"{lonely[k]} pulses in a row, from {at[k]:.6g} to {at[k + 1]:.6g} s of this clock, have "
        "no match on the base clock: one of the clocks was set, or pulses are false",
    )


def _nothing(own: FloatArray, base: FloatArray, found: str) -> str:
    return (
        f"{own.size} pulses of this clock and {base.size} of the base clock do not match"
        f": {found}; check the channels, or state an offset"
    )
