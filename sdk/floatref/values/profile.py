"""A profile: road elevation per wheel path at a constant distance interval."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray, frozen

SHORTEST_INTERVAL_M = 1e-5
LONGEST_INTERVAL_M = 1000.0
FARTHEST_M = 1e10
"""Largest distance from the origin, in m: beyond it float64 is too coarse for an interval."""


@dataclass(frozen=True, eq=False)
class ProfileTrack:
    """Elevation in m of one wheel path, its validity, and its 1-σ in m where known.

    A point with NaN elevation is never valid.
    """

    name: str
    elevation: FloatArray
    valid: BoolArray
    sigma: FloatArray | None = None

    @classmethod
    def of(
        cls,
        name: str,
        elevation: ArrayLike,
        valid: ArrayLike | None = None,
        sigma: ArrayLike | None = None,
    ) -> "ProfileTrack":
        """Return a track; without ``valid`` every finite point is valid."""
        z = frozen(elevation)
        mask = (
            np.isfinite(z) if valid is None else np.asarray(valid, dtype=np.bool_) & np.isfinite(z)
        )
        mask.flags.writeable = False
        return cls(name, z, mask, None if sigma is None else frozen(sigma))

    def __post_init__(self) -> None:
        """Refuse a track without points, with infinities, or with columns of unequal length."""
        n = self.elevation.size
        if n == 0:
            raise InputError(f"track {self.name}: no points")
        if np.isinf(self.elevation).any():
            raise InputError(f"track {self.name}: infinite elevation; mark missing points as NaN")
        if self.valid.size != n or (self.sigma is not None and self.sigma.size != n):
            raise InputError(f"track {self.name}: elevation, valid and sigma differ in length")
        if (self.valid & np.isnan(self.elevation)).any():
            raise InputError(f"track {self.name}: a point without elevation is marked valid")
        if self.sigma is not None and (self.sigma < 0).any():
            raise InputError(f"track {self.name}: sigma is below zero; give a standard deviation")


@dataclass(frozen=True, eq=False)
class Profile:
    """Point k of every track lies at ``start_m + k * interval_m`` on the axis of distance."""

    interval_m: float
    tracks: tuple[ProfileTrack, ...]
    start_m: float = 0.0
    pipeline: str = ""
    settings: Mapping[str, Any] = field(default_factory=dict)
    provenance: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse an impossible interval, no tracks, or tracks that differ in length."""
        if not SHORTEST_INTERVAL_M <= self.interval_m <= LONGEST_INTERVAL_M:
            raise InputError(
                f"interval_m is {self.interval_m:g}; give it in m, between 0.00001 and 1000"
            )
        if not abs(self.start_m) <= FARTHEST_M:
            raise InputError(
                f"start_m is {self.start_m:g}; give it in m, within {FARTHEST_M:.0f} of zero"
            )
        if not self.tracks:
            raise InputError("the profile has no tracks")
        if len({t.elevation.size for t in self.tracks}) > 1:
            raise InputError("the profile's tracks differ in length")
        if len({t.name for t in self.tracks}) < len(self.tracks):
            raise InputError("two tracks of the profile have the same name")
        object.__setattr__(self, "settings", MappingProxyType(dict(self.settings)))
        object.__setattr__(self, "provenance", MappingProxyType(dict(self.provenance)))

    @property
    def distance_m(self) -> FloatArray:
        """Distance of every point in m."""
        steps = np.arange(self.tracks[0].elevation.size, dtype=np.float64)
        return self.start_m + self.interval_m * steps

    @property
    def length_m(self) -> float:
        """Distance from the first to the last point in m."""
        return self.interval_m * (self.tracks[0].elevation.size - 1)

    def track(self, name: str) -> ProfileTrack:
        """Return the track called ``name``; InputError if it is missing."""
        for track in self.tracks:
            if track.name == name:
                return track
        here = ", ".join(t.name for t in self.tracks)
        raise InputError(f"track {name}: missing; the profile holds {here}")
