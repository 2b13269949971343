"""Records of many streams that come mixed, kept on disk by stream: a log is parsed once."""

import struct
from collections import defaultdict
from collections.abc import Hashable, Iterator
from tempfile import TemporaryFile

from floatref import InputError

HEAD = struct.Struct("<qI")
HELD = 1 << 23
"""Bytes that are held in memory before they are written."""


class Spool:
    """Records by key, each an integer tick and some bytes, in the order they were added.

    It lives in a temporary file until it is closed, or nobody has it any more. InputError where
    that cannot be written.
    """

    def __init__(self) -> None:
        self._file = TemporaryFile()  # noqa: SIM115  # It lives as long as the spool.
        self._held: defaultdict[Hashable, bytearray] = defaultdict(bytearray)
        self._size = 0
        self._parts: defaultdict[Hashable, list[tuple[int, int]]] = defaultdict(list)
        self._end = 0

    def add(self, key: Hashable, tick: int, content: bytes) -> None:
        """Add a record."""
        self._held[key] += HEAD.pack(tick, len(content)) + content
        self._size += HEAD.size + len(content)
        if self._size > HELD:
            self._flush()

    def records(self, key: Hashable) -> Iterator[tuple[int, bytes]]:
        """Yield the records of ``key``."""
        self._flush()
        for offset, size in self._parts.get(key, ()):
            part = self._read(offset, size)
            at = 0
            while at < size:
                tick, length = HEAD.unpack_from(part, at)
                at += HEAD.size + length
                yield tick, part[at - length : at]

    def close(self) -> None:
        """Remove it."""
        self._file.close()

    def __del__(self) -> None:
        """Remove it with the last of those that read it."""
        self._file.close()

    def _read(self, offset: int, size: int) -> bytes:
        self._file.seek(offset)
        return self._file.read(size)

    def _flush(self) -> None:
        try:
            self._file.seek(self._end)
            for key, part in self._held.items():
                self._file.write(part)
                self._parts[key].append((self._end, len(part)))
                self._end += len(part)
        except OSError as error:
            reason = error.strerror or error
            raise InputError(f"temporary file: {reason}; free its disk, or set TMPDIR") from error
        self._held.clear()
        self._size = 0
