"""Where a run was on the earth, along the axis of its profile, from the fixes of a receiver."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from floatref.batch.results.positions import is_located, places
from floatref.errors import InputError
from floatref.files import read_recording
from floatref.measures.locating.placement import Placement
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile

STEP_M = 0.5
"""Between the places of a trail."""


@dataclass(frozen=True, eq=False)
class Trail:
    """Latitude and longitude in degrees at ``distance_m``; all of shape (n,), NaN if unknown."""

    distance_m: FloatArray
    latitude: FloatArray
    longitude: FloatArray

    def within(self, start_m: float, end_m: float) -> bool:
        """Return whether every place from ``start_m`` to ``end_m`` is known, to one step."""
        at = self.distance_m
        inside = (at >= start_m) & (at <= end_m)
        covers = bool(inside.any()) and at.min() <= start_m + STEP_M and at.max() >= end_m - STEP_M
        return covers and bool(np.isfinite((self.latitude + self.longitude)[inside]).all())


def read_trail(path: Path, profile: Profile) -> Trail | None:
    """Return where the recording ``path`` was along ``profile``, which was made of it.

    None for what is no recording directory of ours, and for one without fixes.
    """
    if not (path / "recording.json").is_file():
        return None
    try:
        recording = read_recording(path)
    except InputError:
        return None
    if not is_located(recording):
        return None
    at = profile.start_m + np.arange(0.0, profile.length_m + 0.5 * STEP_M, STEP_M)
    return Trail(at, *places(recording, recording.tracks[0], at))


def place_trail(trail: Trail, run: Profile, placement: Placement) -> Trail:
    """Return ``trail`` of ``run`` on the axis to which ``placement`` moves it, in rising order."""
    if not placement.moves:
        return trail
    at, order = trail.distance_m, slice(None)
    if placement.reversed:
        at, order = 2.0 * run.start_m + run.length_m - at, slice(None, None, -1)
    moved = at[order] * placement.distance_factor - placement.offset_m
    return Trail(moved, trail.latitude[order], trail.longitude[order])
