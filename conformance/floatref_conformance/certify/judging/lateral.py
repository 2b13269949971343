"""Agreement against the lateral separation of the lines that were driven (4.5.2, 4.5.3).

Two lines on a road are two roads: of the pairs of figure 4.10 those 3 cm apart or less agreed
above 0.98, but for one of 14 at 0.976, and others down to 0.808.
Where every run has positions, a worksheet shows both.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.judging.contents import LateralPair, RunSheet, RunTrack
from floatref_conformance.certify.plan.trails import STEP_M, Trail

EARTH_RADIUS_M = 6371e3
REFERENCE = "reference"
"""How a pair names the reference."""
COURSE_M = 5.0
"""Distance ahead and behind by which the course is taken."""


@dataclass(frozen=True)
class Stretch:
    """The section, from and to in m."""

    start_m: float
    end_m: float

    def steps(self) -> FloatArray:
        """Return the distances in m at which separations are taken, shape (n,)."""
        return np.arange(self.start_m, self.end_m + 1e-9, STEP_M)


def separation(first: Trail, second: Trail, stretch: Stretch) -> FloatArray:
    """Return by how far ``second`` lies left of ``first`` in m, along the stretch, shape (n,).

    The course is that of ``first``; the antennas' tilt is not taken out, being alike in both.
    """
    at = stretch.steps()
    origin = float(np.nanmean(first.latitude)), float(np.nanmean(first.longitude))
    course = _at(first, at + COURSE_M, origin) - _at(first, at - COURSE_M, origin)
    length = np.hypot(*course)
    apart = _at(second, at, origin) - _at(first, at, origin)
    return np.asarray((course[0] * apart[1] - course[1] * apart[0]) / length)


def pair_runs(
    stretch: Stretch,
    runs: Sequence[RunSheet],
    pairs: Mapping[str, FloatArray],
    trails: Mapping[str, Trail | None],
    reference: Trail | None = None,
) -> tuple[LateralPair, ...]:
    """Return separation, agreement and difference of IRI of all pairs of ``runs``, by wheel path.

    ``trails`` has those of the runs by name. Empty unless every run that is used has its positions
    all along the section; the reference takes part if it has them too.
    """
    used = [(k, run, trails.get(run.name)) for k, run in enumerate(runs) if run.tracks]
    known = [(k, run, t) for k, run, t in used if t is not None and _covers(t, stretch)]
    if len(known) < len(used) or not known:
        return ()
    found = []
    if reference is not None and _covers(reference, stretch):
        for _, run, trail in known:
            apart = separation(reference, trail, stretch)
            found += [_against(run, track, apart) for track in run.tracks]
    for (i, one, a), (j, other, b) in combinations(known, 2):
        scores = {name: matrix[i, j] for name, matrix in pairs.items()}
        found += _of_pair(one, other, separation(a, b, stretch), scores)
    return tuple(found)


def _covers(trail: Trail, stretch: Stretch) -> bool:
    return trail.within(stretch.start_m, stretch.end_m)


def _against(run: RunSheet, track: RunTrack, apart: FloatArray) -> LateralPair:
    return LateralPair(
        REFERENCE, run.name, track.track, *_means(apart), track.accuracy, track.bias_percent
    )


def _of_pair(
    one: RunSheet, other: RunSheet, apart: FloatArray, agreement: Mapping[str, float]
) -> Iterator[LateralPair]:
    """Yield the pair of two runs for every wheel path that both have."""
    mine = {track.track: track.iri_m_per_km for track in one.tracks}
    for track in other.tracks:
        if track.track in mine:
            iri = mine[track.track]
            percent = 100.0 * (track.iri_m_per_km / iri - 1.0) if iri > 0 else float("nan")
            score = float(agreement[track.track])
            yield LateralPair(one.name, other.name, track.track, *_means(apart), score, percent)


def _means(apart: FloatArray) -> tuple[float, float]:
    """Return the mean magnitude of a separation, and its mean, in m."""
    return float(np.nanmean(np.abs(apart))), float(np.nanmean(apart))


def _at(trail: Trail, at: FloatArray, origin: tuple[float, float]) -> FloatArray:
    """Return east and north of ``origin`` in m at the distances ``at``, shape (2, n)."""
    latitude, longitude = np.radians(origin)
    east = np.radians(trail.longitude) - longitude
    north = np.radians(trail.latitude) - latitude
    places = east * EARTH_RADIUS_M * np.cos(latitude), north * EARTH_RADIUS_M
    return np.array([np.interp(at, trail.distance_m, place) for place in places])
