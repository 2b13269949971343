"""The place of a run: units, direction, wheel paths and offset tried until the road is found."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from floatref.measures.locating.candidates import (
    APART_M,
    SURE_SCORE,
    Candidate,
    Piece,
    chance,
    pairings,
    scales_of,
    search,
)
from floatref.measures.locating.profile_units import DISTANCE_UNITS
from floatref.measures.locating.slopes import Slope, align, slope_of
from floatref.values.profile import Profile

PIECE_M = 160.0
"""Length of the pieces of the reference that are searched for."""
MOST_PIECES = 6
COARSEST_M, FINEST_M = 1.0, 1e-3
"""Intervals beyond these are not those of a profile, in any unit."""
USUAL_M = 0.005, 0.31
"""Intervals that profiles have; units that give others are tried later."""
SHORTEST_M = 20.0
"""A run shorter than this, in any unit, cannot be found."""


@dataclass(frozen=True)
class Find:
    """A candidate, the unit of distance in which it was found, and how many places fit as well."""

    candidate: Candidate
    unit: str
    others: int


def pieces_of(reference: Profile) -> list[Piece]:
    """Return the pieces of ``reference`` in the order of search; empty if it is flat."""
    slopes = [slope_of(t, reference.start_m, reference.interval_m) for t in reference.tracks]
    shaped = [s for s in slopes if s is not None and s.energy() > 0]
    if len(shaped) < len(slopes) or not shaped:
        return []
    together = align(shaped)
    start, end = together[0].start_m, together[0].end_m
    count = max(math.ceil((end - start) / PIECE_M), 1)
    length = (end - start) / count
    order = range(count) if count <= MOST_PIECES else _spread_over(count)
    return [Piece(start + n * length, start + (n + 1) * length, together) for n in order]


def _spread_over(count: int) -> list[int]:
    """Return `MOST_PIECES` of ``count`` pieces, evenly from the first to the last."""
    return [round(n * (count - 1) / (MOST_PIECES - 1)) for n in range(MOST_PIECES)]


def find(pieces: Sequence[Piece], run: Profile) -> Find | None:
    """Return the best place of ``pieces`` in ``run``; None if nothing could be tried."""
    best: Find | None = None
    for trial in _trials(pieces, run):
        best = trial if best is None or _merit(trial) > _merit(best) else best
        if best.candidate.found and abs(best.candidate.score) >= SURE_SCORE:
            break
    return best


def _merit(find: Find) -> float:
    """Return by how much a find is better than chance."""
    return abs(find.candidate.score) / find.candidate.needed


def _trials(pieces: Sequence[Piece], run: Profile) -> Iterator[Find]:
    """Yield the best place of every piece in every unit of distance, likely ones first."""
    likely = sorted(DISTANCE_UNITS.items(), key=lambda item: _oddity(run.interval_m * item[1]))
    for unit, factor in likely:
        slopes = _slopes_in(run, factor)
        for piece in pieces if slopes else ():
            yield from _try_piece(piece, slopes, unit)


def _oddity(interval_m: float) -> float:
    """Return by what an interval is unusual, 0 for a usual one."""
    low, high = USUAL_M
    return max(math.log(low / interval_m), math.log(interval_m / high), 0.0)


def _slopes_in(run: Profile, factor: float) -> tuple[Slope, ...]:
    """Return the slopes of ``run``, one axis unit being ``factor`` m; empty if absurd."""
    interval = run.interval_m * factor
    if not FINEST_M <= interval <= COARSEST_M or run.length_m * factor < SHORTEST_M:
        return ()
    slopes = [slope_of(t, run.start_m * factor, interval) for t in run.tracks]
    known = [s if s is not None and s.energy() > 0 else None for s in slopes]
    if not any(known):
        return ()
    some = next(s for s in known if s is not None)
    nothing = np.zeros(some.values.size)
    blank = replace(some, values=nothing, measured=nothing > 0)
    return align([s or blank for s in known])


def _try_piece(piece: Piece, slopes: Sequence[Slope], unit: str) -> Iterator[Find]:
    """Yield the best place of ``piece``."""
    scales = scales_of(piece.end_m - piece.start_m)
    ways = 2 * len(pairings(len(piece.slopes), len(slopes))) * len(scales)
    needed = chance(piece, [slopes[0].end_m - slopes[0].start_m], ways)
    found = search(piece, slopes, scales, (False, True), piece.middle_m)
    if found:
        yield Find(replace(found[0], needed=needed), unit, _other_places(found))


def _other_places(found: Sequence[Candidate]) -> int:
    """Return the number of places of ``found`` beside the first; a near scale is no other place."""
    places: list[float] = []
    for c in found:
        if all(abs(c.run_m - place) > APART_M for place in places):
            places.append(c.run_m)
    return len(places) - 1


def find_forward(pieces: Sequence[Piece], slopes: Sequence[Slope]) -> Candidate | None:
    """Return the best place of ``pieces`` in a run in m, driven forward; None if it is chance."""
    best: Candidate | None = None
    for piece in pieces:
        scales = scales_of(piece.end_m - piece.start_m)
        needed = chance(piece, [slopes[0].end_m - slopes[0].start_m], len(scales))
        for c in search(piece, slopes, scales, (False,), piece.middle_m)[:1]:
            if best is None or abs(c.score) / needed > abs(best.score) / best.needed:
                best = replace(c, needed=needed)
        if best is not None and abs(best.score) >= SURE_SCORE:
            break
    return best if best is not None and best.found else None
