"""The profile directory, `floatref-profile/1`, and reading a profile of either kind."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.atomic import replace_directory
from floatref.files.document import plain, read_document, write_document
from floatref.files.profile_csv import read_profile_csv
from floatref.files.samples import free_name, read_flags, read_samples, write_flags, write_samples
from floatref.files.schema import enforce
from floatref.files.sources import document_path, name_errors
from floatref.values.profile import Profile, ProfileTrack

DOCUMENT = "profile.json"
"""Name of the JSON file of a profile directory."""
FORMAT = "floatref-profile/1"
SCHEMA = "floatref-profile-1"


def read_profile(path: Path) -> Profile:
    """Return the profile at ``path``: a directory, its profile.json, or a CSV of floatref.

    Elevation is mapped read-only from its files. Raises InputError with one line naming the file,
    the track and the value for anything that breaks the format.
    """
    source = document_path(path, DOCUMENT)
    if source.suffix.lower() != ".json":
        return read_profile_csv(source)
    document = read_document(source)
    enforce(document, SCHEMA, source)
    count = document.get("points")
    tracks = tuple(_track(entry, source, count) for entry in document["tracks"])
    with name_errors(source):
        return Profile(
            interval_m=float(document["interval_m"]),
            tracks=tracks,
            start_m=float(document.get("start_m", 0.0)),
            pipeline=document.get("pipeline", ""),
            settings=document.get("settings", {}),
            provenance=document.get("provenance", {}),
        )


def write_profile(profile: Profile, directory: Path, overwrite: bool = False) -> None:
    """Write ``profile`` as a new ``directory``, complete or not at all.

    NaN in settings and provenance is written as null. Raises InputError if ``directory`` exists
    and ``overwrite`` is false, cannot be written, or if the profile breaks the format.
    """
    document = _describe(profile)
    enforce(document, SCHEMA, directory)
    with replace_directory(directory, overwrite, DOCUMENT) as folder:
        for track, entry in zip(profile.tracks, document["tracks"], strict=True):
            write_samples(track.elevation, folder / entry["elevation_file"])
            write_flags(track.valid, folder / entry["valid_file"])
            if track.sigma is not None:
                write_samples(track.sigma, folder / entry["sigma_file"])
        write_document(document, folder / DOCUMENT)


def _track(entry: Mapping[str, Any], source: Path, count: int | None) -> ProfileTrack:
    with name_errors(f"track {entry['name']}"):
        elevation = read_samples(source.with_name(entry["elevation_file"]), count)
        valid = sigma = None
        if "valid_file" in entry:
            valid = read_flags(source.with_name(entry["valid_file"]), count)
            _check_length(source, entry["valid_file"], valid.size, elevation.size)
        if "sigma_file" in entry:
            sigma = read_samples(source.with_name(entry["sigma_file"]), count)
            _check_length(source, entry["sigma_file"], sigma.size, elevation.size)
    with name_errors(source):
        return ProfileTrack.of(entry["name"], elevation, valid, sigma)


def _check_length(source: Path, name: str, found: int, expected: int) -> None:
    if found != expected:
        raise InputError(
            f"{source.with_name(name)}: {found} points, but the elevation has {expected}; "
            "one of the files is truncated, copy both again"
        )


def _describe(profile: Profile) -> dict[str, Any]:
    taken: set[str] = set()
    tracks = []
    for track in profile.tracks:
        entry = {
            "name": track.name,
            "elevation_file": free_name(track.name, ".f64", taken),
            "valid_file": free_name(f"{track.name}.valid", ".u8", taken),
        }
        if track.sigma is not None:
            entry["sigma_file"] = free_name(f"{track.name}.sigma", ".f64", taken)
        tracks.append(entry)
    document = {
        "format": FORMAT,
        "interval_m": profile.interval_m,
        "start_m": profile.start_m,
        "pipeline": profile.pipeline,
        "settings": profile.settings,
        "provenance": profile.provenance,
        "tracks": tracks,
    }
    described: dict[str, Any] = plain(document, "profile")
    return described
