"""The three figures by which the dissertation compares a run with the reference pass."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures import (
    cross_correlation,
    iri_trace,
    on_common_grid,
    short_interval_roughness,
)
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.stretches import points, stretch
from floatref_conformance.proving_ground.drives.runs import SECTION_START_M

AVERAGE_M = (120.0, 280.9)
"""Stretch of the IRI and of the cross correlation, in m from the section's start."""
PEAK_M = (180.0, 228.0)
"""Stretch of the peak, in m from the section's start (section 5.2)."""
MAX_OFFSET_M = 1.0
"""Largest lag of the cross correlation, in m."""


@dataclass(frozen=True)
class Scores:
    """How one wheel path of a run compares with the reference pass.

    Attributes:
        peak_m_per_km: highest value of the short-interval roughness profile within `PEAK_M`.
        iri_error_percent: error of the IRI over `AVERAGE_M`, in percent of the reference's.
        cross_correlation: agreement (2.16) after the IRI filter over `AVERAGE_M`, -1 to 1.
        cross_correlation_encoder: the same along the encoder's distance, which leaves out the error
            of the axis; the others are along the true distance, as print has them. None if it was
            not measured.
    """

    peak_m_per_km: float
    iri_error_percent: float
    cross_correlation: float
    cross_correlation_encoder: float | None = None


def score(reference: Profile, profile: Profile) -> dict[str, Scores]:
    """Return the scores of every wheel path of ``reference``, whose points ``profile`` takes.

    The car of the IRI runs once over the whole profile; its output is cut afterwards. Every
    point counts, valid or not. Raises DeviceError for a point without elevation within
    `AVERAGE_M`, InputError for a missing wheel path or a reference without roughness.
    """
    reference, profile = on_common_grid(reference, profile)
    return {track.name: _track_scores(reference, profile, track.name) for track in reference.tracks}


def mean_scores(scores: Sequence[Scores]) -> Scores:
    """Return the mean of each figure as it is; InputError without any scores."""
    if not scores:
        raise InputError("no scores to average; make at least one pass")
    beside = [s.cross_correlation_encoder for s in scores]
    known = [value for value in beside if value is not None]
    return Scores(
        float(np.mean([s.peak_m_per_km for s in scores])),
        float(np.mean([s.iri_error_percent for s in scores])),
        float(np.mean([s.cross_correlation for s in scores])),
        float(np.mean(known)) if len(known) == len(scores) else None,
    )


def _track_scores(reference: Profile, profile: Profile, track: str) -> Scores:
    interval_m = profile.interval_m
    roughness = short_interval_roughness(profile.track(track).elevation, interval_m)
    expected, found = _filter_track(reference, track), _filter_track(profile, track)
    iri_reference = float(np.abs(expected).mean())
    if not iri_reference > 0:
        raise InputError(f"track {track}: the reference has no roughness to compare with")
    return Scores(
        float(roughness[_intervals(profile, PEAK_M)].max()),
        100.0 * (float(np.abs(found).mean()) / iri_reference - 1.0),
        cross_correlation(expected, found, interval_m, MAX_OFFSET_M).cross_correlation,
    )


def _filter_track(profile: Profile, track: str) -> FloatArray:
    """Return the signed output of the IRI filter within `AVERAGE_M`, in m/km."""
    stretch(profile, track, *(SECTION_START_M + end for end in AVERAGE_M))
    trace = iri_trace(profile.track(track).elevation, profile.interval_m)
    return trace[_intervals(profile, AVERAGE_M)]


def _intervals(profile: Profile, ends_m: tuple[float, float]) -> slice:
    """Return the intervals between the points within ``ends_m`` of the section's start."""
    inside = points(profile, *(SECTION_START_M + end for end in ends_m))
    return slice(inside.start, inside.stop - 1)
