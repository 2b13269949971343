"""A profile directory to which points are appended, and which can be read at every moment.

Points are first written behind the end of their files, where no reader looks: `profile.json` states
in `points` how many there are. It is written beside and renamed once they are on the disk.
"""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref.files.document import plain, write_document
from floatref.files.profile_directory import DOCUMENT, FORMAT, SCHEMA
from floatref.files.samples import SAMPLE, free_name, read_flags, read_samples
from floatref.files.schema import enforce
from floatref.values.arrays import FloatArray
from floatref.values.profile import ProfileTrack

CHUNK = 1 << 20
"""Points of unknown 1-σ that are written at once."""


def append_durably(path: Path, size: int, data: bytes) -> int:
    """Write ``data`` to ``path`` behind its first ``size`` bytes; return the size it has then.

    What was there behind ``size`` is gone: bytes of a program that was killed. The data is on the
    disk when this returns. Raises InputError for a file that is shorter, or cannot be written.
    """
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o666)
        with open(handle, "r+b") as stream:
            found = stream.seek(0, os.SEEK_END)
            if found < size:
                raise InputError(
                    f"{path}: {found} bytes, but {size} were written; the file is truncated, copy "
                    "the directory again"
                )
            stream.truncate(size)
            stream.seek(size)
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
    except OSError as error:
        reason = error.strerror or str(error)
        raise InputError(
            f"{path}: cannot be written ({reason}); free space there, then resume"
        ) from error
    return size + len(data)


@dataclass
class GrowingProfile:
    """The points in a directory.

    Attributes:
        directory: where they are.
        interval_m: distance between points in m.
        names: of the wheel paths.
        first: number of the first point; None before there are any.
        count: how many there are.
        with_sigma: names of the wheel paths with a 1-σ.
    """

    directory: Path
    interval_m: float
    names: Sequence[str]
    first: int | None = None
    count: int = 0
    with_sigma: set[str] = field(default_factory=set)

    @property
    def end(self) -> int | None:
        """Number behind the last point; None before the first."""
        return None if self.first is None else self.first + self.count

    def append(self, first: int, tracks: Sequence[ProfileTrack]) -> None:
        """Write the points of ``tracks``, the first of which has the number ``first``.

        No reader sees them before `publish`. Raises InputError for points that do not follow on,
        and if they cannot be written.
        """
        if self.end not in (None, first):
            raise InputError(f"points from {first} on do not follow those up to {self.end}")
        for track, files in zip(tracks, self._files(), strict=True):
            self._append_to(files[0], 8, track.elevation.astype(SAMPLE).tobytes())
            self._append_to(files[1], 1, track.valid.astype(np.uint8).tobytes())
            if track.sigma is not None or track.name in self.with_sigma:
                self._append_sigma(files[2], track)
        self.first = first if self.first is None else self.first
        self.count += tracks[0].elevation.size

    def read(self, first: int, end: int) -> list[ProfileTrack]:
        """Return points ``first`` to ``end`` - 1, which are there."""
        assert self.first is not None
        low, count = first - self.first, end - first
        return [self._read_track(name, low, count) for name in self.names]

    def publish(self, description: Mapping[str, Any], growing: bool) -> None:
        """Write `profile.json` with ``description``: pipeline, settings and provenance.

        A profile that is no longer ``growing`` states no number of points: its files have ended.
        """
        document: dict[str, Any] = plain(self._describe(description, growing), "profile")
        path = self.directory / DOCUMENT
        enforce(document, SCHEMA, path)
        with replace_file(path, overwrite=True) as beside:
            write_document(document, beside)

    def _describe(self, description: Mapping[str, Any], growing: bool) -> dict[str, Any]:
        assert self.first is not None
        tracks = []
        for name, (elevation, valid, sigma) in zip(self.names, self._files(), strict=True):
            entry = {"name": name, "elevation_file": elevation, "valid_file": valid}
            tracks.append(entry | ({"sigma_file": sigma} if name in self.with_sigma else {}))
        return {
            "format": FORMAT,
            "interval_m": self.interval_m,
            "start_m": self.first * self.interval_m,
            **({"points": self.count} if growing else {}),
            **description,
            "tracks": tracks,
        }

    def _files(self) -> list[tuple[str, str, str]]:
        taken: set[str] = set()
        return [
            (
                free_name(name, ".f64", taken),
                free_name(f"{name}.valid", ".u8", taken),
                free_name(f"{name}.sigma", ".f64", taken),
            )
            for name in self.names
        ]

    def _append_to(self, name: str, item_bytes: int, data: bytes) -> None:
        append_durably(self.directory / name, self.count * item_bytes, data)

    def _append_sigma(self, name: str, track: ProfileTrack) -> None:
        size = 0
        if track.name in self.with_sigma:
            size = self.count * 8
        for begin in range(size // 8, self.count, CHUNK):
            unknown = _unknown(min(CHUNK, self.count - begin))
            size = append_durably(self.directory / name, size, unknown.tobytes())
        sigma = _unknown(track.elevation.size) if track.sigma is None else track.sigma
        append_durably(self.directory / name, size, sigma.astype(SAMPLE).tobytes())
        self.with_sigma.add(track.name)

    def _read_track(self, name: str, low: int, count: int) -> ProfileTrack:
        files = dict(zip(self.names, self._files(), strict=True))[name]
        paths = [self.directory / each for each in files]
        end = low + count
        # Copies, for the files go on growing.
        elevation = read_samples(paths[0], end)[low:].copy()
        valid = read_flags(paths[1], end)[low:]
        sigma = None
        if name in self.with_sigma:
            sigma = read_samples(paths[2], end)[low:].copy()
        return ProfileTrack.of(name, elevation, valid, sigma)


def _unknown(count: int) -> FloatArray:
    return np.full(count, np.nan, SAMPLE)
