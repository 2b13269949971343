"""Structs of Thrift's compact protocol, which the footer and the page headers of Parquet are.

pyarrow shows no header of a page, and ends the process where it is asked about a column chunk that
is encrypted. A struct is its fields by number; texts are bytes.
"""

from collections.abc import Iterator
from typing import Any

DEEPEST = 12
"""Structs within each other; those of Parquet have seven."""
TRUE, FALSE, BYTE, DOUBLE, BINARY, LIST, SET, STRUCT = 1, 2, 3, 7, 8, 9, 10, 12
INTEGERS = (4, 5, 6)

Fields = dict[int, Any]


class Compact:
    """A reader of Thrift's compact protocol; IndexError at the end, KeyError at what it is not."""

    def __init__(self, content: bytes) -> None:
        """Begin at the first byte of ``content``."""
        self._content, self.at = content, 0

    def struct(self, depth: int = 0) -> Fields:
        """Return the next struct, its fields by number."""
        if depth > DEEPEST:
            raise KeyError(depth)
        fields: Fields = {}
        number = 0
        while head := self._byte():
            step, kind = head >> 4, head & 15
            number = number + step if step else self.integer()
            fields[number] = self._value(kind, depth)
        return fields

    def _value(self, kind: int, depth: int) -> Any:
        if kind in (TRUE, FALSE):
            return kind == TRUE
        if kind in INTEGERS:
            return self.integer()
        if kind == STRUCT:
            return self.struct(depth + 1)
        if kind in (LIST, SET):
            return list(self._items(depth))
        sizes = {BYTE: lambda: 1, DOUBLE: lambda: 8, BINARY: self._unsigned}
        return self._take(sizes[kind]())

    def _items(self, depth: int) -> Iterator[Any]:
        head = self._byte()
        count = head >> 4 if head >> 4 < 15 else self._unsigned()
        for _ in range(count):
            # Truth values have a byte each in a list.
            yield self._byte() if head & 15 in (TRUE, FALSE) else self._value(head & 15, depth + 1)

    def _take(self, size: int) -> bytes:
        self.at += size
        if self.at > len(self._content):
            raise IndexError(self.at)
        return self._content[self.at - size : self.at]

    def _byte(self) -> int:
        self.at += 1
        return self._content[self.at - 1]

    def _unsigned(self) -> int:
        value = 0
        for shift in range(0, 70, 7):
            byte = self._byte()
            value |= (byte & 0x7F) << shift
            if byte < 0x80:
                return value
        raise KeyError(value)

    def integer(self) -> int:
        """Return the next integer, which may be negative."""
        raw = self._unsigned()
        return (raw >> 1) ^ -(raw & 1)
