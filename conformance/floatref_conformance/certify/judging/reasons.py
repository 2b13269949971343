"""The lines of a worksheet: whether a limit is met, and the reasons if it is not."""

from collections.abc import Iterable, Sequence
from math import isnan

from floatref_conformance.certify.judging.contents import Criterion, Judged, RunSheet, RunTrack

NAMED = 5
"""Runs that a reason names; of the others it gives the number."""


def list_in_words(items: Sequence[str], most: int = NAMED) -> str:
    """Return ``items`` joined, as many as ``most``, and how many more there are."""
    more = len(items) - most
    text = "; ".join(items[:most])
    return f"{text}; and {more} more" if more > 0 else text


def join_reasons(*parts: str) -> str:
    """Return the ``parts`` that are not empty, as one reason."""
    return "; ".join(part for part in parts if part)


def of_track(runs: Iterable[RunSheet], name: str) -> list[tuple[RunSheet, RunTrack]]:
    """Return each run with its wheel path ``name``."""
    return [(run, track) for run in runs for track in run.tracks if track.track == name]


def with_causes(text: str, track: RunTrack) -> str:
    """Return ``text`` and, in brackets behind it, why this wheel path of the run does not agree."""
    causes = ", ".join(cause.text for cause in track.causes)
    return f"{text} ({causes})" if causes else text


def name_unused(runs: Iterable[RunSheet]) -> list[str]:
    """Return the runs that could not be used, and why."""
    return [f"{run.name} ({run.error})" for run in runs if run.error]


def judge(value: float, limit: float | None, failed: bool) -> Judged:
    """Return the outcome of ``value``, which ``failed`` its limit or not.

    Without a value nothing is judged, and without a limit nothing is asked.
    """
    if limit is None:
        return Judged.REPORTED
    if failed:
        return Judged.FAIL
    return Judged.MISSING if isnan(value) else Judged.PASS


def report_value(
    id_: str, title: str, clause: str, value: float, unit: str, track: str = "", reason: str = ""
) -> Criterion:
    """Return a line that is not judged."""
    return Criterion(id_, title, clause, value, None, unit, False, Judged.REPORTED, track, reason)
