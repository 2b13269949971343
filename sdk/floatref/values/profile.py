"""A profile: road elevation per wheel path at a constant distance interval."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import BoolArray, FloatArray, frozen
from floatref.values.display.html_table import html_table
from floatref.values.display.iri_table import ProfileIri
from floatref.values.display.short_text import (
    NO_VALUE,
    in_mm_or_m,
    join_some,
    percent,
    range_text,
    share_of,
    shorten,
)
from floatref.values.display.similar_names import hint_at
from floatref.values.display.views import view
from floatref.values.scanning import chunks, first_where

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame
    from xarray import Dataset

SHORTEST_INTERVAL_M = 1e-5
LONGEST_INTERVAL_M = 1000.0
FARTHEST_M = 1e10
"""Largest distance from the origin, in m: beyond it float64 is too coarse for an interval."""


@dataclass(frozen=True, eq=False, repr=False)
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
        mask = np.asarray(True if valid is None else valid, dtype=np.bool_)
        whole = np.broadcast_to(mask, z.shape) if mask.size == 1 else mask
        return cls.taking(name, z, np.array(whole), sigma)

    @classmethod
    def taking(
        cls, name: str, elevation: FloatArray, valid: BoolArray, sigma: ArrayLike | None = None
    ) -> "ProfileTrack":
        """Return a track that has ``valid`` for its own; points without elevation are taken out.

        Raises InputError for arrays of other shapes.
        """
        if valid.shape == elevation.shape:
            for first, part in chunks(elevation):
                valid[first : first + part.size] &= np.isfinite(part)
        valid.flags.writeable = False
        return cls(name, frozen(elevation), valid, None if sigma is None else frozen(sigma))

    def __post_init__(self) -> None:
        """Refuse a track without points, with infinities, or with columns of unequal length."""
        n = self.elevation.size
        if n == 0:
            raise InputError(f"track {self.name}: no points")
        # In pieces: a file of an hour is never in memory as a whole.
        if first_where(np.isinf, self.elevation) is not None:
            raise InputError(f"track {self.name}: infinite elevation; mark missing points as NaN")
        if self.valid.shape != (n,) or (self.sigma is not None and self.sigma.size != n):
            raise InputError(f"track {self.name}: elevation, valid and sigma differ in length")
        if self._validates_nan():
            raise InputError(f"track {self.name}: a point without elevation is marked valid")
        if self.sigma is not None and first_where(lambda s: s < 0, self.sigma) is not None:
            raise InputError(f"track {self.name}: sigma is below zero; give a standard deviation")

    def _validates_nan(self) -> bool:
        return any(
            bool((self.valid[first : first + part.size] & np.isnan(part)).any())
            for first, part in chunks(self.elevation)
        )

    def __repr__(self) -> str:
        """Return name, points and validity on one line."""
        sigma = "" if self.sigma is None else ", with sigma"
        return f"ProfileTrack({self.elevation.size} points, {self._short}{sigma})"

    @property
    def _short(self) -> str:
        return f"{shorten(self.name)} {percent(share_of(self.valid))} valid"

    @property
    def _cells(self) -> tuple[str, str, str, str]:
        """Name, share that is valid, and of the valid points the elevations and usual sigma."""
        heights = range_text(self.elevation[self.valid], "m")
        known = np.zeros(0) if self.sigma is None else self.sigma[self.valid]
        known = known[np.isfinite(known)]
        sigma = f"{1000.0 * np.median(known):.3g} mm" if known.size else NO_VALUE
        return shorten(self.name), percent(share_of(self.valid)), heights, sigma


@dataclass(frozen=True, eq=False, repr=False)
class Profile:
    """Point k of every track lies at ``start_m + k * interval_m`` on the axis of distance.

    ``profile["left"]`` is a wheel path; ``in`` and iteration go by their names, as in a dict.
    """

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
        here = ", ".join(self)
        raise InputError(f"track {name}: missing; the profile holds {here}{hint_at(name, self)}")

    def __getitem__(self, name: str) -> ProfileTrack:
        """Return the wheel path called ``name``; InputError if it is missing."""
        return self.track(name)

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the wheel paths."""
        return (track.name for track in self.tracks)

    def __repr__(self) -> str:
        """Return length, interval, pipeline and validity of each wheel path, on one line."""
        tracks = join_some([track._short for track in self.tracks])
        return f"Profile({self._made}; {tracks})"

    def _repr_html_(self) -> str:
        header = ("wheel path", "valid", "elevation where valid", "median 1-σ where valid")
        return html_table(f"Profile: {self._made}", header, [track._cells for track in self.tracks])

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    @property
    def _made(self) -> str:
        pipeline = shorten(self.pipeline) or "no pipeline named"
        return f"{self.length_m:.2f} m every {in_mm_or_m(self.interval_m)}, {pipeline}"

    def iri(self) -> ProfileIri:
        """Return the IRI of the valid points of every wheel path in m/km, and that of all points.

        ``profile.iri()["left"].valid_m_per_km`` is the mean over the share ``counted_share`` of
        the road: all stretches of valid points of more than the 11 m that the car needs to start.
        It is NaN without one. Raises InputError for an interval above 2 m.
        """
        return cast(ProfileIri, view("profile_iri")(self))

    def plot(self) -> "Figure":
        """Return a figure of elevation and short-interval roughness over the distance in m.

        Lines are solid where points are valid and dotted where they are not; stretches in which
        any wheel path is invalid are shaded. Raises InputError for an elevation beyond 1000 km,
        and if matplotlib, of the extra ``plot``, is missing.
        """
        return cast("Figure", view("profile_figure")(self))

    def to_pandas(self) -> "DataFrame":
        """Return a read-only frame with index `distance_m` in m.

        Columns are `left_elevation_m`, `left_valid` and, if known, `left_sigma_m`, and so on for
        every wheel path; `attrs` holds their `units`, and what made the profile. Raises InputError
        if pandas, of the extra ``adapters``, is missing.
        """
        return cast("DataFrame", view("profile_to_pandas")(self))

    def to_xarray(self) -> "Dataset":
        """Return a data set with dimensions `track` and `distance`, units as attributes.

        Variables are `elevation` and `sigma` in m and `valid`. Raises InputError if xarray, of the
        extra ``adapters``, is missing.
        """
        return cast("Dataset", view("profile_to_xarray")(self))
