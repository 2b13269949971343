"""Judging a section, and the verdict: what is held against which limit, and why it failed."""

from collections.abc import Iterable, Mapping, Sequence
from math import nan

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.asked import judge_asked
from floatref_conformance.certify.judging.contents import Criterion, Judged, RunSheet
from floatref_conformance.certify.judging.correlations import (
    judge_accuracy,
    judge_bias,
    judge_repeatability,
)
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.reasons import (
    join_reasons,
    judge,
    list_in_words,
    name_unused,
    report_value,
)
from floatref_conformance.certify.judging.scales import (
    judge_distance,
    judge_height,
    judge_long_waves,
    judge_mean_height,
)
from floatref_conformance.checks.verdict import Verdict

MISSING_PERCENT = 2.0
"""Part of a section in which elevations of a run may be missing; ours.

Compare's offset of 1 m leaves out 0.6 % of 0.1 mile and a distance error of 1 % leaves out 1 %:
neither is a hole. What is beyond is road that nobody measured, bridged by a straight line.
"""
COVERAGE = "ours: a run holds elevations for all but 2 % of the section, at each wheel path"
FLAGGED = "ours: what a run flags as not valid is compared like the rest, and reported"


def judge_section(
    truth: Profile,
    runs: Sequence[RunSheet],
    pairs: Mapping[str, FloatArray],
    limits: CertificationLimits,
) -> tuple[Criterion, ...]:
    """Return the criteria of a section: those of all wheel paths, then those of each.

    ``truth`` is the reference within the section, ``pairs`` the correlations by wheel path.
    """
    used = [run for run in runs if not run.error]
    made = [_number(runs, limits), _coverage(truth, used), _flagged_length(truth, used)]
    made += judge_distance(used, limits)
    made.append(judge_mean_height(used, limits))
    for name in pairs:
        made += [
            judge_repeatability(name, runs, pairs[name], limits),
            judge_accuracy(name, used, limits),
            judge_bias(name, used, limits),
            judge_height(name, used, limits),
            judge_long_waves(name, used, limits),
        ]
    return (*made, *judge_asked(used, list(pairs), limits))


def verdict_of(criteria: Iterable[Criterion], has_open: bool = False) -> Verdict:
    """Return FAIL if one failed, INCOMPLETE if one is missing or not any was judged, else PASS.

    ``criteria`` are all of a worksheet: its own, its sections' and its stationary tests'. A
    practice that ``has_open`` requirements, which cannot be judged, is never passed; nor is
    coverage alone, which is ours, a reason to pass.
    """
    outcomes = {one.judged for one in criteria if one.id != "coverage" or one.judged != Judged.PASS}
    if Judged.FAIL in outcomes:
        return Verdict.FAIL
    if Judged.MISSING in outcomes or Judged.PASS not in outcomes:
        return Verdict.INCOMPLETE
    return Verdict.INCOMPLETE if has_open else Verdict.PASS


def _number(runs: Sequence[RunSheet], limits: CertificationLimits) -> Criterion:
    """Return how many runs could be used; too few leave the verdict open."""
    count, left_out = sum(not run.error for run in runs), name_unused(runs)
    enough = limits.runs is None or count >= limits.runs
    reason = join_reasons(
        "" if enough else f"{count} of the {limits.runs} runs that are asked for",
        f"not used: {list_in_words(left_out)}" if left_out else "",
    )
    judged = Judged.PASS if enough else Judged.MISSING
    judged = Judged.REPORTED if limits.runs is None else judged
    title, limit = "runs that could be used", None if limits.runs is None else float(limits.runs)
    return Criterion(
        "runs", title, limits.clause("runs"), float(count), limit, "", True, judged, "", reason
    )


def _coverage(truth: Profile, used: Sequence[RunSheet]) -> Criterion:
    """Return the largest part of the section that is missing in a wheel path of a run."""
    shares = [
        (100.0 * track.missing_m / _length_m(truth), f"{run.name}, {track.track}", track.missing_m)
        for run in used
        for track in run.tracks
    ]
    shares.sort(key=lambda share: -share[0])
    worst = shares[0][0] if shares else nan
    holes = [
        f"{who}: {missing_m:.1f} m" for part, who, missing_m in shares if part > MISSING_PERCENT
    ]
    reason = f"without elevation: {list_in_words(holes)}" if holes else ""
    return Criterion(
        "coverage",
        "part of the section that a run lacks, the largest",
        COVERAGE,
        worst,
        MISSING_PERCENT,
        "%",
        False,
        judge(worst, MISSING_PERCENT, bool(holes)),
        "",
        reason or ("" if shares else "no run could be used"),
    )


def _flagged_length(truth: Profile, used: Sequence[RunSheet]) -> Criterion:
    """Return the largest length of a wheel path that is not valid, and whose it is."""
    lengths = [(t.flagged_m, f"{run.name}, {t.track}") for run in used for t in run.tracks]
    known = sorted((one for one in lengths if one[0] > 0), key=lambda one: -one[0])
    doubted = [
        f"the reference, {track.name}: {truth.interval_m * (~track.valid).sum():.1f} m"
        for track in truth.tracks
        if not track.valid.all()
    ]
    reason = list_in_words(doubted + [f"{who}: {length:.1f} m" for length, who in known])
    worst = max((length for length, _ in lengths), default=nan)
    title = "length within the section that a run flags or lacks, the largest"
    return report_value("flagged", title, FLAGGED, worst, "m", "", reason)


def _length_m(truth: Profile) -> float:
    """Return the length that ``truth`` covers in m, every point counting one interval."""
    return truth.interval_m * truth.tracks[0].elevation.size
