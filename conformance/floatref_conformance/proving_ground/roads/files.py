"""A road from a file of the user's: a profile of any format that floatref reads, or a surface."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from floatref.errors import InputError
from floatref.files.fingerprint import fingerprint_native
from floatref.files.sources import name_errors
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.proving_ground.roads.crg import SUFFIX, crg_road
from floatref_conformance.proving_ground.roads.measured import measured_road
from floatref_conformance.proving_ground.roads.road import Road

FILE_ROAD = "measured:"
"""How the road of a scenario starts that is a file."""


def file_of(road: str) -> Path | None:
    """Return the file of a scenario's road, or None for a road of another kind.

    Raises InputError if the name of the file is missing.
    """
    if not road.startswith(FILE_ROAD):
        return None
    name = road.removeprefix(FILE_ROAD)
    if not name or "\0" in name:
        raise InputError(f"road {road!r}: give a file, as in {FILE_ROAD}road.csv")
    return Path(name)


def is_surface(path: Path) -> bool:
    """Return whether a file is a surface by its suffix, ``.crg``, and not a profile."""
    return path.suffix.lower() == SUFFIX


def road_from(path: Path, length_m: float, tracks: Sequence[str]) -> Road:
    """Make a road of a profile or of a surface, usable up to ``length_m``.

    A profile that ends before is mirrored through its end points (`measured`), a surface in its
    last cross section (`crg`). The tracks of a profile are found by their names; the only track of
    a profile is every wheel path.

    Raises:
        InputError: in one line that names the file, if it cannot be read or makes no road.
        PluginError: for any other error of a format.
    """
    if is_surface(path):
        return crg_road(path, length_m, tracks=tracks)
    # Plug-ins are looked up only when there is a file for them.
    from floatref.engine.formats import profile_of

    profile = profile_of(path)
    with name_errors(path):
        elevation = {name: _elevation(profile, name) for name in tracks}
        return measured_road(elevation, profile.interval_m, length_m, tracks=tracks)


def digest_files(path: Path) -> dict[str, str]:
    """Return the SHA-256 of the file, or of every file of a profile directory, by name.

    Raises InputError for a file that cannot be read.
    """
    return fingerprint_native(path.parent if path.name == "profile.json" else path)


def _elevation(profile: Profile, name: str) -> FloatArray:
    """Return the elevation of one wheel path; InputError for a hole or a missing track."""
    only = profile.tracks[0] if len(profile.tracks) == 1 else profile.track(name)
    missing = np.isnan(only.elevation)
    if missing.any():
        at = profile.distance_m[int(np.argmax(missing))]
        raise InputError(
            f"track {only.name}: elevation is missing at {at:g} m; fill the hole or cut it off"
        )
    return only.elevation
