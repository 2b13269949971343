"""Which runs of a certification are marked, in the terminal, on the page and in pictures."""

from floatref_conformance.certify.limits import CertificationLimits
from floatref_conformance.certify.scales import scales_agree
from floatref_conformance.certify.worksheet import RunSheet, RunTrack

DISAGREES, NOT_USED = "does not agree", "not used"
"""What marks a run."""


def is_bad(run: RunSheet, limits: CertificationLimits, track: str | None = None) -> bool:
    """Return whether a wheel path of ``run``, or any of them, does not agree."""
    judged = [one for one in run.tracks if track in (None, one.track)]
    return not judged or any(_disagrees(one, limits) for one in judged)


def _disagrees(track: RunTrack, limits: CertificationLimits) -> bool:
    """Return whether there is a cause, a low correlation, or a scale that is surely wrong."""
    low = not track.accuracy >= limits.accuracy
    return bool(track.causes) or low or not scales_agree(track, limits)


def mark(run: RunSheet, limits: CertificationLimits, track: str) -> str:
    """Return what marks a wheel path of ``run`` out of the others; nothing if it agrees."""
    if not any(one.track == track for one in run.tracks):
        return NOT_USED
    return DISAGREES if is_bad(run, limits, track) else ""
