"""How well a profile agrees with the reference: the three aims of section 6.4.4."""

from dataclasses import dataclass
from math import inf, isnan, nan

import numpy as np

from floatref.errors import InputError
from floatref.measures import (
    cross_correlation,
    iri_trace,
    on_common_grid,
    short_interval_roughness,
)
from floatref.tuning.preliminary_runs import STEADY, Drive, stretches
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile

AROUND_M = 24.0
"""Distance in m to either side of a critical location that is searched for the peak."""
LEAST_M = 50.0
"""Shortest stretch in m that is compared."""
LARGEST = 1.0
"""Largest error of roughness that counts: 100 %."""


@dataclass(frozen=True)
class Score:
    """How one wheel path of a run agrees with the reference.

    Attributes:
        cross_correlation: of the IRI filter's output (2.16), -1 to 1.
        iri_error: of the average IRI, as a share of the reference's; NaN but at constant speed.
        peak_error: of the peak of the short-interval roughness profile at the critical location
            where it is largest, as a share of the reference's; NaN without one.
        offset_m: offset of the profile along the road.
    """

    cross_correlation: float
    iri_error: float = nan
    peak_error: float = nan
    offset_m: float = nan

    @property
    def roughness_error(self) -> float:
        """The error of the IRI or of the peak, whichever the run has; else NaN."""
        return self.peak_error if isnan(self.iri_error) else self.iri_error

    @property
    def loss(self) -> float:
        """1 less the cross correlation, plus the limited roughness error."""
        error = abs(self.roughness_error)
        return 1.0 - self.cross_correlation + (0.0 if isnan(error) else min(error, LARGEST))


Scores = tuple[Score, ...]
"""Of the wheel paths of the reference, in its order."""
HOPELESS = Score(-1.0)
"""With values that give no profile."""


@dataclass(frozen=True)
class Comparison:
    """Reference and section for the profiles of one run.

    Attributes:
        reference: the profile that they should agree with.
        begin_m, end_m: between these distances.
        drive: how the run was driven there.
        max_offset_m: largest offset of distance that is searched.
    """

    reference: Profile
    begin_m: float
    end_m: float
    drive: Drive
    max_offset_m: float = 1.0

    def scores(self, profile: Profile) -> Scores:
        """Return the scores of ``profile``, of which every point counts, valid or not.

        The car of the IRI runs once over the common stretch, and its output is cut afterwards.
        Raises InputError for a missing wheel path.
        """
        expected, found = on_common_grid(self.reference, profile)
        return tuple(
            self._score(expected, t.elevation, found.track(t.name).elevation)
            for t in expected.tracks
        )

    def _score(self, grid: Profile, p: FloatArray, q: FloatArray) -> Score:
        interval_m = grid.interval_m
        first = max(round((self.begin_m - grid.start_m) / interval_m), 0)
        cut = slice(first, first + round((self.end_m - self.begin_m) / interval_m))
        p_car, q_car = (iri_trace(z, interval_m)[cut] for z in (p, q))
        agreed = cross_correlation(p_car, q_car, interval_m, self.max_offset_m)
        lag = round(agreed.offset_m / interval_m)
        p_peaks, q_peaks = (short_interval_roughness(z, interval_m)[cut] for z in (p, q))
        places = [round((m - self.begin_m) / interval_m) for m in self.drive.critical_m]
        reach = round(AROUND_M / interval_m)
        errors = [_peak_error(p_peaks, q_peaks, place, reach, lag) for place in places]
        steady = self.drive.kind in STEADY
        return Score(
            agreed.cross_correlation,
            _error(float(np.abs(q_car).mean()), float(np.abs(p_car).mean())) if steady else nan,
            max(errors, key=abs, default=nan),
            agreed.offset_m,
        )


def section(reference: Profile, profile: Profile) -> tuple[float, float]:
    """Return the stretch in m where ``reference`` is valid and ``profile`` has run in.

    Of a reference with invalid points inside the longest valid stretch counts. Raises InputError
    where less than 50 m are left.
    """
    parts = stretches(_valid(reference))
    longest = max(parts, key=lambda part: part[1] - part[0], default=(0, 0))
    inside = np.flatnonzero(_valid(profile))
    ends = (int(inside[0]), int(inside[-1]) + 1) if inside.size else (0, 0)
    known, made = _span(reference, *longest), _span(profile, *ends)
    begin_m, end_m = max(known[0], made[0]), min(known[1], made[1])
    if not end_m - begin_m >= LEAST_M:
        raise InputError(
            f"the reference is valid {_describe(known)}, and the run's profile {_describe(made)}; "
            f"{LEAST_M:g} m have to be both: drive on, or give the same start of distance"
        )
    return begin_m, end_m


def _peak_error(expected: FloatArray, found: FloatArray, place: int, reach: int, lag: int) -> float:
    """Return the error of the peak around ``place``, which lies ``lag`` back in ``expected``."""
    begin, end = max(place - reach, 0), max(place + reach, 1)
    back = expected[max(begin - lag, 0) : max(end - lag, 1)]
    return _error(float(found[begin:end].max()), float(back.max()))


def _error(found: float, expected: float) -> float:
    if not expected > 0:
        raise InputError("the reference is perfectly smooth there; take one of a real road")
    return found / expected - 1.0


def _valid(profile: Profile) -> BoolArray:
    return np.asarray(np.logical_and.reduce([track.valid for track in profile.tracks]))


def _span(profile: Profile, begin: int, end: int) -> tuple[float, float]:
    """Return the distances in m of point ``begin`` and of the last before ``end``."""
    if end <= begin:
        return inf, -inf
    first = profile.start_m + begin * profile.interval_m
    return first, first + (end - 1 - begin) * profile.interval_m


def _describe(span: tuple[float, float]) -> str:
    return f"from {span[0]:.1f} to {span[1]:.1f} m" if span[0] < inf else "nowhere"
