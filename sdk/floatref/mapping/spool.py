"""Samples on disk, so that memory does not grow with the file."""

import shutil
from pathlib import Path

import numpy as np

from floatref.errors import InputError
from floatref.files.samples import SAMPLE, read_samples
from floatref.files.scratch import make_scratch, remove_scratch
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.scanning import chunks

SPARE = 1 << 28
"""Bytes of the disk that must remain free."""


class Spool:
    """A folder of sample files for the time of a run; a context that removes it.

    Where the system can remove files while they are mapped, arrays outlive the folder.
    """

    def __init__(self) -> None:
        """Make the folder where the system keeps temporary files (`TMPDIR`)."""
        self._folder = make_scratch("samples")
        self._columns: list[SpooledColumn] = []

    def __enter__(self) -> "Spool":
        """Return the spool itself."""
        return self

    def __exit__(self, *raised: object) -> None:
        """Remove the folder."""
        for column in self._columns:
            column.close()
        remove_scratch(self._folder)

    def check_room(self, samples: int) -> None:
        """Raise InputError unless the disk has room for ``samples``."""
        free = shutil.disk_usage(self._folder).free - SPARE
        wanted = samples * SAMPLE.itemsize
        if wanted > free:
            raise InputError(
                f"reading it needs {wanted / 1e9:.1f} GB on disk for a while, and "
                f"{self._folder.parent} has {max(free, 0) / 1e9:.1f} GB; set TMPDIR to a folder "
                "with more, or map fewer channels"
            )

    def column(self) -> "SpooledColumn":
        """Return a new column to append to."""
        self._columns.append(SpooledColumn(self._folder / f"{len(self._columns)}.f64"))
        return self._columns[-1]

    def thin(self, values: FloatArray, kept: BoolArray) -> FloatArray:
        """Return the ``kept`` ones of ``values``, shape (N,), on disk."""
        column = self.column()
        for first, part in chunks(values):
            column.append(part[kept[first : first + part.size]])
        return column.finish()


class SpooledColumn:
    """Samples of one channel, appended piece by piece."""

    def __init__(self, path: Path) -> None:
        """Make the file ``path``, to be written."""
        self._path = path
        self._stream = path.open("wb")

    def append(self, values: FloatArray) -> None:
        """Add ``values``, shape (n,); InputError if the disk is full."""
        try:
            np.ascontiguousarray(values, SAMPLE).tofile(self._stream)
        except OSError as error:
            raise InputError(
                f"{self._path.parent.parent}: {error.strerror or error} while reading; set TMPDIR "
                "to a folder with more room"
            ) from error

    def finish(self) -> FloatArray:
        """Return all samples, shape (N,), mapped from disk."""
        self.close()
        return read_samples(self._path) if self._path.stat().st_size else np.empty(0)

    def close(self) -> None:
        """Write no more."""
        self._stream.close()
