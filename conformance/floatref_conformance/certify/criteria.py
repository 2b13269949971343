"""Judging a worksheet: what is held against which limit, and why it failed, in words."""

from collections.abc import Iterable

from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.plan import DistancePlan
from floatref_conformance.certify.worksheet import Criterion
from floatref_conformance.verdict import Verdict


def judge_readings(plan: DistancePlan, limits: CertificationLimits) -> tuple[Criterion, ...]:
    """Return the criteria of what was read for a path of known length."""
    raise NotImplementedError


def verdict_of(criteria: Iterable[Criterion]) -> Verdict:
    """Return FAIL if one failed, INCOMPLETE if one is missing or none was judged, else PASS.

    ``criteria`` are all of a worksheet: its own, its sections' and its stationary tests'.
    """
    raise NotImplementedError
