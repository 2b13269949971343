"""What an adapter is: a native format read into a recording, or listed for a channel map."""

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from floatref.files import read_recording
from floatref.files.recording_directory import DOCUMENT
from floatref.values.native import NativeFile
from floatref.values.recording import Recording


class Adapter(Protocol):
    """Reads one native format; `name` is what `--adapter` takes.

    It has one of two more methods: `read` of a `RecordingAdapter`, or `streams` of a
    `NativeAdapter`.
    """

    name: str
    summary: str

    def recognises(self, source: Path) -> bool:
        """Tell from the path, or the first bytes, whether ``source`` is of this format."""


class RecordingAdapter(Adapter, Protocol):
    """The adapter of a format that holds our channels."""

    def read(self, source: Path) -> Recording:
        """Return the recording; InputError if ``source`` cannot be used."""


class NativeAdapter(Adapter, Protocol):
    """The adapter of a format with names, units and clocks of its own."""

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return what ``source`` holds; InputError if it cannot be used.

        ``options`` are those of the channel map, such as `dbc`, a path.
        """


class RecordingDirectory:
    """The adapter of our own recording directory."""

    name = "recording"
    summary = "floatref-recording/1: recording.json and raw float64 files beside it"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` is a recording.json or holds one."""
        return source.name == DOCUMENT or (source / DOCUMENT).is_file()

    def read(self, source: Path) -> Recording:
        """Return the recording; InputError if ``source`` cannot be used."""
        return read_recording(source)
