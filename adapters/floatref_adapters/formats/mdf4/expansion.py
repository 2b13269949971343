"""Compressed blocks of an MDF 4 file, expanded by as many bytes as they say and not one more."""

import zlib
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from floatref import InputError

DEFLATE, ZSTD, LZ4 = 0, 2, 4
"""Methods; one more is the same with the bytes of the records transposed."""


class Part(NamedTuple):
    """Bytes of a data block: where they are, and how they are compressed, None if not."""

    address: int
    stored: int
    bytes: int
    method: int | None = None
    width: int = 0


def expanded(part: Part, stored: bytes) -> bytes:
    """Return the bytes of ``part``, of which the file holds ``stored``; InputError otherwise."""
    try:
        data = _inflated(part, stored)
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{_where(part)} cannot be expanded ({error}); copy the file again") from (
            error
        )
    if len(data) != part.bytes:
        raise InputError(f"{_where(part)} does not hold {part.bytes} bytes; copy the file again")
    return _transposed(data, part.width) if part.method and part.method % 2 else data


def _where(part: Part) -> str:
    return f"the compressed block at byte {part.address - 48}"


def _inflated(part: Part, stored: bytes) -> bytes:
    method = part.method or DEFLATE
    if method & ~1 == DEFLATE:
        return _inflater()(stored, part.bytes + 1)
    if method & ~1 == LZ4:
        from lz4.frame import LZ4FrameDecompressor

        whole: bytes = LZ4FrameDecompressor().decompress(stored, max_length=part.bytes + 1)
        return whole
    if method & ~1 == ZSTD and _zstd_bytes(stored) == part.bytes:
        from zstd import decompress

        data: bytes = decompress(stored)
        return data
    raise InputError(f"{_where(part)} is compressed by method {method}; save it with deflate")


def _zstd_bytes(stored: bytes) -> int | None:
    """Return what a zstd frame says it holds, to which its decoder keeps; None if it does not."""
    if stored[:4] != b"\x28\xb5\x2f\xfd":
        return None
    described = stored[4]
    single = described >> 5 & 1
    start = 5 + (not single) + (0, 1, 2, 4)[described & 3]
    size = (single, 2, 4, 8)[described >> 6]
    count = int.from_bytes(stored[start : start + size], "little")
    return count + 256 * (size == 2) if size else None


def _inflater() -> Callable[[bytes, int], bytes]:
    """Return what inflates bytes to at most so many; ISA-L, as asammdf itself, if it is there."""
    try:
        from isal import isal_zlib
    except ImportError:
        return zlib.decompressobj().decompress
    inflate: Callable[[bytes, int], bytes] = isal_zlib.decompressobj().decompress
    return inflate


def _transposed(data: bytes, width: int) -> bytes:
    """Return records of ``width`` bytes whose first bytes come first, then the second ones."""
    if width == 0:
        return data
    lines = len(data) // width
    square = np.frombuffer(data, np.uint8, lines * width).reshape(width, lines)
    return square.T.tobytes() + data[lines * width :]
