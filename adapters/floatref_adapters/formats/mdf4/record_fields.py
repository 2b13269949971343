"""The channels of an MDF 4 group: which hold numbers, and the numbers in a record."""

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref_adapters.formats.mdf4.conversions import convert, find_conversion_fault, scales_of
from floatref_adapters.formats.mdf4.data_blocks import Bytes

Numbers = NDArray[Any]
Marks = NDArray[np.bool_]
VALUE, MASTER, VIRTUAL_MASTER, SYNC, VIRTUAL = 0, 2, 3, 4, 6
"""Types of channel that hold a number per record."""
INTEGERS, SIGNED, FLOATS, BIG_ENDIAN = (0, 1, 2, 3), (2, 3), (4, 5), (1, 3, 5)
"""Types of data."""
ALL_INVALID, SOME_INVALID = 1, 2


@dataclass(frozen=True, eq=False)
class Field:
    """Where in a record a channel is, how it is converted, and how it is marked as missing.

    ``origin`` is asammdf's channel, number ``index`` of its group; ``whole`` and ``invalid`` are
    bytes of a record.
    """

    index: int
    origin: Any
    whole: int
    invalid: int

    @property
    def virtual(self) -> bool:
        """Whether it holds the number of the record, which takes no bytes."""
        return self.origin.channel_type in (VIRTUAL_MASTER, VIRTUAL)

    @property
    def stored_bytes(self) -> int:
        """How many bytes of a record it lies in."""
        return int(self.origin.bit_offset + self.origin.bit_count + 7) // 8

    def unreadable(self) -> str:
        """Return why it gives no numbers; "" if it does."""
        channel = self.origin
        if channel.channel_type not in (VALUE, MASTER, VIRTUAL_MASTER, SYNC, VIRTUAL):
            return "values of varying length"
        if channel.component_addr:
            return "an array or a structure"
        if not self.virtual and channel.data_type not in (*INTEGERS, *FLOATS):
            return "text or bytes"
        if not self.virtual and not self._fits():
            return f"{channel.bit_count} bits that do not lie in a record as a number"
        return find_conversion_fault(channel.conversion)

    def note(self) -> str:
        """Return what is to be known of its numbers; "" if nothing."""
        conversion = self.origin.conversion
        return "texts are missing samples" if conversion and scales_of(conversion) else ""

    def _fits(self) -> bool:
        bits, offset = self.origin.bit_count, self.origin.bit_offset
        if self.origin.byte_offset + self.stored_bytes > self.whole:
            return False
        if self.origin.data_type in FLOATS:
            return offset == 0 and bits in (16, 32, 64)
        return bits > 0 and self.stored_bytes <= 8

    def read(self, rows: Bytes) -> Numbers:
        """Return the numbers as stored in ``rows``; the field is not virtual."""
        start, size = self.origin.byte_offset, self.stored_bytes
        order = ">" if self.origin.data_type in BIG_ENDIAN else "<"
        field = rows[:, start : start + size]
        if self.origin.bit_offset or self.origin.bit_count not in (8, 16, 32, 64):
            return self._read_bits(field, order)
        kind = "f" if self.origin.data_type in FLOATS else "u"
        kind = "i" if self.origin.data_type in SIGNED else kind
        native: Numbers = np.ascontiguousarray(field).view(f"{order}{kind}{size}")[:, 0]
        return native

    def read_marks(self, rows: Bytes) -> Marks | None:
        """Return which of ``rows`` are marked invalid; None if the field has no mark."""
        if not (self.origin.flags & SOME_INVALID and self.invalid):
            return None
        byte, bit = divmod(self.origin.pos_invalidation_bit, 8)
        if byte >= self.invalid:
            return None
        marks: Marks = (rows[:, self.whole + byte] >> bit & 1).astype(np.bool_)
        return marks

    def _read_bits(self, field: Bytes, order: str) -> Numbers:
        """Return integers of any number of bits, up to 64 with the bits before them."""
        wide = np.zeros((len(field), 8), np.uint8)
        wide[:, slice(8 - field.shape[1], 8) if order == ">" else slice(field.shape[1])] = field
        numbers = wide.view(f"{order}u8")[:, 0].astype(np.uint64)
        # Shifted up to the top first, so that the sign of the number becomes that of the type.
        spare = np.uint64(64 - self.origin.bit_count)
        numbers = numbers >> np.uint64(self.origin.bit_offset) << spare
        if self.origin.data_type in SIGNED:
            return numbers.view(np.int64) >> np.int64(spare)
        return numbers >> spare

    def to_values(self, raw: Numbers, marks: Marks | None) -> NDArray[np.float64]:
        """Return ``raw`` converted to float64, NaN where it is marked invalid."""
        numbers = convert(self.origin.conversion, raw)
        numbers = np.array(numbers, np.float64) if numbers.base is not None else numbers
        if self.origin.flags & ALL_INVALID:
            numbers[:] = np.nan
        elif marks is not None:
            numbers[marks] = np.nan
        return numbers


def find_unit(channel: Any) -> str:
    """Return the unit of ``channel`` or of its conversion as the file has it; "" if missing."""
    unit = channel.unit or getattr(channel.conversion, "unit", "") or ""
    if not unit and channel.conversion:
        units = {scale.unit or "" for scale in scales_of(channel.conversion).values()}
        unit = units.pop() if len(units) == 1 else ""
    within = re.search(r"<TX[^>]*>(.*?)</TX>", unit, re.DOTALL)
    return (within[1] if within else unit).strip()
