"""One wheel path of an answer beside the truth and the motion of the body, on coarse points."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures import high_pass
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.scoring import bridge, compare
from floatref_conformance.resemblance.probe_answers import Answer

STEP_M = 0.1
"""Spacing of the points, in m; each is the mean of the profile's points before it."""
HUGE_M = 1e5
"""Elevations are limited to that, in m, so that their squares are numbers."""


@dataclass(frozen=True, eq=False)
class ComparedPath:
    """One wheel path on points `STEP_M` apart; all arrays have shape (n,), elevations are in m.

    Attributes:
        track: its name.
        distance_m: of the points.
        truth: high-pass filtered (-3 dB at 91.44 m).
        found: what was delivered, with the truth's shape where it has no elevation.
        body: height of the body, high-pass filtered like the truth; zeros without a laser.
        speed_mps: of the vehicle.
        missing, flagged: shares of the points behind each point, 0 to 1.
        fine: the delivered points themselves, NaN where there is no elevation.
        fine_m: their interval.
    """

    track: str
    distance_m: FloatArray
    truth: FloatArray
    found: FloatArray
    body: FloatArray
    speed_mps: FloatArray
    missing: FloatArray
    flagged: FloatArray
    fine: FloatArray
    fine_m: float

    @property
    def error(self) -> FloatArray:
        """What was delivered less the truth, in m, shape (n,)."""
        return self.found - self.truth

    def near(self, places_m: tuple[float, ...], reach_m: float) -> BoolArray:
        """Return the points within ``reach_m`` of one of ``places_m``, shape (n,)."""
        away = np.abs(self.distance_m[:, None] - np.asarray(places_m or (np.inf,))[None, :])
        return np.asarray(away.min(axis=1) <= reach_m)


def compare_paths(answer: Answer) -> Iterator[ComparedPath]:
    """Yield every wheel path of the truth that was delivered, if the axes meet."""
    profile, truth = answer.profile, answer.taken.truth
    if profile is None:
        return
    try:
        pairs = compare(truth, _only(profile, truth))
    except (InputError, KeyError):
        return
    for pair in pairs:
        count = round(STEP_M / pair.interval_m)
        if pair.distance_m.size < 100 * count:
            continue
        limited = np.clip(pair.result, -HUGE_M, HUGE_M)
        body, speed = _motion(answer, pair.track, pair.distance_m)
        rows = (pair.distance_m, pair.truth, bridge(limited, pair.truth), body, speed)
        shares = (np.isnan(limited).astype(float), (~pair.valid).astype(float))
        x, true, found, moved, driven = (_means(row, count) for row in rows)
        missing, flagged = (_means(row, count) for row in shares)
        track = profile.track(pair.track)
        fine = np.clip(track.elevation, -HUGE_M, HUGE_M)
        coarse = (x, true, found, moved, driven, missing, flagged)
        yield ComparedPath(pair.track, *coarse, fine, profile.interval_m)


def _only(profile: Profile, truth: Profile) -> Profile:
    """Return ``profile`` without wheel paths that the truth does not have."""
    names = {track.name for track in truth.tracks}
    kept = tuple(track for track in profile.tracks if track.name in names)
    return Profile(profile.interval_m, kept, profile.start_m)


def _means(row: FloatArray, count: int) -> FloatArray:
    whole = row.size // count * count
    return np.asarray(row[:whole].reshape(-1, count).mean(axis=1))


def _motion(answer: Answer, track: str, at_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return height of the body in m, high-pass filtered, and speed in m/s at places ``at_m``.

    The laser measures how far the body is above the road: both together are the body's height.
    """
    recording, truth = answer.taken.recording, answer.taken.truth
    encoder = recording.channel("distance")
    seen = np.isfinite(encoder.values)
    times, travelled = encoder.times_s[seen], np.maximum.accumulate(encoder.values[seen])
    # A stop passes a place once: at its end.
    passed_s = np.interp(at_m, travelled + 1e-9 * np.arange(travelled.size), times)
    half_s = 0.5
    ahead = np.interp(passed_s + half_s, times, travelled)
    speed = ahead - np.interp(passed_s - half_s, times, travelled)
    laser = recording.find("height", track)
    if laser is None:
        return np.zeros_like(at_m), speed
    known = np.isfinite(laser.values)
    above = np.interp(passed_s, laser.times_s[known], laser.values[known])
    road = np.interp(at_m, truth.distance_m, truth.track(track).elevation)
    step_m = float(at_m[1] - at_m[0])
    return high_pass(above + road, step_m), speed
