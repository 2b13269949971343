"""How a profile around a stop compares with the truth."""

from dataclasses import dataclass, replace

import numpy as np

from floatref.measures import high_pass, on_common_grid
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.nees import mean_nees
from floatref_conformance.checks.stretches import points
from floatref_conformance.errors import DeviceError
from floatref_conformance.proving_ground.drives.runs import SECTION_START_M
from floatref_conformance.table.scores import AVERAGE_M, score

STRETCH_M = (SECTION_START_M + AVERAGE_M[0], SECTION_START_M + AVERAGE_M[1])
"""What counts of a drive, in m of true distance; the stop lies 96 m into its 160.9 m."""


@dataclass(frozen=True)
class StopScores:
    """How one wheel path of a drive compares with the truth within `STRETCH_M`.

    Attributes:
        cross_correlation: agreement (2.16) after the IRI filter, -1 to 1.
        iri_error_percent: error of the IRI in percent of the truth's.
        peak_m_per_km: highest short-interval roughness within 48 m around the stop.
        within_two_sigma_percent: of the points, those at which the truth lies within two of the
            profile's 1-sigma, along the encoder's distance, which is the profile's axis; None
            where the profile has no sigma.
        within_two_sigma_true_distance_percent: the same along the true distance, so that sigma
            would have to contain the error of the axis.
        cross_correlation_encoder, iri_error_encoder_percent: the first two along the encoder's
            distance, so that they leave out the error of the axis; the others, but for the share
            above, are along the true distance.
        nees: mean of error² over sigma² of the points that the share is of, along the encoder's
            distance; None where the profile has no sigma.
        nees_true_distance: the same along the true distance.
    """

    cross_correlation: float
    iri_error_percent: float
    peak_m_per_km: float
    within_two_sigma_percent: float | None = None
    within_two_sigma_true_distance_percent: float | None = None
    cross_correlation_encoder: float | None = None
    iri_error_encoder_percent: float | None = None
    nees: float | None = None
    nees_true_distance: float | None = None


def stop_scores(truth: Profile, encoder_m: FloatArray, profile: Profile) -> dict[str, StopScores]:
    """Return the scores of every wheel path of ``truth``, the unfiltered laser path.

    ``encoder_m`` is the distance by the encoder at the truth's points. The truth is
    high-pass filtered as profiles are (-3 dB at 91.44 m). Raises DeviceError for a profile
    with missing points within `STRETCH_M`, InputError for a missing wheel path.
    """
    _check_reach(profile)
    reference, text = _high_pass(truth), _high_pass(along_encoder(truth, encoder_m))
    beside = score(text, profile)
    return {
        name: StopScores(
            scores.cross_correlation,
            scores.iri_error_percent,
            scores.peak_m_per_km,
            _within_two_sigma(text, profile, name),
            _within_two_sigma(reference, profile, name),
            beside[name].cross_correlation,
            beside[name].iri_error_percent,
            _nees(text, profile, name),
            _nees(reference, profile, name),
        )
        for name, scores in score(reference, profile).items()
    }


def _check_reach(profile: Profile) -> None:
    """Raise DeviceError unless ``profile`` covers all of `STRETCH_M`."""
    end_m = profile.start_m + profile.length_m
    if profile.start_m > STRETCH_M[0] or end_m < STRETCH_M[1]:
        raise DeviceError(
            f"the profile covers {profile.start_m:.1f} m to {end_m:.1f} m; "
            f"{STRETCH_M[0]:.1f} m to {STRETCH_M[1]:.1f} m count"
        )


def along_encoder(truth: Profile, encoder_m: FloatArray) -> Profile:
    """Return ``truth`` against the distance by the encoder, at the same interval."""
    text = truth.interval_m * np.arange(int(encoder_m[-1] / truth.interval_m) + 1)
    tracks = (
        ProfileTrack.of(t.name, np.interp(text, encoder_m, t.elevation)) for t in truth.tracks
    )
    return replace(truth, tracks=tuple(tracks))


def _high_pass(profile: Profile) -> Profile:
    """Return ``profile`` after the high-pass."""
    interval_m = profile.interval_m
    tracks = (ProfileTrack.of(t.name, high_pass(t.elevation, interval_m)) for t in profile.tracks)
    return replace(profile, tracks=tuple(tracks))


def _within_two_sigma(reference: Profile, profile: Profile, name: str) -> float | None:
    """Return the share in percent on the profile's own points; a sigma of NaN contains no point."""
    error, sigma = _errors(reference, profile, name)
    return None if sigma is None else 100.0 * float(np.mean(np.abs(error) <= 2.0 * sigma))


def _nees(reference: Profile, profile: Profile, name: str) -> float | None:
    error, sigma = _errors(reference, profile, name)
    return None if sigma is None else mean_nees(error, sigma)[0]


def _errors(
    reference: Profile, profile: Profile, name: str
) -> tuple[FloatArray, FloatArray | None]:
    """Return error and sigma in m of the profile's own points within `STRETCH_M`."""
    found, true = on_common_grid(profile, reference)
    inside, track = points(found, *STRETCH_M), found.track(name)
    error = (track.elevation - true.track(name).elevation)[inside]
    return error, None if track.sigma is None else track.sigma[inside]
