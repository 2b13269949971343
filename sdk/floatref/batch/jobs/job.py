"""One file to be processed, in plain values that any worker understands."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref.engine.choosing import AUTO

PROFILES, RECORDS = "profiles", "records"
"""Folders below the output directory; a job's name is its path in both."""


@dataclass(frozen=True)
class Job:
    """Input of one task: paths are absolute, so that workers find them from anywhere.

    Attributes:
        source: the recording directory or native file.
        name: its own in the output, with slashes, as ``A1/run7.mf4``.
        out: the output directory.
        adapter: the adapter that reads it; None: the one that recognises it.
        channel_map: the channel map of a native file.
        pipeline: its name.
        settings: of the pipeline, by name.
        segment_m: length of a segment in the summary; None: the whole profile is one.
        measures: whether segments get the measures of ride too.
        size_bytes: of what is read, for the order of work and the time left.
    """

    source: Path
    name: str
    out: Path
    adapter: str | None = None
    channel_map: Path | None = None
    pipeline: str = AUTO
    settings: Mapping[str, Any] = field(default_factory=dict)
    segment_m: float | None = None
    measures: bool = False
    size_bytes: int = 0

    @property
    def profile(self) -> Path:
        """Where the profile directory is written."""
        return self.out / PROFILES / self.name

    @property
    def record(self) -> Path:
        """Where the JSON file with the result is written."""
        return self.out / RECORDS / f"{self.name}.json"
