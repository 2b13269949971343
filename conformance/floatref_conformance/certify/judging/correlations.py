"""Repeatability, accuracy and IRI of a wheel path at a section, against their limits."""

from collections.abc import Sequence
from dataclasses import replace
from math import fsum, inf, isnan, nan, sqrt

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.judging.comparing import with_others
from floatref_conformance.certify.judging.contents import Criterion, Judged, RunSheet, RunTrack
from floatref_conformance.certify.judging.limits import CertificationLimits, falls_below
from floatref_conformance.certify.judging.reasons import (
    join_reasons,
    judge,
    list_in_words,
    of_track,
    with_causes,
)


def outliers(pairs: FloatArray, limit: float) -> tuple[list[int], float]:
    """Return the runs without which the pairs average ``limit``, and what they average then.

    One bad run takes part in all others' pairs, whose averages fall with its own; so the worst is
    left out until the rest agrees. Empty, and NaN, if half of the runs or more would have to go,
    or no run has to. ``pairs`` has shape (runs, runs), NaN where there is no value.
    """
    kept = np.flatnonzero(~np.isnan(with_others(pairs))).tolist()
    gone: list[int] = []
    while 2 * len(gone) < len(kept) + len(gone):
        part = pairs[np.ix_(kept, kept)]
        average = float(np.nanmean(part)) if np.isfinite(part).any() else np.nan
        if average >= limit:
            return gone, average if gone else np.nan
        gone.append(kept.pop(int(np.nanargmin(with_others(part)))))
    return [], np.nan


def judge_repeatability(
    name: str, runs: Sequence[RunSheet], pairs: FloatArray, limits: CertificationLimits
) -> Criterion:
    """Return the average over all pairs of ``runs``; ``pairs`` has shape (runs, runs).

    The reason names the runs without which the others would agree; where those are too many, all
    that are below the limit.
    """
    found, clause = pairs[~np.isnan(pairs)], limits.clause("repeatability")
    lacking = "" if found.size else "it takes two runs that can be correlated"
    made = _correlation(
        ("repeatability", f"agreement of {found.size} pairs of runs", clause),
        (mean(found.tolist()), limits.repeatability, name, lacking),
        [(run, track, track.with_others) for run, track in of_track(runs, name)],
    )
    least = -inf if limits.repeatability is None else limits.repeatability
    blamed, rest = outliers(pairs, least)
    if not blamed:
        return made
    tracks = {run.name: track for run, track in of_track(runs, name)}
    text = [
        with_causes(
            f"{runs[k].name} at {tracks[runs[k].name].with_others:.3f}", tracks[runs[k].name]
        )
        for k in blamed
    ]
    return replace(made, reason=f"the other runs agree to {rest:.3f} without {list_in_words(text)}")


def judge_accuracy(name: str, runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return the average agreement of ``runs`` with the reference."""
    scores = [(run, track, track.accuracy) for run, track in of_track(runs, name)]
    found = [score for _, _, score in scores if not isnan(score)]
    lacking = "" if found else "no run can be compared with the reference"
    return _correlation(
        (
            "accuracy",
            f"agreement of {len(found)} runs with the reference",
            limits.clause("accuracy"),
        ),
        (mean(found), limits.accuracy, name, lacking),
        scores,
    )


def judge_bias(name: str, runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return the mean error of the IRI; its magnitude, less 2 sigma, is held to the limit.

    On another line the road has another IRI. Half of what that makes is the reference's, which
    all runs share.
    """
    errors = [(run, track.bias_percent, track) for run, track in of_track(runs, name)]
    errors = [error for error in errors if not isnan(error[1])]
    value, limit = mean([error for _, error, _ in errors]), limits.iri_bias_percent
    squares = mean([track.bias_sigma**2 for _, _, track in errors])
    sigma = sqrt(0.5 * squares * (1.0 + 1.0 / len(errors))) if errors else nan
    failed = limit is not None and abs(value) - 2.0 * sigma > limit
    errors.sort(key=lambda error: -abs(error[1]))
    text = [
        with_causes(f"{run.name} {error:+.2f} %", track)
        for run, error, track in errors
        if limit is not None and abs(error) > limit
    ]
    reason = join_reasons(
        f"2 sigma are {2.0 * sigma:.2f} %" if sigma > 0 else "",
        f"beyond the limit: {list_in_words(text)}" if text else "",
    )
    if not errors:
        reason = "the IRI of no run could be taken, or the reference has no roughness"
    return Criterion(
        "iri-bias",
        "mean error of the IRI",
        limits.clause("iri_bias_percent"),
        value,
        limit,
        "%",
        False,
        judge(value, limit, failed),
        name,
        reason,
    )


def mean(values: Sequence[float]) -> float:
    """Return the mean, the same in any order of ``values``; NaN if empty."""
    return fsum(values) / len(values) if values else nan


def _correlation(
    words: tuple[str, str, str],
    figures: tuple[float, float | None, str, str],
    scores: list[tuple[RunSheet, RunTrack, float]],
) -> Criterion:
    """Return the criterion of an average; it names every run that is itself below the limit."""
    value, limit, name, lacking = figures
    absent = [run.name for run, _, score in scores if isnan(score)]
    below = sorted((s for s in scores if falls_below(s[2], limit)), key=lambda s: s[2])
    text = [with_causes(f"{run.name} at {score:.3f}", track) for run, track, score in below]
    judged = judge(value, limit, falls_below(value, limit))
    if absent and judged is Judged.PASS:
        judged = Judged.MISSING
    reason = join_reasons(
        lacking,
        f"not in the average: {list_in_words(absent)}" if absent and not lacking else "",
        f"below {limit:g} by itself: {list_in_words(text)}" if text else "",
    )
    return Criterion(words[0], words[1], words[2], value, limit, "", True, judged, name, reason)
