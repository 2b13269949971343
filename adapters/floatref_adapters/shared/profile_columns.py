"""A profile as columns and metadata: what a table of it holds, in files and in memory."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref import InputError, Profile, ProfileTrack

DISTANCE = "distance_m"
ELEVATION, VALID, SIGMA = "_elevation_m", "_valid", "_sigma_m"
"""How the columns of a wheel path end."""


class Description(NamedTuple):
    """The profile of a table, as its metadata describe it."""

    tracks: tuple[str, ...]
    interval_m: float
    start_m: float
    pipeline: str
    settings: Mapping[str, Any]
    provenance: Mapping[str, Any]

    @property
    def columns(self) -> list[str]:
        """The columns that have to be there."""
        return [DISTANCE, *(f"{t}{end}" for t in self.tracks for end in (ELEVATION, VALID))]

    @property
    def sigma_columns(self) -> list[str]:
        """The columns that may be there."""
        return [f"{track}{SIGMA}" for track in self.tracks]

    def profile(self, tracks: Sequence[ProfileTrack]) -> Profile:
        """Return the profile of ``tracks``."""
        return Profile(
            self.interval_m,
            tuple(tracks),
            self.start_m,
            self.pipeline,
            self.settings,
            self.provenance,
        )


def make_columns(profile: Profile, first: int, last: int) -> dict[str, NDArray[Any]]:
    """Return points ``first`` to ``last`` by column; only the distance is not a view."""
    last = min(last, profile.tracks[0].elevation.size)
    steps = np.arange(first, last, dtype=np.float64)
    columns: dict[str, NDArray[Any]] = {DISTANCE: profile.start_m + profile.interval_m * steps}
    for track in profile.tracks:
        columns[f"{track.name}{ELEVATION}"] = track.elevation[first:last]
        columns[f"{track.name}{VALID}"] = track.valid[first:last]
        if track.sigma is not None:
            columns[f"{track.name}{SIGMA}"] = track.sigma[first:last]
    return columns


def make_metadata(profile: Profile) -> dict[str, str]:
    """Return what made ``profile``, as text; settings and provenance are JSON, NaN is null.

    Raises InputError for what JSON cannot hold.
    """
    return {
        "interval_m": repr(profile.interval_m),
        "start_m": repr(profile.start_m),
        "pipeline": profile.pipeline,
        "tracks": as_json([track.name for track in profile.tracks], "tracks"),
        "settings": as_json(profile.settings, "settings"),
        "provenance": as_json(profile.provenance, "provenance"),
    }


def read_description(metadata: Mapping[str, str]) -> Description:
    """Return what ``metadata`` say; InputError naming the key that is missing or wrong."""
    tracks = _json(metadata, "tracks", list)
    if not tracks or not all(isinstance(name, str) for name in tracks):
        raise InputError("metadata tracks names no tracks; write the file again")
    return Description(
        tuple(tracks),
        _number(metadata, "interval_m"),
        _number(metadata, "start_m"),
        metadata.get("pipeline", ""),
        _json(metadata, "settings", dict),
        _json(metadata, "provenance", dict),
    )


def as_json(value: Any, where: str) -> str:
    """Return ``value`` as JSON, NaN as null; InputError for what that cannot hold, by ``where``."""
    try:
        return json.dumps(_plain(value), allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InputError(f"{where} is not to be written as JSON: {error}") from error


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and math.isnan(value) else value


def _json(metadata: Mapping[str, str], key: str, kind: type) -> Any:
    text = metadata.get(key, "")
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, kind):
        raise InputError(f"metadata {key} is {text[:40]!r}; it must be JSON, as floatref writes it")
    return value


def _number(metadata: Mapping[str, str], key: str) -> float:
    text = metadata.get(key, "")
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"metadata {key} is {text[:40]!r}; it must be a number of metres")
    return value
