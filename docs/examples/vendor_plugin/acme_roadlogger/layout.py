"""Files of the RoadLogger, version 1: a header, then blocks; every number is little-endian.

| header | type | meaning |
|---|---|---|
| magic | 8 bytes | `ACMERL`, CR, LF: a transfer as text would change it |
| version | u16 | 1 |
| channels | u16 | entries of the channel table, 1 to 64 |
| ticks per second | u32 | of the logger's one clock |
| start | i64 | time of tick 0, in ns since 1970 UTC; 0 if unknown |
| device | 16 bytes | serial number in ASCII, padded with zeros |
| channel table | 48 bytes each | below |
| check | u32 | CRC-32 of all of the above |

| channel | type | meaning |
|---|---|---|
| name | 16 bytes | in ASCII, padded with zeros |
| unit | u8 | place in `UNITS` |
| width | u8 | bytes of a sample: 2 or 4, signed |
| dropouts | u16 | 1 if the dropout code is used, else 0 |
| rate | 2 × u32 | samples per second, as a fraction |
| scale, offset | 2 × f64 | a sample in its unit is scale · count + offset |
| dropout code | i32 | the count that means a missing sample |

| block | type | meaning |
|---|---|---|
| sync | 4 bytes | F5 A0 0A 5F |
| channel | u16 | place in the channel table |
| samples | u16 | 1 to 4096 |
| tick | u64 | when the first sample was taken, below 2^62 |
| counts | samples × width | |
| check | u32 | CRC-32 of the block up to here |
"""

from dataclasses import dataclass
from fractions import Fraction
from struct import Struct

MAGIC = b"ACMERL\r\n"
VERSION = 1
SYNC = b"\xf5\xa0\x0a\x5f"
WIDTHS = (2, 4)
UNITS = ("", "counts", "g", "mm", "deg/s", "km/h")
MOST_CHANNELS = 64
MOST_SAMPLES = 4096
TICKS = 1 << 62
HEADER = Struct("<8sHHIq16s")
CHANNEL = Struct("<16sBBHIIddi")
BLOCK = Struct("<4sHHQ")
CHECK = Struct("<I")
AROUND = BLOCK.size + CHECK.size
"""Bytes of a block around its counts."""
LARGEST = AROUND + max(WIDTHS) * MOST_SAMPLES
"""Bytes of the largest block."""


@dataclass(frozen=True)
class LoggedChannel:
    """An entry of the channel table; ``dropout`` is None if there is no dropout code."""

    name: str
    unit: str
    width: int
    rate: Fraction
    scale: float = 1.0
    offset: float = 0.0
    dropout: int | None = None


@dataclass(frozen=True)
class Header:
    """The data before the blocks."""

    channels: tuple[LoggedChannel, ...]
    ticks_per_s: int = 10_000_000
    start_ns: int = 0
    device: str = ""
