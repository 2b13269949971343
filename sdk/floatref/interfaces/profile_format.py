"""Profile formats: each writes a profile to one kind of file and reads it back."""

from pathlib import Path
from typing import Protocol

from floatref.errors import InputError
from floatref.files import open_bytes, read_profile, write_profile, write_profile_csv
from floatref.files.constant_interval import DISTANCE
from floatref.files.profile_directory import DOCUMENT
from floatref.values.profile import Profile

LONGEST_HEADER = 1 << 20
"""Bytes within which the header of a CSV must name the column of distance."""


class ProfileFormat(Protocol):
    """Writes and reads one kind of profile file; `name` is what `--format` takes.

    `suffix`, such as ".erd", has small letters only. A format need not handle an existing file or a
    write that fails half-way: it gets the name of a new file, with the user's suffix, and the file
    gets its final name when `write` has returned. A format that needs a library may have a method
    `check_installed`, which raises InputError if the library is missing; it is called before the
    profile is computed.
    """

    name: str
    suffix: str
    summary: str

    def recognises(self, path: Path) -> bool:
        """Return whether the file is of this format, from its first bytes or its path."""

    def read(self, path: Path) -> Profile:
        """Return the profile in ``path``; InputError, in one line, if it cannot be used."""

    def write(self, profile: Profile, path: Path) -> None:
        """Write ``profile`` to the new file ``path``; InputError if the format cannot hold it."""


class ProfileDirectory:
    """floatref's own profile directory: the only format that is a folder and has no suffix."""

    name = "profile"
    suffix = ""
    summary = "floatref-profile/1: profile.json and raw float64 files beside it"

    def recognises(self, path: Path) -> bool:
        """Return whether ``path`` is a JSON file or a folder that holds a profile.json."""
        return path.suffix.lower() == ".json" or (path / DOCUMENT).is_file()

    def read(self, path: Path) -> Profile:
        """Return the profile; InputError if it breaks the format."""
        return read_profile(path)

    def write(self, profile: Profile, path: Path) -> None:
        """Write ``profile`` as a new folder."""
        write_profile(profile, path)


class ProfileTable:
    """floatref's own CSV: columns distance_m, <track>_elevation_m, <track>_valid."""

    name = "csv"
    suffix = ".csv"
    summary = "table of distance, elevation and validity"

    def recognises(self, path: Path) -> bool:
        """Return whether the first row of ``path`` names a column of distance."""
        if path.suffix.lower() == ".json" or path.is_dir():
            return False
        try:
            with open_bytes(path) as stream:
                header = stream.readline(LONGEST_HEADER).removeprefix(b"\xef\xbb\xbf")
        except InputError:
            return False
        return DISTANCE.encode() in (name.strip(b' "\r\n') for name in header.split(b","))

    def read(self, path: Path) -> Profile:
        """Return the profile; InputError if the file is not one."""
        return read_profile(path)

    def write(self, profile: Profile, path: Path) -> None:
        """Write ``profile`` as a table."""
        write_profile_csv(profile, path)
