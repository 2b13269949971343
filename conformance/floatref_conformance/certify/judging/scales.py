"""Scale of distance and of heights, measured by the profiles and by readings of known lengths."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import fsum, inf, isnan, nan, sqrt

from scipy.special import ndtr, ndtri

from floatref.errors import InputError
from floatref_conformance.certify.judging.contents import Criterion, Judged, RunSheet, RunTrack
from floatref_conformance.certify.judging.correlations import mean
from floatref_conformance.certify.judging.limits import CertificationLimits, falls_below
from floatref_conformance.certify.judging.reasons import (
    join_reasons,
    judge,
    list_in_words,
    of_track,
    report_value,
)
from floatref_conformance.certify.plan.plan_document import DistancePlan

BY_PROFILES = "ours: measured by the section's profiles, and every run is held to it"
BY_READINGS = "over a path of known length; ours: every reading is held to it"
FINEST = 0.001
"""Percent; a smaller uncertainty is given as this one."""


@dataclass(frozen=True)
class ScaleError:
    """An error of scale in percent and its 1-sigma, and whose it is."""

    who: str
    percent: float
    sigma: float

    def beyond(self, limit: float, sigmas: float = 2.0) -> bool:
        """Return whether the error is above ``limit`` even with ``sigmas`` in its favour."""
        return abs(self.percent) - sigmas * self.sigma > limit

    def vague(self, limit: float) -> bool:
        """Return whether ``limit`` is less than 2 sigma, or the error is not known at all."""
        return not 2.0 * self.sigma <= limit

    def __str__(self) -> str:
        if isnan(self.percent) or isnan(self.sigma):
            return f"{self.who} (not known)"
        doubt = f" ± {max(2.0 * self.sigma, FINEST):.2g} %" if self.sigma else ""
        return f"{self.who} {self.percent:+.2f} %{doubt}"


def agrees(track: RunTrack, limits: CertificationLimits) -> bool:
    """Return whether a wheel path of a run is within the limits all by itself."""
    low = falls_below(track.accuracy, limits.accuracy)
    low = low or falls_below(track.with_others, limits.repeatability)
    return not low and scales_agree(track, limits)


def sigmas_of(count: int) -> float:
    """Return the sigma in favour of each of ``count`` errors, of which the largest decides.

    Of so many the largest is then beyond its own by chance as rarely as a single one is beyond 2.
    """
    return float(-ndtri(ndtr(-2.0) / max(count, 1)))


def scales_agree(track: RunTrack, limits: CertificationLimits) -> bool:
    """Return whether no error of a wheel path of a run is surely beyond its limit."""
    distance = ScaleError("", track.distance_percent, track.distance_sigma)
    height = ScaleError("", track.height_percent, track.height_sigma)
    long = ScaleError("", track.long_percent, track.long_sigma)
    return not (
        distance.beyond(inf if limits.distance_percent is None else limits.distance_percent)
        or height.beyond(inf if limits.height_percent is None else limits.height_percent)
        or long.beyond(inf if limits.long_wave_percent is None else limits.long_wave_percent)
    )


def judge_distance(runs: Sequence[RunSheet], limits: CertificationLimits) -> tuple[Criterion, ...]:
    """Return the largest error of distance of a run, and the mean over the runs.

    Of a run's wheel paths, which share one encoder, the one with the smallest sigma counts. A
    worksheet whose runs do not measure it is INCOMPLETE.
    """
    errors = [_best(run) for run in runs if run.tracks]
    found = [one.percent for one in errors if not isnan(one.percent)]
    clause = f"{limits.clause('distance_percent')}; {BY_PROFILES}"
    words = "distance", "error of distance, the largest of a run", clause
    largest = _judge_largest(words, errors, limits.distance_percent, "", Judged.MISSING)
    title = "error of distance, mean of the runs"
    return largest, report_value("distance-mean", title, clause, mean(found), "%")


def judge_height(name: str, runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return the largest error of the scale of heights of a run, in wheel path ``name``.

    Where no run measures it, it is reported only: R 56-14 does not ask for it. Between two lines
    on the road chance is as large as the limit, so each of many runs has more sigma in its favour.
    """
    tracks = of_track(runs, name)
    errors = [
        ScaleError(run.name, track.height_percent, track.height_sigma) for run, track in tracks
    ]
    title = "error of the scale of heights, the largest of a run"
    words = "height-scale", title, limits.clause("height_percent")
    return _judge_largest(
        words, errors, limits.height_percent, name, Judged.REPORTED, sigmas_of(len(errors))
    )


def judge_mean_height(runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return the error of the scale of heights that all runs and wheel paths share.

    If their mean is beyond the limit, one of them is. Errors of chance are half the reference's,
    which the runs of a wheel path share, and half their own.
    """
    errors = [
        ScaleError("the mean", track.height_percent, track.height_sigma)
        for run in runs
        for track in run.tracks
        if track.height_sigma > 0
    ]
    weights = [1.0 / error.sigma**2 for error in errors]
    paths = len({track.track for run in runs for track in run.tracks})
    found = []
    if errors:
        value = fsum(w * e.percent for w, e in zip(weights, errors, strict=True)) / fsum(weights)
        common = 0.5 * len(errors) / max(paths, 1)
        found = [ScaleError("the mean", value, sqrt((0.5 + common) / fsum(weights)))]
    title = "error of the scale of heights, mean of all runs"
    words = "height-scale-mean", title, limits.clause("height_percent")
    return _judge_largest(words, found, limits.height_percent, "", Judged.REPORTED)


def judge_long_waves(name: str, runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return the largest error of long waves of a run, in wheel path ``name``.

    Where no run measures it, it is reported only: R 56-14 does not ask for it.
    """
    errors = [
        ScaleError(run.name, track.long_percent, track.long_sigma)
        for run, track in of_track(runs, name)
    ]
    title = "error of waves of 4 to 25 m, the largest of a run"
    words = "long-waves", title, limits.clause("long_wave_percent")
    return _judge_largest(
        words, errors, limits.long_wave_percent, name, Judged.REPORTED, sigmas_of(len(errors))
    )


def judge_readings(plan: DistancePlan, limits: CertificationLimits) -> tuple[Criterion, ...]:
    """Return the criteria of what was read for a path of known length: largest, and mean.

    Raises InputError for a length or a reading that is not above zero.
    """
    for value in (plan.known_m, *plan.readings_m):
        if not 0.0 < value < inf:
            raise InputError(f"[distance] holds {value:g} m; give lengths in m above zero")
    errors = [
        ScaleError(f"reading {k} ({reading:g} m)", 100.0 * (reading / plan.known_m - 1.0), 0.0)
        for k, reading in enumerate(plan.readings_m, 1)
    ]
    clause = f"{limits.clause('distance_percent')}, {BY_READINGS}"
    words = "distance-readings", f"distance read for {plan.known_m:g} m, the largest error", clause
    largest = _judge_largest(words, errors, limits.distance_percent, "", Judged.MISSING)
    title = f"distance read for {plan.known_m:g} m, mean error"
    average = mean([one.percent for one in errors])
    return largest, report_value("distance-readings-mean", title, clause, average, "%")


def _best(run: RunSheet) -> ScaleError:
    """Return the error of distance by the wheel path of smallest sigma."""
    known = [t for t in run.tracks if not isnan(t.distance_sigma + t.distance_percent)]
    if not known:
        return ScaleError(run.name, nan, nan)
    track = min(known, key=lambda t: t.distance_sigma)
    return ScaleError(run.name, track.distance_percent, track.distance_sigma)


def _judge_largest(
    words: tuple[str, str, str],
    errors: Sequence[ScaleError],
    limit: float | None,
    track: str,
    unknown: Judged,
    sigmas: float = 2.0,
) -> Criterion:
    """Return the criterion of the largest error; ``unknown`` if no run measures it well enough."""
    bound = inf if limit is None else limit
    known = [one for one in errors if not isnan(one.percent)]
    beyond = sorted((o for o in errors if o.beyond(bound, sigmas)), key=lambda o: -abs(o.percent))
    vague = [] if limit is None else [one for one in errors if one.vague(bound)]
    counted = beyond or [one for one in known if one not in vague] or known
    value = max((one.percent for one in counted), key=abs, default=nan)
    judged = judge(value, limit, bool(beyond))
    if limit is not None and not beyond and len(vague) == len(errors):
        judged = unknown
    reason = join_reasons(
        f"beyond the limit: {list_in_words([str(one) for one in beyond])}" if beyond else "",
        f"not known to {bound:g} %: {list_in_words([str(o) for o in vague if o not in beyond])}"
        if any(o not in beyond for o in vague)
        else "",
        "" if errors else "no run measures it",
    )
    return Criterion(words[0], words[1], words[2], value, limit, "%", False, judged, track, reason)
