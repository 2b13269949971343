"""The numbers of a section: accuracy, IRI and missing length of a run, and all pairs of runs.

Correlation is `floatref compare`'s: both profiles on the points of the first, through the IRI
filter, the agreement (2.16) of Karamihas (2021) at the offset within ±1 m at which they correlate
best. R 56-14 correlates profiles through the same filter.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import nan

import numpy as np

from floatref.errors import InputError
from floatref.measures import agreement, iri, iri_trace, on_common_grid
from floatref.measures.locating.placing import MAX_OFFSET_M
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile

BLOCKS = 12
"""Stretches of the section whose IRI is compared, to estimate the scatter of its ratio."""


@dataclass(frozen=True)
class Comparison:
    """One wheel path of a run against the reference; NaN where ``error`` says why.

    Attributes:
        accuracy, offset_m: as `floatref compare` gives them.
        iri_m_per_km, reference_iri_m_per_km: of both, on the points that both cover.
        flagged_m, missing_m: length of the section without a valid point, and without elevation.
        bias_sigma: 1-sigma of ``bias_percent``, by what stretches of the section differ by.
    """

    accuracy: float
    offset_m: float
    iri_m_per_km: float
    reference_iri_m_per_km: float
    flagged_m: float
    missing_m: float
    error: str = ""
    bias_sigma: float = nan

    @property
    def bias_percent(self) -> float:
        """Error of the IRI against the reference's; NaN for a reference without roughness."""
        if not self.reference_iri_m_per_km > 0:
            return nan
        return 100.0 * (self.iri_m_per_km / self.reference_iri_m_per_km - 1.0)


def compare(reference: Profile, run: Profile) -> Mapping[str, Comparison]:
    """Return the comparison of every wheel path of ``reference``, both cut to the section.

    Raises InputError where the two do not overlap, or a wheel path is missing in ``run``.
    """
    expected, found = on_common_grid(reference, run)
    outside = reference.tracks[0].elevation.size - expected.tracks[0].elevation.size
    return {
        track.name: _compare_track(expected, found, track.name, outside)
        for track in reference.tracks
    }


def correlate_pairs(runs: Sequence[Profile | None], tracks: Sequence[str]) -> dict[str, FloatArray]:
    """Return, by wheel path, the accuracy of run j against run i in row i and column j > i.

    NaN elsewhere, for a run that is None, and where two runs cannot be correlated.
    """
    pairs = {name: np.full((len(runs), len(runs)), np.nan) for name in tracks}
    for i, j in combinations(range(len(runs)), 2):
        first, second = runs[i], runs[j]
        if first is None or second is None:
            continue
        for name in tracks:
            pairs[name][i, j] = _pair(first, second, name)
    return pairs


def with_others(pairs: FloatArray) -> FloatArray:
    """Return each run's average over the pairs that it is in, shape (runs,); NaN without any."""
    both = np.where(np.isnan(pairs), 0.0, pairs)
    counted = ~np.isnan(pairs)
    sums, counts = (m.sum(axis=0) + m.sum(axis=1) for m in (both, counted))
    means: FloatArray = np.full(sums.size, np.nan)
    np.divide(sums, counts, out=means, where=counts > 0)
    return means


def _compare_track(expected: Profile, found: Profile, name: str, outside: int) -> Comparison:
    """Return the comparison of one wheel path on common points; ``outside`` are not common."""
    interval = expected.interval_m
    p, track = expected.track(name).elevation, found.track(name)
    q = track.elevation
    flagged_m = interval * float(outside + np.count_nonzero(~track.valid))
    missing_m = interval * float(outside + np.count_nonzero(np.isnan(q)))
    try:
        agreed = agreement(p, q, interval, "iri", MAX_OFFSET_M)
        roughness = iri(q, interval), iri(p, interval)
        sigma = 100.0 * ratio_sigma(iri_trace(p, interval), iri_trace(q, interval))
    except InputError as error:
        return Comparison(nan, nan, nan, nan, flagged_m, missing_m, f"track {name}: {error}")
    return Comparison(
        agreed.cross_correlation, agreed.offset_m, *roughness, flagged_m, missing_m, "", sigma
    )


def ratio_sigma(expected: FloatArray, found: FloatArray) -> float:
    """Return the 1-sigma of the ratio of the mean sizes of two traces, shape (n,) both.

    It is the scatter of `BLOCKS` stretches about their common ratio, which hardly depends on which
    of the two is divided by the other. NaN if the first one is zero.
    """
    known = np.isfinite(expected) & np.isfinite(found)
    parts = [np.array_split(np.abs(trace[known]), BLOCKS) for trace in (expected, found)]
    p, q = (np.array([part.sum() for part in each]) for each in parts)
    if not p.sum() > 0:
        return nan
    rest = q - p * (q.sum() / p.sum())
    return float(np.sqrt(BLOCKS / (BLOCKS - 1) * np.square(rest).sum()) / p.sum())


def _pair(first: Profile, second: Profile, name: str) -> float:
    """Return the correlation of wheel path ``name`` of two runs; NaN if it is undefined."""
    try:
        p, q = on_common_grid(_select_track(first, name), _select_track(second, name))
        z = p.tracks[0].elevation, q.tracks[0].elevation
        return agreement(*z, p.interval_m, "iri", MAX_OFFSET_M).cross_correlation
    except InputError:
        return nan


def _select_track(profile: Profile, name: str) -> Profile:
    return Profile(profile.interval_m, (profile.track(name),), profile.start_m)
