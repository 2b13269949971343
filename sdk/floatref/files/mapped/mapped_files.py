"""Files seen through a map: of any size, in the memory of what is looked at."""

import mmap
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.files.mapped.cut_files import watch
from floatref.files.sources import open_bytes


def map_bytes(path: Path) -> NDArray[np.uint8]:
    """Return the bytes of ``path``, shape (N,), mapped from the file and read-only.

    Raises InputError as `open_bytes` does, and for an empty file. If the file is cut short while
    it is read, that raises InputError as well.
    """
    with open_bytes(path) as stream:
        if not stream.seek(0, 2):
            raise InputError(f"{path}: empty; copy the complete file")
        found: NDArray[np.uint8] = np.memmap(stream, dtype=np.uint8, mode="r")
    mapped = found.base
    assert isinstance(mapped, mmap.mmap)
    watch(mapped, found.ctypes.data, path)
    return found
