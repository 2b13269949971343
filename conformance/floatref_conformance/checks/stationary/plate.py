"""The floor of the stationary checks: the profile contains a plate slid under the laser."""

from dataclasses import dataclass, replace

import numpy as np

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits, same_limit
from floatref_conformance.errors import SuiteError

PLATE_M = 0.005
"""Thickness of the plate, in m."""
SHARES = {DeviceClass.NOMINAL: 0.10, DeviceClass.ADEQUATE: 0.05, DeviceClass.REFERENCE: 0.02}
"""Largest error of a known bump away from events, as a share of its height."""
LIMITS: Limits = {c: 1000.0 * PLATE_M * share for c, share in SHARES.items()}
"""Largest error of the plate's rise, in mm."""
GAP_M = 0.25
"""Length in m left out beside each edge: the base length of the IRI's moving average."""
SHOULDER_M = 1.5
"""Largest length in m of the ground on each side with which the top is compared."""
NOMINAL_DISPLACEMENT_M = 0.05
"""Largest displacement of the plate in class nominal and adequate, in m."""
PLACE_LIMITS: Limits = same_limit(NOMINAL_DISPLACEMENT_M, NOMINAL_DISPLACEMENT_M / 2)
"""Largest displacement of the plate, in m."""
FINE_M = 0.002
"""Spacing of the points at which the two edges are evaluated, in m."""
FLAT_M = 1e-6
"""Largest deviation of the truth, in m, on bare ground or on the plate's top."""


@dataclass(frozen=True)
class Plate:
    """Place of the plate in one wheel path: its top, and the ground on both sides, in m."""

    before: tuple[float, float]
    top: tuple[float, float]
    behind: tuple[float, float]

    @classmethod
    def find(cls, truth: Profile, track: str) -> "Plate":
        """Return the place of the plate in ``truth``; SuiteError without a plate."""
        elevation = truth.track(track).elevation
        ground = float(np.median(elevation))
        lifted = np.flatnonzero(np.abs(elevation - ground) > FLAT_M)
        top = np.flatnonzero(np.abs(elevation - ground - PLATE_M) <= FLAT_M)
        if not top.size:
            raise SuiteError(f"track {track}: no plate of {PLATE_M} m in the truth")
        start, first, last, end = truth.distance_m[[lifted[0], top[0], top[-1], lifted[-1]]]
        length = min(SHOULDER_M, float(last - first))
        return cls(
            (start - GAP_M - length, start - GAP_M),
            (first + GAP_M, last - GAP_M),
            (end + GAP_M, end + GAP_M + length),
        )

    def rise(self, profile: Profile, track: str) -> float:
        """Return the height of the top above the ground beside it, in m.

        A level and a slope of the whole cancel. Raises DeviceError if one of the points has no
        elevation.
        """
        before, top, behind = self._levels(profile, track)
        return top - (before + behind) / 2.0

    def place(self, profile: Profile, track: str) -> float | None:
        """Return the place of the middle between the two edges, in m.

        An edge is at the place of a step with the same area between ground and top; noise and
        symmetrical smoothing do not move it. None if an edge is lower than half the plate.
        """
        before, top, behind = self._levels(profile, track)
        if top - max(before, behind) < PLATE_M / 2:
            return None
        start, end = self.before[1], self.top[0]
        rising = end - (end - start) * _height(profile, track, start, end, before, top)
        start, end = self.top[1], self.behind[0]
        falling = start + (end - start) * _height(profile, track, start, end, behind, top)
        return float(rising + falling) / 2.0

    def _levels(self, profile: Profile, track: str) -> tuple[float, float, float]:
        before, top, behind = (
            float(np.mean(stretch(profile, track, *ends)))
            for ends in (self.before, self.top, self.behind)
        )
        return before, top, behind


def measure_plate(profile: Profile, truth: Profile, track: str) -> tuple[Measurement, ...]:
    """Return the errors of the plate's height, in mm, and of its place, in m.

    The truth is filtered in the same way: HPF_B3x2, −3 dB at 91.44 m. Half the interval of
    ``profile``, the resolution of an edge's place, does not count. For a profile with less than
    half of an edge no place is measured: its height fails.
    """
    plate = Plate.find(truth, track)
    filtered = high_pass(truth.track(track).elevation, truth.interval_m)
    alike = replace(truth, tracks=(ProfileTrack.of(track, filtered),))
    error = abs(plate.rise(profile, track) - plate.rise(alike, track))
    height = Measurement("plate height error", track, 1000.0 * error, "mm", LIMITS)
    place, true_place = plate.place(profile, track), plate.place(alike, track)
    if place is None or true_place is None:
        return (height,)
    moved = max(abs(place - true_place) - profile.interval_m / 2, 0.0)
    return height, Measurement("plate displacement", track, moved, "m", PLACE_LIMITS)


def _height(
    profile: Profile, track: str, start: float, end: float, ground: float, top: float
) -> float:
    """Return the mean elevation from ``start`` to ``end``, ``ground`` as 0 and ``top`` as 1."""
    count = round((end - start) / FINE_M)
    at = start + (end - start) / count * (np.arange(count) + 0.5)
    seen = np.interp(at, profile.distance_m, profile.track(track).elevation)
    return (float(np.mean(seen)) - ground) / (top - ground)
