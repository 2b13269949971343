"""The question to a fall-back: the road where the height sensor of a run dropped out."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref.values.recording import Recording


class Process(Protocol):
    """Runs another pipeline on the recording of a `DropOut`."""

    def __call__(self, pipeline: str, settings: Mapping[str, Any] | None = None) -> Profile:
        """Return the profile by ``pipeline``; errors are those of `floatref.process`."""


@dataclass(frozen=True, eq=False)
class DropOut:
    """The question to a fall-back: another profile of ``recording``, whose heights have gaps.

    Attributes:
        recording: with all its channels.
        profile: the pipeline's profile of it, with the gaps bridged by straight lines.
        gaps: begin and end of every gap in m of distance by wheel path, shape (k, 2).
        process: runs another pipeline on ``recording`` and returns its profile. It reuses the
            screening of the recording, and asks for no fall-back.
    """

    recording: Recording
    profile: Profile
    gaps: Mapping[str, FloatArray]
    process: Process
