"""The floor of the stationary checks: a plate slid under the laser must be in the profile."""

from dataclasses import dataclass, replace

import numpy as np

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.classes import DeviceClass, Limits
from floatref_conformance.errors import SuiteError
from floatref_conformance.verdict import Measurement

PLATE_M = 0.005
"""Thickness of the plate, in m."""
SHARES = {DeviceClass.NOMINAL: 0.10, DeviceClass.ADEQUATE: 0.05, DeviceClass.REFERENCE: 0.02}
"""How much of a known bump may be lost or added, away from events."""
LIMITS: Limits = {c: 1000.0 * PLATE_M * share for c, share in SHARES.items()}
"""Largest error of the plate's rise, in mm."""
GAP_M = 0.25
"""What is left out beside each edge: the base length of the IRI's moving average."""
SHOULDER_M = 5.0
"""Longest stretch of ground beside the plate that its top is compared with."""
FLAT_M = 1e-6
"""The truth moves less than this, in m, where the laser sees bare ground or the plate's top."""


@dataclass(frozen=True)
class Plate:
    """Where the plate lies in one wheel path: its top, and the ground on both sides, in m."""

    before: tuple[float, float]
    top: tuple[float, float]
    behind: tuple[float, float]

    @classmethod
    def found(cls, truth: Profile, track: str) -> "Plate":
        """Return where the plate lies in ``truth``; SuiteError if there is none."""
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
        """Return how far the top stands above the ground beside it, in m.

        A level and a slope of the whole cancel. Raises DeviceError if one of the points has no
        elevation.
        """
        before, top, behind = (
            float(np.mean(stretch(profile, track, *ends)))
            for ends in (self.before, self.top, self.behind)
        )
        return top - (before + behind) / 2.0


def measure_plate(profile: Profile, truth: Profile, track: str) -> Measurement:
    """Return the difference between the plate in ``profile`` and in ``truth``, in mm.

    The truth is filtered alike: HPF_B3x2, −3 dB at 91.44 m.
    """
    plate = Plate.found(truth, track)
    filtered = high_pass(truth.track(track).elevation, truth.interval_m)
    alike = replace(truth, tracks=(ProfileTrack.of(track, filtered),))
    error = abs(plate.rise(profile, track) - plate.rise(alike, track))
    return Measurement("plate height error", track, 1000.0 * error, "mm", LIMITS)
