"""The reasons of a worksheet in words: which runs, and why they do not agree."""

from collections.abc import Iterable, Sequence

from floatref_conformance.certify.worksheet import RunSheet, RunTrack

NAMED = 5
"""Runs that a reason names; of the others it gives the number."""


def listed(items: Sequence[str], most: int = NAMED) -> str:
    """Return ``items`` joined, as many as ``most``, and how many more there are."""
    more = len(items) - most
    told = "; ".join(items[:most])
    return f"{told}; and {more} more" if more > 0 else told


def joined(*parts: str) -> str:
    """Return those of ``parts`` that say something, as one reason."""
    return "; ".join(part for part in parts if part)


def of_track(runs: Iterable[RunSheet], name: str) -> list[tuple[RunSheet, RunTrack]]:
    """Return each run with its wheel path ``name``."""
    return [(run, track) for run in runs for track in run.tracks if track.track == name]


def with_causes(text: str, track: RunTrack) -> str:
    """Return ``text`` and, in brackets behind it, why this wheel path of the run does not agree."""
    causes = ", ".join(cause.text for cause in track.causes)
    return f"{text} ({causes})" if causes else text


def unused(runs: Iterable[RunSheet]) -> list[str]:
    """Return the runs that could not be used, and why."""
    return [f"{run.name} ({run.error})" for run in runs if run.error]
