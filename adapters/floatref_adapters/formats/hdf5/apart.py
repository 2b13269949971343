"""HDF5 files read in a process of their own, for their library can crash, hang or swell."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from floatref import NativeFile, Rows, read_apart, real_path
from floatref_adapters.shared.row_pieces import keep_freed_memory

BROKEN = "no sound HDF5 (the library that reads it broke down); copy the complete file again"
SERVED = "floatref_adapters.formats.hdf5.dataset_rows"


def read_hdf5_apart(source: Path, options: Mapping[str, str]) -> NativeFile:
    """Return what the HDF5 file ``source`` holds; InputError if it cannot be used."""
    asked = (real_path(source), dict(options))
    listed: NativeFile
    (listed,) = read_apart(f"{SERVED}:list_streams", asked, BROKEN)
    streams = [replace(stream, read=_Reader(*asked, k)) for k, stream in enumerate(listed.streams)]
    return replace(listed, streams=tuple(streams))


@dataclass(frozen=True)
class _Reader:
    """Reads columns of one stream, as `Stream.read` does."""

    source: Path
    options: Mapping[str, str]
    stream: int

    def __call__(self, names: Sequence[str]) -> Iterator[Rows]:
        """Yield the rows of the columns ``names``."""
        keep_freed_memory()
        asked = (self.source, self.options, self.stream, tuple(names))
        yield from read_apart(f"{SERVED}:read_stream", asked, BROKEN)
