"""What an adapter is: a native format read into a recording."""

from pathlib import Path
from typing import Protocol

from floatref.files import read_recording
from floatref.files.recording import DOCUMENT
from floatref.values.recording import Recording


class Adapter(Protocol):
    """Reads one native format; `name` is what `--adapter` takes."""

    name: str
    summary: str

    def recognises(self, source: Path) -> bool:
        """Tell from the path, or the first bytes, whether ``source`` is of this format."""

    def read(self, source: Path) -> Recording:
        """Return the recording; InputError if ``source`` cannot be used."""


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
