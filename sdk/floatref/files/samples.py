"""Sample files: raw little-endian float64, and one byte per point for validity."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floatref.errors import InputError
from floatref.files.mapped.mapped_files import map_bytes
from floatref.values.arrays import BoolArray, FloatArray, frozen
from floatref.values.scanning import chunks

SAMPLE = np.dtype("<f8")
"""Format of a sample in the file: little-endian float64, NaN = missing."""


def read_samples(path: Path, count: int | None = None) -> FloatArray:
    """Return the samples of ``path``, mapped from the file and read-only, shape (N,).

    With ``count``, only so many are read: another program may be appending more. Raises InputError
    for a file that cannot be read, is empty, ends within a sample or holds fewer than ``count``.
    """
    return frozen(_map_file(path, SAMPLE.itemsize, count).view(SAMPLE))


def read_flags(path: Path, count: int | None = None) -> BoolArray:
    """Return the bytes of ``path``, the first ``count`` if given, as truth values, shape (N,).

    Raises InputError unless they are 0 or 1, and if there are fewer than ``count``.
    """
    flags = _map_file(path, 1, count)
    bad = np.flatnonzero(flags > 1)
    if bad.size:
        raise InputError(
            f"{path}: byte {bad[0]} is {flags[bad[0]]}; write one byte per point, 0 or 1"
        )
    return flags.astype(np.bool_)


def write_samples(values: FloatArray, path: Path) -> None:
    """Write ``values``, shape (N,), to ``path`` in bounded memory."""
    with path.open("wb") as stream:
        for _, chunk in chunks(values):
            stream.write(np.ascontiguousarray(chunk, SAMPLE).tobytes())


def write_flags(flags: BoolArray, path: Path) -> None:
    """Write ``flags``, shape (N,), to ``path``, one byte 0 or 1 each."""
    with path.open("wb") as stream:
        for _, chunk in chunks(flags):
            stream.write(chunk.astype(np.uint8).tobytes())


def free_name(stem: str, suffix: str, taken: set[str]) -> str:
    """Return ``stem + suffix``, numbered if ``taken`` has it in any case, and add it there."""
    name, number = f"{stem}{suffix}", 1
    while name.casefold() in taken:
        number += 1
        name = f"{stem}.{number}{suffix}"
    taken.add(name.casefold())
    return name


def _map_file(path: Path, item_bytes: int, count: int | None = None) -> NDArray[np.uint8]:
    found = map_bytes(path)
    if count is not None and found.size < count * item_bytes:
        raise InputError(
            f"{path}: {found.size // item_bytes} points, but profile.json has {count}; the file is "
            "truncated, copy the directory again"
        )
    if count is not None:
        # More may be there: points are written before the document counts them.
        return found[: count * item_bytes]
    if found.size % item_bytes:
        raise InputError(
            f"{path}: {found.size} bytes are not a whole number of float64 samples; "
            "the file is truncated or of another type, copy or convert it again"
        )
    return found
