"""A run recognised on the reference's road in any units, direction, names and offset."""

import math
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures.locating.candidates import Candidate
from floatref.measures.locating.finding import PIECE_M, Find, find, pieces_of
from floatref.measures.locating.lags import Line, common_score, follow_line, gain, window_lags
from floatref.measures.locating.placement import (
    COVERED_M,
    Placement,
    add_sentences,
    apply_placement,
    not_found,
)
from floatref.measures.locating.profile_units import (
    DISTANCE_UNITS,
    HEIGHT_UNITS,
    METRE,
    height_unit,
)
from floatref.measures.locating.slopes import slope_of
from floatref.measures.roughness.path_signals import path_agreement
from floatref.values.profile import Profile

MAX_OFFSET_M = 1.0
"""A run that lies within this of its place lies right: the comparison finds its offset."""
LIES_RIGHT = 0.9
"""Correlation from which on a run that lies right is not searched for anywhere else."""
SAME_HEIGHT = 1.3
"""Largest ratio of heights that no unit need explain."""
SURE = 0.5
"""Least correlation of slope, over all that both have in common, at a place that is sure."""

__all__ = ["Placement", "apply_placement", "place"]


def place(reference: Profile, run: Profile) -> Placement:
    """Return how ``run`` lies against ``reference``, whose stretch is the section.

    A run within ±1 m of its place, with the reference's names and units, has nothing to be done
    to it. Of places that fit equally well the one nearest to no offset is taken. A place counts
    only if the correlation of slope reaches `SURE` there, along the line of the run's lag: over
    all that both have in common, or over the piece of the reference by which it was found, since
    an encoder that leaps parts the run from that line elsewhere.
    """
    names = {t.name: t.name for t in reference.tracks}
    least = _agreement_as_given(reference, run)
    if least >= LIES_RIGHT:
        return Placement(True, least, tracks=names)
    pieces = pieces_of(reference)
    best = find(pieces, run)
    if best is None or not best.candidate.found:
        return Placement(False, _score(best), not_found(best, bool(pieces)))
    placement, score = _refine(reference, run, best)
    if max(score, abs(best.candidate.score)) < SURE:
        return Placement(False, _score(best), not_found(_needing(best, SURE), True))
    return add_sentences(reference, run, placement)


def _agreement_as_given(reference: Profile, run: Profile) -> float:
    """Return the least correlation of the wheel paths, 0 where anything has to be done first."""
    try:
        # Points of the reference that the run ends before are missing.
        begin_m = max(reference.start_m, run.start_m)
        end_m = min(reference.start_m + reference.length_m, run.start_m + run.length_m)
        if end_m - begin_m < reference.length_m - COVERED_M:
            return 0.0
        least = 1.0
        for track in reference.tracks:
            agreed = path_agreement(reference, run, track.name, "iri", MAX_OFFSET_M)
            like = agreed.amplitude_factor >= 1.0 / SAME_HEIGHT
            least = min(least, agreed.correlation if like else 0.0)
    except InputError:
        return 0.0
    return least


def _score(best: Find | None) -> float:
    """Return the score of the best find, NaN without one."""
    return math.nan if best is None else abs(best.candidate.score)


def _needing(best: Find, needed: float) -> Find:
    """Return ``best`` with ``needed`` as the score that it takes to be sure."""
    return replace(best, candidate=replace(best.candidate, needed=needed))


@dataclass(frozen=True)
class _Followed:
    """The line of one wheel path, its correlations along it, and the gain of its heights.

    ``correlation`` is the median of windows that may each lie a little off the line, ``score``
    that of `common_score`.
    """

    line: Line
    correlation: float
    gain: float
    score: float


def _refine(reference: Profile, run: Profile, best: Find) -> tuple[Placement, float]:
    """Return the placement of the find ``best``, its offset by all of the section, and its score.

    The score is that of the best wheel path: another may have measured nothing.
    """
    c = best.candidate
    turned = Placement(
        True,
        abs(c.score),
        tracks={reference.tracks[i].name: run.tracks[j].name for i, j in c.pairing},
        reversed=c.mirrored,
        inverted=c.score < 0,
        distance_unit=best.unit,
        distance_factor=DISTANCE_UNITS[best.unit],
        alternatives=best.others,
    )
    forward = apply_placement(run, turned)
    line, sign = _line(c, forward), math.copysign(1.0, c.score)
    names = list(turned.tracks)
    known = [_follow(reference, forward, name, line, sign) for name in names]
    surest = max(known, key=lambda k: k.correlation)
    gains = [abs(k.gain) for k in known if math.isfinite(k.gain)]
    amount = float(np.median(gains)) if gains else math.nan
    unit = height_unit(amount) or METRE
    placement = replace(
        turned,
        correlation=surest.correlation,
        height_unit=unit,
        height_factor=HEIGHT_UNITS[unit],
        height_gain=amount * HEIGHT_UNITS[unit],
        offset_m=_offset(surest.line, reference),
        distance_scale=surest.line.scale,
        path_correlations={
            n: max(k.correlation, k.score) for n, k in zip(names, known, strict=True)
        },
    )
    return placement, max(k.score for k in known)


def _line(candidate: Candidate, forward: Profile) -> Line:
    """Return the line of ``candidate`` on the axis of the run, driven forward."""
    ends = 2.0 * forward.start_m + forward.length_m
    there = ends - candidate.run_m if candidate.mirrored else candidate.run_m
    return Line(candidate.at_m, there, candidate.scale)


def _follow(reference: Profile, forward: Profile, name: str, line: Line, sign: float) -> _Followed:
    """Return how the wheel path ``name`` lies, from ``line`` on; correlation 0 without a shape."""
    p = slope_of(reference.track(name), reference.start_m, reference.interval_m)
    q = slope_of(forward.track(name), forward.start_m, forward.interval_m)
    if p is None or q is None:
        return _Followed(line, 0.0, math.nan, 0.0)
    line = follow_line(p, q, line, sign)
    scores = window_lags(p, q, line, sign).correlation
    covered = scores[scores != 0.0]
    median = float(np.median(covered)) if covered.size else 0.0
    whole_m = min(PIECE_M, reference.length_m)
    return _Followed(line, median, gain(p, q, line, sign), sign * common_score(p, q, line, whole_m))


def _offset(line: Line, reference: Profile) -> float:
    """Return by how much the run has to be moved, in m: 0 where `MAX_OFFSET_M` does.

    With an error of distance the lag at the beginning of the section counts.
    """
    lags = [line.lag_at(reference.start_m + d) for d in (0.0, reference.length_m)]
    if min(lags) <= MAX_OFFSET_M and max(lags) >= -MAX_OFFSET_M:
        return 0.0
    return round(lags[0], 3)
