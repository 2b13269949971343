"""Why a run does not agree with the reference: each error undone, and correlated again."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from floatref.measures.locating.lags import Line
from floatref.measures.locating.placing import MAX_OFFSET_M
from floatref.values.profile import Profile
from floatref_conformance.certify.fitting.fit import Fit
from floatref_conformance.certify.judging.contents import Cause
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.undoing import Compared, compare_track, find_unusable

LEAST_MISSING_M = 1.0
DISTANCE_PERCENT, HEIGHT_PERCENT, LONG_WAVE_PERCENT, CORRELATION = 0.15, 1.0, 5.0, 0.92
"""Errors, and the least correlation, that count where a worksheet sets no limits."""
LEAST_EXPLAINED = 0.1
"""An error within the limits is named only for a run below the limits, from this share on."""
LEAST_LONG_PERCENT = 10.0
SKEW = "height sensor and accelerometer not of one moment or place"
CERTAIN = 3.0
"""Differences between waves count beyond this number of sigma."""


@dataclass(frozen=True)
class _Suspect:
    """A cause, what remains to compare once it is undone, and whether it counts in any case."""

    id: str
    text: str
    undone: Compared | None
    certain: bool


def causes(
    reference: Profile,
    run: Profile,
    track: str,
    fit: Fit,
    limits: CertificationLimits | None = None,
) -> tuple[Cause, ...]:
    """Return why ``track`` of ``run`` does not agree with ``reference``; empty if nothing is wrong.

    Ids are not-this-road, inverted, offset, distance, missing, height-scale, short-waves, skew,
    long-waves, wander and noise. They are undone in this order, each after those before it, so that
    what they explain adds up; the largest comes first. Both profiles are in m, on the section
    alone.
    """
    before = compare_track(reference, run, track).correlation()
    if not fit.found:
        return (Cause("not-this-road", "not this road", math.nan),)
    wanted = limits or CertificationLimits()
    least = [c for c in (wanted.accuracy, wanted.repeatability) if c is not None]
    lost, poor = 1.0 - before, not before >= max(least, default=CORRELATION)
    found, score = [], before
    for suspect in _suspects(reference, run, track, fit, wanted):
        after = suspect.undone.correlation() if suspect.undone is not None else math.nan
        explains = _share(after - score, lost)
        if suspect.certain or (poor and explains >= LEAST_EXPLAINED):
            found.append(Cause(suspect.id, suspect.text, explains))
        score = score if math.isnan(after) else after
    if poor:
        found += _incoherent(score, lost, fit)
    return tuple(sorted(found, key=_rank))


def _suspects(
    reference: Profile, run: Profile, track: str, fit: Fit, limits: CertificationLimits
) -> Iterator[_Suspect]:
    """Yield what may be wrong, each undone after those before it."""
    assert fit.line is not None
    upright = -1.0 if fit.inverted else 1.0
    now = compare_track(reference, run, track).scale(upright)
    if fit.inverted:
        yield _Suspect("inverted", "heights upside down", now, True)
    for suspect, undoing in _displacements(reference, fit, limits):
        now = compare_track(reference, run, track, undoing).scale(upright)
        yield replace(suspect, undone=now)
    out = find_unusable(reference, run, track, fit.line)
    if out.sum() * reference.interval_m >= LEAST_MISSING_M:
        now = now.without(out)
        share = f"{out.sum() * reference.interval_m:.1f} m of {reference.length_m:.1f} m"
        yield _Suspect("missing", f"{share} missing or not valid", now, False)
    yield from _heights(now, fit, limits)


def _displacements(
    reference: Profile, fit: Fit, limits: CertificationLimits
) -> Iterator[tuple[_Suspect, Line]]:
    """Yield errors of the axis, each with the line that undoes it."""
    assert fit.line is not None
    start, line = reference.start_m, fit.line
    lags = line.lag_at(start), line.lag_at(start + reference.length_m)
    apart = min(lags) > MAX_OFFSET_M or max(lags) < -MAX_OFFSET_M
    if apart:
        way = "farther along" if lags[0] > 0 else "earlier"
        moved = Line(start, start + lags[0], 1.0)
        yield _Suspect("offset", f"{abs(lags[0]):.2f} m {way}", None, True), moved
    percent, sigma = fit.distance_percent, fit.distance_sigma
    if abs(percent) > 2.0 * sigma:
        limit = limits.distance_percent
        certain = abs(percent) - 2.0 * sigma > (DISTANCE_PERCENT if limit is None else limit)
        way = "long" if percent > 0 else "short"
        text = f"distance {abs(percent):.2f} % too {way}"
        kept = 0.0 if apart else lags[0]
        yield _Suspect("distance", text, None, certain), replace(line, at_m=line.at_m + kept)


def _heights(now: Compared, fit: Fit, limits: CertificationLimits) -> Iterator[_Suspect]:
    """Yield errors of heights, of all waves and of some."""
    percent, sigma = fit.height_percent, fit.height_sigma
    if abs(percent) > 2.0 * sigma:
        limit = limits.height_percent
        certain = abs(percent) - 2.0 * sigma > (HEIGHT_PERCENT if limit is None else limit)
        way = "high" if percent > 0 else "low"
        now = now.scale(1.0 + percent / 100.0)
        yield _Suspect("height-scale", f"heights {abs(percent):.1f} % too {way}", now, certain)
    if abs(fit.smoothing_m2) > CERTAIN * fit.smoothing_sigma:
        gain = math.exp(fit.smoothing_m2)
        text = f"waves of 1 m {_amount(gain)}: another footprint or filter"
        yield _Suspect("short-waves", text, now.scale_waves(fit.smoothing_m2), False)
    yield from _long_waves(fit, limits)


def _long_waves(fit: Fit, limits: CertificationLimits) -> Iterator[_Suspect]:
    """Yield what is wrong with long waves: the vehicle moves in them, or a filter takes them."""
    waves, limit = fit.long_waves, limits.long_wave_percent
    bound = LONG_WAVE_PERCENT if limit is None else limit
    if waves is not None and waves.error_percent - 2.0 * waves.error_sigma > bound:
        which = f"waves of {waves.wave_m:.0f} m {waves.error_percent:.0f} % off in height and place"
        if waves.at_longest:
            yield _Suspect("long-waves", f"{which}: another filter, or {SKEW}", None, True)
        else:
            yield _Suspect("skew", f"{which}: {SKEW}", None, True)
        return
    long = fit.long_percent
    if abs(long) > max(CERTAIN * fit.long_sigma, LEAST_LONG_PERCENT):
        text = f"waves of 8 to 25 m {_amount(1.0 + long / 100.0)}: another filter"
        yield _Suspect("long-waves", text, None, True)


def _amount(gain: float) -> str:
    """Return in words by how much a wave is taken higher or lower."""
    return f"{abs(100.0 * (gain - 1.0)):.0f} % too {'high' if gain > 1.0 else 'low'}"


def _incoherent(score: float, lost: float, fit: Fit) -> list[Cause]:
    """Return the cause of the loss that remains; empty if it is small.

    It is another line on the road where the run surely does not hold all that is not common, nor
    the reference all of it: two lines on a road have as much of it each.
    """
    explains = _share(1.0 - score, lost)
    if not explains >= LEAST_EXPLAINED:
        return []
    if abs(fit.division) + 2.0 * fit.division_sigma < 1.0:
        text = f"another line on the road: correlation {score:.3f} with all else undone"
        return [Cause("wander", text, explains)]
    return [Cause("noise", f"noise: correlation {score:.3f} with all else undone", explains)]


def _share(regained: float, lost: float) -> float:
    """Return ``regained`` as a share of ``lost``, within 0 and 1."""
    return float(np.clip(regained / lost, 0.0, 1.0)) if lost > 0 else math.nan


def _rank(cause: Cause) -> float:
    """Return a number that is the less the more ``cause`` explains."""
    return 0.0 if math.isnan(cause.explains) else -cause.explains
