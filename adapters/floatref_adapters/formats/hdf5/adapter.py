"""HDF5 files: NetCDF 4, MATLAB 7.3 and those of many loggers.

One-dimensional datasets are columns, those of two dimensions one for each of up to 64 columns,
compound ones one for each field. Those of one group with one length and one clock are a stream.
The clock of a dataset is the first of: its attributes `rate_hz` (or `sampling_rate`, `fs`, `dt`)
and `start_s`; a dataset of its length in the group that is named like time, or that the option
`time` names; its dimension scale; the attributes of the group, or single values in it.
`unit` or `units`, `_FillValue`, `scale_factor` and `add_offset` mean what they do in CF.
"""

from collections.abc import Mapping
from pathlib import Path

from floatref import InputError, NativeFile, read_start
from floatref_adapters.formats.hdf5.apart import read_hdf5_apart
from floatref_adapters.shared.refusals import prefix_errors

SIGNATURE = b"\x89HDF\r\n\x1a\n"
OFFSETS = (0, 512, 1024, 2048, 4096, 8192)
"""Where the signature may be: what comes before it is for other programs."""


class Hdf5:
    """The adapter of HDF5 files."""

    name = "hdf5"
    summary = "HDF5, NetCDF 4 and MATLAB 7.3"

    def recognises(self, source: Path) -> bool:
        """Tell whether ``source`` has the signature of an HDF5 file."""
        start = read_start(source, OFFSETS[-1] + len(SIGNATURE))
        return any(start.startswith(SIGNATURE, offset) for offset in OFFSETS)

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        """Return the datasets of each group and clock; InputError if the file cannot be used.

        ``options`` are `time`, the name of a dataset or its path, and `epoch`. The file is read
        in a process of its own, for a damaged one can bring the HDF5 library down.
        """
        if not source.is_file():
            raise InputError(f"{source}: not a file; give an HDF5 file")
        with prefix_errors(source):
            return read_hdf5_apart(source, options)


__all__ = ["Hdf5"]
