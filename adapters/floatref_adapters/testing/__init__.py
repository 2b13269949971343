"""Recordings written in the formats that the adapters read, to test what reads them.

What a vendor's logger writes is richer; these files hold what a recording holds: every channel
under its name, in its unit, on its clock.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from types import MappingProxyType

from floatref import Recording

Writer = Callable[[Recording, Path, Mapping[str, float] | None], None]
"""Writes a recording to a file; the quanta, by channel, are steps that samples are rounded to."""


def _lazy(module: str, function: str) -> Writer:
    def write(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
        getattr(import_module(f"{__name__}.{module}"), function)(recording, path, quanta)

    return write


WRITERS: Mapping[str, Writer] = MappingProxyType(
    {
        ".mf4": _lazy("mdf4", "write_mdf4"),
        ".tdms": _lazy("tdms", "write_tdms"),
        ".parquet": _lazy("arrow_files", "write_parquet"),
        ".arrow": _lazy("arrow_files", "write_arrow"),
        ".h5": _lazy("hdf5", "write_hdf5"),
        ".csv": _lazy("csv_table", "write_csv"),
    }
)
"""What writes a recording, by the suffix of the file."""

__all__ = ["WRITERS", "Writer"]
