"""Recordings as TDMS files through npTDMS, and segments byte by byte for what it does not write."""

import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, Recording
from floatref_adapters.shared.refusals import library
from floatref_adapters.testing.file_writing import check_quanta, replace_file
from floatref_adapters.testing.grouping import ClockGroup, by_clock, count_quanta

ROWS = 1 << 16
"""Rows of a segment."""


def write_tdms(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
    """Write ``recording`` to ``path``: a group for each clock, a channel called as `left.height`.

    Uniform clocks are kept as `wf_increment` and `wf_start_offset`, others as a channel
    `time_s`. A channel of ``quanta`` is stored in integers with a linear scale; ValueError if
    it has missing samples, for which TDMS has no mark.
    """
    nptdms = library("nptdms", "writing TDMS")
    check_quanta(recording, quanta)
    with replace_file(path) as beside, nptdms.TdmsWriter(str(beside)) as writer:
        for group in by_clock(recording):
            for objects in _segments(group, quanta):
                writer.write_segment(objects)


def _segments(group: ClockGroup, quanta: Mapping[str, float] | None) -> Iterator[list[Any]]:
    channel_object = library("nptdms", "writing TDMS").ChannelObject
    stored = [(str(c.id), *_store(c, quanta)) for c in group.channels]
    timing = {"wf_increment": group.step_s, "wf_start_offset": group.start_s}
    if group.times_s is not None:
        timing = {}
        stored.append(("time_s", group.times_s, {"unit_string": "s"}))
    for first in range(0, group.count, ROWS):
        yield [
            channel_object(group.name, name, values[first : first + ROWS], {**own, **timing})
            for name, values, own in stored
        ]


def _store(
    channel: Channel, quanta: Mapping[str, float] | None
) -> tuple[np.ndarray[Any, Any], dict[str, Any]]:
    properties: dict[str, Any] = {"unit_string": channel.unit}
    counted = count_quanta(channel, quanta)
    if counted is None:
        return channel.values, properties
    if np.isnan(channel.values).any():
        raise ValueError(f"{channel.id}: missing samples cannot be stored in integers")
    quantum, counts = counted
    scale = {
        "NI_Number_Of_Scales": 1,
        "NI_Scaling_Status": "unscaled",
        "NI_Scale[0]_Scale_Type": "Linear",
        "NI_Scale[0]_Linear_Slope": quantum,
        "NI_Scale[0]_Linear_Y_Intercept": 0.0,
    }
    return counts, properties | scale


META, NEW, RAW, INTERLEAVED, BIG = 2, 4, 8, 32, 64
"""What a segment holds: metadata, a new list of channels, values; how these are laid."""
DOUBLE, STAMP = 10, 0x44
"""Types of data: float64 and time stamp."""
UNIX_S = 2_082_844_800
"""From 1904, where LabVIEW begins, to 1970, in s."""

Properties = dict[str, float | int | str | tuple[int, int]]
"""Properties of a channel; a pair is a time stamp in s since 1904 and 2**-64 s."""


def metadata_text(value: str) -> bytes:
    """Return ``value`` as TDMS stores it, its length in front."""
    encoded = value.encode()
    return struct.pack("<I", len(encoded)) + encoded


def write_properties(properties: Properties) -> bytes:
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


def describe_channel(name: str, kind: int, count: int, properties: Properties) -> bytes:
    """Return the metadata of channel ``name`` of group `g`, of ``count`` values a chunk."""
    path = metadata_text(f"/'g'/'{name}'")
    return path + struct.pack("<IIIQ", 20, kind, 1, count) + write_properties(properties)


def segment(flags: int, metadata: bytes, raw: bytes) -> bytes:
    """Return a segment with its lead-in."""
    lengths = len(metadata) + len(raw), len(metadata)
    order = ">" if flags & BIG else "<"
    head = struct.pack("<4si", b"TDSm", flags) + struct.pack(f"{order}iQQ", 4713, *lengths)
    return head + metadata + raw


def lay_out(columns: Sequence[NDArray[Any]], chunk: int, interleaved: bool) -> bytes:
    """Return the bytes of ``columns`` of float64 in chunks of ``chunk`` values."""
    out = b""
    for first in range(0, len(columns[0]), chunk):
        part = np.array([column[first : first + chunk] for column in columns])
        out += (part.T if interleaved else part).tobytes()
    return out


def doubles(count: int, chunk: int, wave: Properties | None = None) -> bytes:
    """Return the metadata of ``count`` channels of float64, called `c0` and on."""
    wave = {"wf_increment": 0.001} if wave is None else wave
    channels = [describe_channel(f"c{k}", DOUBLE, chunk, wave) for k in range(count)]
    return struct.pack("<I", count) + b"".join(channels)


def waves(parts: Sequence[tuple[int, Properties]]) -> bytes:
    """Return a segment of one channel for each of ``parts``, its count of values and properties."""
    return b"".join(
        segment(META | NEW | RAW, doubles(1, count, wave), bytes(8 * count))
        for count, wave in parts
    )


def scale_waveform(kind: str, count: int = 1) -> Properties:
    """Return a waveform that says it has ``count`` scales, of which the first is of ``kind``."""
    return {
        "wf_increment": 0.1,
        "NI_Number_Of_Scales": count,
        "NI_Scale[0]_Scale_Type": kind,
        "NI_Scale[0]_Linear_Slope": 2.0,
        "NI_Scale[0]_Linear_Y_Intercept": 1.0,
    }
