"""A fix of a receiver, and what the adapter finds in a file of logs."""

from pathlib import Path

from floatref import NativeFile
from floatref_adapters.formats.novatel.adapter import NovAtel
from floatref_adapters.testing.fixes import Fixes
from floatref_adapters.testing.whole_reading import open_content

WEEK_MS = 604_800_000
NOW_MS = 2300 * WEEK_MS
ONE = Fixes([NOW_MS], [-33.5], [151.25], [20.0], [22.5], [4], [20.0], [359.5], [-0.25])


def opened(folder: Path, content: bytes) -> NativeFile:
    return open_content(NovAtel(), folder / "run.gps", content)
