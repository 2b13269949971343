"""Recording formats: each writes a recording to one kind of file, for other programs to show."""

from pathlib import Path
from typing import Protocol

from floatref.files import write_recording
from floatref.values.recording import Recording


class RecordingFormat(Protocol):
    """Writes one kind of recording file; `name` is what `--format` of `convert` takes.

    `suffix`, such as ".mcap", has small letters only. The file gets its final name when `write` has
    returned. A format that needs a library may have a method `check_installed`, which raises
    InputError if the library is missing; it is called before the recording is read. A format whose
    files do not hold the setup has `holds_setup = False`: `convert` then warns that it is left out.
    An adapter reads such files back.
    """

    name: str
    suffix: str
    summary: str

    def write(self, recording: Recording, path: Path) -> None:
        """Write ``recording`` to the new file ``path``; InputError if it cannot be held."""


class RecordingFolder:
    """floatref's own recording directory: the only format that is a folder and has no suffix."""

    name = "recording"
    suffix = ""
    summary = "floatref-recording/1: recording.json and raw float64 files beside it"

    def write(self, recording: Recording, path: Path) -> None:
        """Write ``recording`` as a new folder."""
        write_recording(recording, path)
