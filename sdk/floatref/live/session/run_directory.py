"""The directory of a live run: a profile that grows, and all that the rest of the run depends on.

| file | content |
|---|---|
| `profile.json`, `….f64`, `….u8` | the final points so far |
| `windows.jsonl` | a line for each window: what made its points |
| `live.json` | the hello, and how far everything beside it counts |
| `live-N.npz` | the stream, as `LiveStream.save` writes it |

`live.json` is replaced last, when all it speaks of is on the disk. So whatever a killed program has
written beyond is not part of the run, and the points in it are those of the saved stream.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.atomic import check_target, replace_directory, replace_file
from floatref.files.document import plain, read_document, write_document
from floatref.files.growing_profile import GrowingProfile, append_durably
from floatref.files.profile_directory import DOCUMENT
from floatref.files.sources import open_bytes
from floatref.live.points import (
    LONGEST_GAP_M,
    LivePoints,
    describe_points,
    missing_points,
    record_of_window,
)
from floatref.live.stream import LiveStream, resume_stream

STATE, WINDOWS = "live.json", "windows.jsonl"
FORMAT = "floatref-live-run/1"
INLINE_BYTES = 2 << 20
"""Longest record of all windows in bytes that `profile.json` holds; a document has its limit."""


class RunDirectory:
    """Stores a run.

    Attributes:
        path: the directory.
        profile: its points.
        hello: the document of the hello that began it.
    """

    def __init__(self, path: Path, profile: GrowingProfile, hello: Mapping[str, Any]) -> None:
        """Take what `begin` or `reopen` has found."""
        self.path, self.profile, self.hello = path, profile, hello
        self._number = 0
        self._made: dict[str, Any] = {}
        self._windows_bytes = 0

    @classmethod
    def begin(
        cls, path: Path, hello: Mapping[str, Any], stream: LiveStream, sent: Mapping[str, int]
    ) -> "RunDirectory":
        """Make the directory at ``path`` for ``stream``; InputError if it exists."""
        check_target(path)
        with replace_directory(path, False, STATE) as folder:
            made = cls(folder, GrowingProfile(folder, stream.interval_m, stream.tracks), hello)
            made.store([], stream, sent)
        made.path = made.profile.directory = path
        return made

    @classmethod
    def reopen(cls, path: Path) -> tuple["RunDirectory", LiveStream, dict[str, int]]:
        """Return the run in ``path``, its stream and the number of the next sample by channel.

        Raises InputError for a directory that holds no run, or a damaged one.
        """
        state = _read_state(path)
        try:
            points = state["points"]
            profile = GrowingProfile(
                path, state["interval_m"], state["tracks"], points["first"], points["count"]
            )
            profile.with_sigma = set(points["with_sigma"])
            made = cls(path, profile, state["hello"])
            made._number, made._made = state["number"], state["made"]
            made._windows_bytes = state["windows_bytes"]
            stream = resume_stream(path / _stream_name(made._number))
            made._publish()
            made._remove_older()
            return made, stream, dict(state["next"])
        except (KeyError, TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{path / STATE}: is damaged; begin another run") from error

    def store(
        self, points: Sequence[LivePoints], stream: LiveStream, sent: Mapping[str, int]
    ) -> None:
        """Write the final ``points``, and the ``stream`` that has given them out, at once.

        ``sent`` has the number of samples of each channel that the stream was given. Every sample
        and point is on the disk when this returns, or the run is as before.
        """
        with self._unless_it_fails():
            self._append(points)
            # A number is never used again: live.json may name that of a try that was interrupted.
            self._number += 1
            stream.save(self.path / _stream_name(self._number))
            with replace_file(self.path / STATE, overwrite=True) as beside:
                write_document(self._describe(sent), beside)
        with suppress(OSError):
            self._remove_older()
        if points:
            self._publish()

    def finish(self, points: Sequence[LivePoints]) -> None:
        """Write the last final ``points``: the profile is complete, and cannot be resumed.

        Raises InputError if the run has no point.
        """
        with self._unless_it_fails():
            self._append(points)
        if self.profile.first is None:
            raise InputError("the stream has no final point; push samples of a vehicle that moves")
        inline = self._windows_bytes <= INLINE_BYTES
        self.profile.publish(self._description(inline), growing=False)
        _remove_state(self.path, inline)

    @contextmanager
    def _unless_it_fails(self) -> Iterator[None]:
        """Go back to what was stored before, unless `live.json` already names what is new."""
        profile = self.profile
        before = profile.first, profile.count, set(profile.with_sigma)
        windows = self._windows_bytes, self._made
        try:
            yield
        except BaseException:
            if not self._is_named():
                profile.first, profile.count, profile.with_sigma = before
                self._windows_bytes, self._made = windows
            raise

    def _is_named(self) -> bool:
        with suppress(InputError):
            found = _read_state(self.path)
            return bool(found["number"] == self._number and found["points"] == self._points())
        return False

    def _append(self, points: Sequence[LivePoints]) -> None:
        for each in filter(len, points):
            end = self.profile.end
            if end is not None and each.first + len(each) <= end:
                # Stored by a try that was interrupted behind it.
                continue
            gap = 0 if end is None else each.first - end
            if gap * each.interval_m > LONGEST_GAP_M:
                raise InputError(
                    f"no points for {gap * each.interval_m:.0f} m before "
                    f"{each.distance_m[0]:.2f} m; begin another run behind such a gap"
                )
            if gap > 0:
                self.profile.append(each.first - gap, missing_points(self.profile.names, gap))
            self.profile.append(each.first, each.tracks)
            if each.pipeline and not self._made.get("pipeline"):
                self._made = plain(describe_points(each), "profile")
            line = json.dumps(plain(record_of_window(each), "window"), allow_nan=False)
            self._windows_bytes = append_durably(
                self.path / WINDOWS, self._windows_bytes, line.encode() + b"\n"
            )

    def _describe(self, sent: Mapping[str, int]) -> dict[str, Any]:
        return {
            "format": FORMAT,
            "number": self._number,
            "next": dict(sent),
            "interval_m": self.profile.interval_m,
            "tracks": list(self.profile.names),
            "points": self._points(),
            "made": self._made,
            "windows_bytes": self._windows_bytes,
            "hello": self.hello,
        }

    def _points(self) -> dict[str, Any]:
        return {
            "first": self.profile.first,
            "count": self.profile.count,
            "with_sigma": sorted(self.profile.with_sigma),
        }

    def _publish(self) -> None:
        if self.profile.first is not None:
            self.profile.publish(self._description(inline=False), growing=True)

    def _description(self, inline: bool) -> dict[str, Any]:
        live: dict[str, Any] = {"windows_file": WINDOWS}
        if inline:
            with open_bytes(self.path / WINDOWS) as stream:
                lines = stream.read(self._windows_bytes).splitlines()
            live = {"windows": [json.loads(line) for line in lines]}
        provenance = {**self._made.get("provenance", {}), "live": live}
        return {**self._made, "provenance": provenance}

    def _remove_older(self) -> None:
        """Remove streams that a killed program has left beside that of `live.json`."""
        for stray in self.path.glob(_stream_name("*")):
            if stray.name != _stream_name(self._number):
                stray.unlink(missing_ok=True)


def is_complete(path: Path) -> bool:
    """Return whether ``path`` is a directory whose profile grows no more.

    What a program that was killed at the end has left beside such a profile is removed.
    """
    if not (path / DOCUMENT).is_file():
        return False
    document = read_document(path / DOCUMENT)
    provenance = document.get("provenance") if isinstance(document, dict) else None
    live = provenance.get("live") if isinstance(provenance, dict) else None
    if not isinstance(live, dict) or "points" in document:
        return False
    _remove_state(path, live.get("windows_file") != WINDOWS)
    return True


def _remove_state(path: Path, with_windows: bool) -> None:
    for name in (STATE, *([WINDOWS] if with_windows else [])):
        (path / name).unlink(missing_ok=True)
    for stream in path.glob(_stream_name("*")):
        stream.unlink(missing_ok=True)


def _stream_name(number: int | str) -> str:
    return f"live-{number}.npz"


def _read_state(path: Path) -> dict[str, Any]:
    if not (path / STATE).is_file():
        raise InputError(f"{path}: holds no {STATE}, so no live run to resume; give its directory")
    state = read_document(path / STATE)
    if not isinstance(state, dict) or state.get("format") != FORMAT:
        raise InputError(f"{path / STATE}: is no run of format {FORMAT}; begin another run")
    return state
