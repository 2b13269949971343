"""Making the lines of a worksheet."""

from math import isnan

from floatref_conformance.certify.worksheet import Criterion, Judged


def judged_by(value: float, limit: float | None, failed: bool) -> Judged:
    """Return the outcome of ``value``, of which is known whether it ``failed`` its limit.

    Without a value nothing is judged, and without a limit nothing is asked.
    """
    if limit is None:
        return Judged.REPORTED
    if failed:
        return Judged.FAIL
    return Judged.MISSING if isnan(value) else Judged.PASS


def reported(
    id_: str, title: str, clause: str, value: float, unit: str, track: str = "", reason: str = ""
) -> Criterion:
    """Return a line that is not judged."""
    return Criterion(id_, title, clause, value, None, unit, False, Judged.REPORTED, track, reason)
