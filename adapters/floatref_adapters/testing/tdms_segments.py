"""The segments of a TDMS file, byte by byte, for layouts that npTDMS does not write."""

import struct
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

META, NEW, RAW, INTERLEAVED, BIG = 2, 4, 8, 32, 64
"""What a segment holds: metadata, a new list of channels, values; how these are laid."""
DOUBLE, STAMP = 10, 0x44
"""Types of data: float64 and time stamp."""
UNIX_S = 2_082_844_800
"""From 1904, where LabVIEW begins, to 1970, in s."""

Properties = dict[str, float | int | str | tuple[int, int]]
"""What is said of a channel; a pair is a time stamp in s since 1904 and 2**-64 s."""


def metadata_text(value: str) -> bytes:
    """Return ``value`` as TDMS stores it, its length in front."""
    encoded = value.encode()
    return struct.pack("<I", len(encoded)) + encoded


def stored(properties: Properties) -> bytes:
    """Return the count of ``properties`` and each with its type; a pair is a time stamp."""
    out = struct.pack("<I", len(properties))
    for name, value in properties.items():
        out += metadata_text(name)
        if isinstance(value, str):
            out += struct.pack("<I", 0x20) + metadata_text(value)
        elif isinstance(value, tuple):
            out += struct.pack("<IQq", STAMP, value[1], value[0])
        else:
            code, layout = (DOUBLE, "d") if isinstance(value, float) else (3, "i")
            out += struct.pack(f"<I{layout}", code, value)
    return out


def described(name: str, kind: int, count: int, properties: Properties) -> bytes:
    """Return the metadata of channel ``name`` of group `g`, of ``count`` values a chunk."""
    path = metadata_text(f"/'g'/'{name}'")
    return path + struct.pack("<IIIQ", 20, kind, 1, count) + stored(properties)


def segment(flags: int, metadata: bytes, raw: bytes) -> bytes:
    """Return a segment with its lead-in."""
    lengths = len(metadata) + len(raw), len(metadata)
    order = ">" if flags & BIG else "<"
    head = struct.pack("<4si", b"TDSm", flags) + struct.pack(f"{order}iQQ", 4713, *lengths)
    return head + metadata + raw


def laid(columns: Sequence[NDArray[Any]], chunk: int, interleaved: bool) -> bytes:
    """Return the bytes of ``columns`` of float64 in chunks of so many values."""
    out = b""
    for first in range(0, len(columns[0]), chunk):
        part = np.array([column[first : first + chunk] for column in columns])
        out += (part.T if interleaved else part).tobytes()
    return out


def doubles(count: int, chunk: int, wave: Properties | None = None) -> bytes:
    """Return the metadata of ``count`` channels of float64, called `c0` and on."""
    wave = {"wf_increment": 0.001} if wave is None else wave
    channels = [described(f"c{k}", DOUBLE, chunk, wave) for k in range(count)]
    return struct.pack("<I", count) + b"".join(channels)


def waves(parts: Sequence[tuple[int, Properties]]) -> bytes:
    """Return a segment of one channel for each of ``parts``: so many values, its properties."""
    return b"".join(
        segment(META | NEW | RAW, doubles(1, count, wave), bytes(8 * count))
        for count, wave in parts
    )


def scaled(kind: str, count: int = 1) -> Properties:
    """Return a waveform that says it has ``count`` scales, of which the first is of ``kind``."""
    return {
        "wf_increment": 0.1,
        "NI_Number_Of_Scales": count,
        "NI_Scale[0]_Scale_Type": kind,
        "NI_Scale[0]_Linear_Slope": 2.0,
        "NI_Scale[0]_Linear_Y_Intercept": 1.0,
    }
