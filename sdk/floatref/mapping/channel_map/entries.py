"""The entries of a channel map, checked and with defaults."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

from floatref.values.recording import Setup

SOURCE = ""
"""Label of the file that is processed; further files of the run have names."""


@dataclass(frozen=True)
class FileEntry:
    """A native file of the run: where it is and how it is read."""

    path: Path
    adapter: str | None = None
    options: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class ChannelEntry:
    """Which native channel becomes which of ours, and how.

    A sample in SI units is sign · unit · (scale · native + offset), taken ``delay_s`` before its
    time stamp. ``wrap`` is where a counter starts again; ``missing`` are values that mark a missing
    sample. Empty rows of a ``sparse`` column are no samples; with None the channel decides.
    """

    native: str
    channel: str
    file: str = SOURCE
    track: str | None = None
    unit: str | None = None
    scale: float = 1.0
    offset: float = 0.0
    sign: int = 1
    delay_s: float = 0.0
    wrap: float | None = None
    missing: tuple[float, ...] = ()
    sparse: bool | None = None

    @property
    def skips_empty_rows(self) -> bool:
        """Whether empty rows are no samples: readings of GNSS come at uneven times."""
        return self.channel.startswith("gnss_") if self.sparse is None else self.sparse


@dataclass(frozen=True)
class ClockEntry:
    """How the clock of a file, or of one stream of it, is aligned with the base clock.

    ``rate`` in Hz takes the place of the stream's own clock; ``start_s``, if it is given, that of
    the time of its first row.
    """

    file: str = SOURCE
    stream: str | None = None
    align: str | None = None
    offset_s: float = 0.0
    drift_ppm: float = 0.0
    pulses: str | None = None
    base_pulses: str | None = None
    base_time: str | None = None
    base_pps: str | None = None
    rate: Fraction | None = None
    start_s: float | None = None


@dataclass(frozen=True)
class ChannelMap:
    """A channel map; ``place`` is its own file, None for one made from our names."""

    channels: tuple[ChannelEntry, ...]
    files: Mapping[str, FileEntry] = field(default_factory=dict)
    clocks: tuple[ClockEntry, ...] = ()
    setup: Setup = field(default_factory=Setup)
    vendor: str = ""
    model: str = ""
    source: FileEntry = field(default_factory=lambda: FileEntry(Path()))
    place: Path | None = None
