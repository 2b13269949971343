"""To which digits a figure has to agree when it is measured again, here or on another machine.

- What is counted or decided agrees exactly: verdict, outcomes, class reached, numbers of cases and
  alarms, and every figure that follows from figures of the archive.
- A figure that is scored again from the stored profile and a truth that is simulated again agrees
  within `SCORED` of the larger of value and limit, and its limit too, where that follows from the
  truth: processors round differently, and a stop magnifies it.
- A figure of a profile that the device makes again agrees within `REMADE`: its rounding adds up.
- The truth agrees within `TRUTH_M` at every point.

A figure nearer to its limit than that may change sides on another machine. The report follows from
the figures of the archive, so that its outcome does not change.
"""

from collections.abc import Iterator, Sequence
from math import isnan

from floatref_conformance.checks.nees import PathNees
from floatref_conformance.checks.verdict import CaseResult, Measurement
from floatref_conformance.classes import Limits

SCORED = 1e-4
REMADE = 1e-3
TRUTH_M = 1e-6


def agrees(one: float, other: float, scale: float, share: float) -> bool:
    """Return whether two figures differ by no more than ``share`` of the largest of the three."""
    if isnan(one) or isnan(other):
        return isnan(one) and isnan(other)
    # Two infinities of one sign differ by NaN.
    return one == other or abs(one - other) <= share * max(abs(one), abs(other), abs(scale))


def compare_results(stored: CaseResult, again: CaseResult, share: float) -> Iterator[str]:
    """Yield in a line each what differs between a result and its repetition."""
    for name in ("fault", "skipped", "false_alarms", "hung"):
        before, now = getattr(stored, name), getattr(again, name)
        if before != now:
            yield f"{name.replace('_', ' ')} is {before}, here it is {now}"
    if len(stored.measurements) != len(again.measurements):
        yield f"{len(stored.measurements)} figures, here they are {len(again.measurements)}"
        return
    for before, now in zip(stored.measurements, again.measurements, strict=True):
        yield from _compare(before, now, share)
    for name in ("flagged_m", "early_m"):
        if not agrees(getattr(stored, name), getattr(again, name), 1.0, share):
            yield f"{name} is {getattr(stored, name):.7g}, here it is {getattr(again, name):.7g}"
    yield from _compare_nees(stored.nees, again.nees, share)


def _compare_nees(
    stored: Sequence[PathNees], again: Sequence[PathNees], share: float
) -> Iterator[str]:
    """Yield in a line each what differs between two lists of the mean NEES of wheel paths."""
    counted = [[(n.track, n.points) for n in each] for each in (stored, again)]
    if counted[0] != counted[1]:
        yield f"NEES of {_count_points(stored)}, here it is of {_count_points(again)}"
        return
    for before, now in zip(stored, again, strict=True):
        # 1 means errors as large as stated: it is the smallest scale of the comparison.
        if not agrees(before.mean, now.mean, 1.0, share):
            what = f"NEES, track {before.track}: {before.mean:.7g}"
            yield f"{what}, here it is {now.mean:.7g}"


def _count_points(found: Sequence[PathNees]) -> str:
    return ", ".join(f"{n.points} points of {n.track}" for n in found) or "no wheel path"


def _compare(stored: Measurement, again: Measurement, share: float) -> Iterator[str]:
    what = f"{stored.quantity}, track {stored.track}"
    if (stored.quantity, stored.track, stored.unit) != (again.quantity, again.track, again.unit):
        yield f"{what}: here it is {again.quantity}, track {again.track}"
        return
    if not _same_limits(stored, again, share):
        yield f"{what}: limits {_show(stored.limits)}, here they are {_show(again.limits)}"
    scale = max(map(abs, again.limits.values()), default=0.0)
    if not agrees(stored.value, again.value, scale, share):
        yield f"{what}: {stored.value:.7g} {stored.unit}, here it is {again.value:.7g}"


def _same_limits(stored: Measurement, again: Measurement, share: float) -> bool:
    """Return whether both have limits for the same classes; some follow from the truth's IRI."""
    one, other = stored.limits, again.limits
    return one.keys() == other.keys() and all(agrees(one[c], other[c], 0.0, share) for c in one)


def _show(limits: Limits) -> str:
    return ", ".join(f"{limit:.7g}" for limit in limits.values()) or "no limit"
