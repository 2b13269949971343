"""Adapters: they read a native format into a recording, or list its content for a channel map."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from floatref.files import read_recording
from floatref.files.recording_directory import DOCUMENT
from floatref.values.native import NativeFile
from floatref.values.recording import Recording


class Adapter(Protocol):
    """Reads one native format; `name` is what `--adapter` takes.

    It also has one of two methods: `read` of a `RecordingAdapter`, or `streams` of a
    `NativeAdapter`.
    """

    name: str
    summary: str

    def recognises(self, source: Path) -> bool:
        """Return whether ``source`` is of this format, from its path or first bytes."""


class RecordingAdapter(Adapter, Protocol):
    """The adapter of a format that holds the channels of floatref."""

    def read(self, source: Path) -> Recording:
        """Return the recording; InputError if ``source`` cannot be used."""


class NativeAdapter(Adapter, Protocol):
    """The adapter of a format with names, units and clocks of its own."""

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the content of ``source``; InputError if it cannot be used.

        ``options`` are those of the channel map, such as `dbc`, a path.
        """


class RecordingDirectory:
    """The adapter of floatref's own recording directory."""

    name = "recording"
    summary = "floatref-recording/1: recording.json and raw float64 files beside it"

    def recognises(self, source: Path) -> bool:
        """Return whether ``source`` is a recording.json or a folder that holds one."""
        return source.name == DOCUMENT or (source / DOCUMENT).is_file()

    def read(self, source: Path) -> Recording:
        """Return the recording; InputError if ``source`` cannot be used."""
        return read_recording(source)
