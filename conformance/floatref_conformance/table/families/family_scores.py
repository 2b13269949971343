"""How a profile compares with the road, along the true distance and along the encoder's."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from floatref.measures import iri_trace
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.driving.layout import layout_of
from floatref_conformance.checks.evidence import Pair
from floatref_conformance.checks.flags import SLOW_MPS, speed_at
from floatref_conformance.checks.nees import mean_nees
from floatref_conformance.checks.scoring import Compared, compare, correlation, roughness_percent
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.table.stops.stop_scores import along_encoder

RIGHT_PERCENT, RIGHT_M_PER_KM = 5.0, 0.1
"""An IRI is right that is within either of these of the road's."""


@dataclass(frozen=True)
class PathScores:
    """One wheel path along one axis; of several stretches of 160.9 m the worst counts.

    Attributes:
        cross_correlation: agreement (2.16) after the IRI filter, -1 to 1.
        iri_error_percent: magnitude of the error of the IRI in percent of the road's.
        within_two_sigma_percent: of the points with a 1-sigma, those within two of it; None
            without any.
        valid_is_right: whether the IRI with the road's shape in place of flagged points is within
            `RIGHT_PERCENT` or `RIGHT_M_PER_KM` of the road's.
        valid_error_percent: the magnitude of that error.
        all_is_right: whether the IRI of all points, valid or not, is right in the same way.
        sigma_points: of how many points `within_two_sigma_percent` is the share.
        nees: mean of error² over sigma² of these points; None without any.
    """

    cross_correlation: float
    iri_error_percent: float
    within_two_sigma_percent: float | None
    valid_is_right: bool
    valid_error_percent: float
    all_is_right: bool
    sigma_points: int
    nees: float | None = None


@dataclass(frozen=True)
class FamilyScores:
    """One wheel path along the ``true`` distance and along the ``encoder``'s.

    ``flagged_m`` and ``missing_m`` are the lengths of scored points that are not valid, and those
    without elevation, in m; ``flagged_fast_m`` is the length of those of the profile's points that
    are not valid where the true speed is 16 km/h or more. The road's shape stands in for points
    without elevation.
    """

    true: PathScores
    encoder: PathScores
    flagged_m: float
    missing_m: float
    flagged_fast_m: float


def family_scores(
    scenario: Scenario, truth: Profile, encoder_m: FloatArray, profile: Profile
) -> Mapping[str, FamilyScores]:
    """Return the scores of every wheel path of ``truth``, the unfiltered road under the laser.

    ``encoder_m`` is the distance by the encoder at the truth's points. Raises InputError for a
    wheel path that is missing, or a drive without scored stretches.
    """
    stretches = layout_of(scenario).stretches
    along_true = compare(truth, profile)
    along_its = {c.track: c for c in compare(along_encoder(truth, encoder_m), profile)}
    sigmas = {track.name: _sigma_on_grid(profile, track.sigma) for track in profile.tracks}
    found = {}
    for compared in along_true:
        scored = _scored(compared, stretches)
        found[compared.track] = FamilyScores(
            _score(compared, stretches, sigmas[compared.track]),
            _score(along_its[compared.track], stretches, sigmas[compared.track]),
            compared.interval_m * float(np.sum(scored & ~compared.valid)),
            compared.interval_m * float(np.sum(scored & np.isnan(compared.result))),
            _flagged_fast_m(along_its[compared.track], scenario, encoder_m, truth.interval_m),
        )
    return found


def _flagged_fast_m(
    compared: Compared, scenario: Scenario, encoder_m: FloatArray, interval_m: float
) -> float:
    """Return the flagged length in m of scored points that were driven at 16 km/h or more.

    ``compared`` is along the encoder's distance, the profile's own; its points are looked up at
    their true distance.
    """
    flagged = _scored(compared, layout_of(scenario).stretches) & ~compared.valid
    true_m = interval_m * np.arange(encoder_m.size)
    places = np.interp(compared.distance_m[flagged], encoder_m, true_m)
    return compared.interval_m * float(np.sum(speed_at(scenario, places) >= SLOW_MPS))


def _sigma_on_grid(profile: Profile, sigma: FloatArray | None) -> tuple[FloatArray, FloatArray]:
    """Return the places in m of the points with a 1-sigma, and it; both empty without any."""
    if sigma is None:
        return np.empty(0), np.empty(0)
    known = np.isfinite(sigma)
    return profile.distance_m[known], sigma[known]


def _scored(compared: Compared, stretches: tuple[tuple[float, float], ...]) -> BoolArray:
    """Return which points lie in a stretch, shape (n,)."""
    x = compared.distance_m
    inside = [(x >= start) & (x <= end) for start, end in stretches]
    return np.asarray(np.logical_or.reduce(inside))


def _score(
    compared: Compared,
    stretches: tuple[tuple[float, float], ...],
    sigma: tuple[FloatArray, FloatArray],
) -> PathScores:
    whole = compared.without(np.isnan(compared.result))
    valid = compared.without(~compared.valid | np.isnan(compared.result))
    pairs = [whole.whole(*ends) for ends in stretches]
    every = [_error(pair) for pair in pairs]
    rest = [_error(valid.whole(*ends)) for ends in stretches]
    error, stated = _with_sigma(compared, _scored(compared, stretches), sigma)
    inside = np.abs(error) <= 2.0 * stated
    return PathScores(
        min(1.0 - correlation(pair, compared.track, {}).value for pair in pairs),
        max(percent for percent, _ in every),
        100.0 * float(np.mean(inside)) if inside.size else None,
        all(map(_is_right, rest)),
        max(percent for percent, _ in rest),
        all(map(_is_right, every)),
        inside.size,
        mean_nees(error, stated)[0],
    )


def _is_right(error: tuple[float, float]) -> bool:
    """Return whether an error of the IRI in percent and in m/km is within either limit."""
    percent, off = error
    return percent <= RIGHT_PERCENT or off <= RIGHT_M_PER_KM


def _error(pair: Pair) -> tuple[float, float]:
    """Return the magnitude of the IRI's error, in percent of the road's and in m/km."""
    measured = roughness_percent(pair, "", {})
    percent = measured.value
    return percent, percent / 100.0 * _road(pair)


def _road(pair: Pair) -> float:
    """Return the IRI of the true road, in m/km."""
    return float(np.abs(iri_trace(pair.truth, pair.interval_m)[pair.counted]).mean())


def _with_sigma(
    compared: Compared, scored: BoolArray, sigma: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Return error and sigma in m of every scored point that has one; both maybe empty."""
    places, values = sigma
    if places.size == 0:
        return np.empty(0), np.empty(0)
    at = np.interp(compared.distance_m, places, values)
    counted = scored & np.isfinite(compared.result)
    return (compared.result - compared.truth)[counted], at[counted]
