"""What a page is made of, and the file it is in: complete, or not there at all."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref.values.parts.shown_units import NEAR_M, SHOWN, SMALL_M
from floatref.values.parts.windows import Window
from floatref.version import __version__
from floatref.viewer.page_writer import PageWriter

MEGABYTE = 1e6
FIXED_BYTES = 150_000
"""Bytes of the scripts and styles in a page."""


@dataclass(frozen=True)
class PageOptions:
    """How a page is made.

    Attributes:
        window: the part that is shown.
        units: "si" or "us", which a reader can change.
        title: the title, by default the names of what is shown.
        segment_m: length in m of a segment of the IRI.
        most_mb: largest size of the file in MB, but for what cannot be made coarser.
        overwrite: whether an existing file is replaced.
    """

    window: Window = field(default_factory=Window)
    units: str = "si"
    title: str = ""
    segment_m: float = 100.0
    most_mb: float = 40.0
    overwrite: bool = False

    def __post_init__(self) -> None:
        """Refuse a size in which no picture fits."""
        if not 1.0 <= self.most_mb <= 2000.0:
            raise InputError(f"size {self.most_mb:g} MB; give 1 to 2000")

    @property
    def most_bytes(self) -> float:
        """Bytes that the arrays may take in the file."""
        return self.most_mb * MEGABYTE - FIXED_BYTES

    def head(self, title: str, axis: str) -> dict[str, Any]:
        """Return what a page says of itself: ``title``, first axis, units, and its maker."""
        shown = {kind: dict(systems) for kind, systems in SHOWN.items()}
        made = f"floatref {__version__}"
        small = {"range": SMALL_M, "largest": NEAR_M}
        known = {"title": title, "axis": axis, "made": made, "small": small}
        return {**known, "units": self.units, "shown": shown}


@contextmanager
def new_page(path: Path, title: str, overwrite: bool) -> Iterator[PageWriter]:
    """Yield the writer of the page that becomes ``path``; InputError if it cannot be written."""
    with (
        replace_file(path, overwrite) as beside,
        beside.open("w", encoding="utf-8", newline="\n") as stream,
    ):
        page = PageWriter(stream)
        page.open(title)
        yield page
