"""Recordings as MDF 4.10 files, block by block; independent of asammdf, which reads them.

Blocks are written from the last one back, so that each link is known.
"""

import struct
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, Recording
from floatref_adapters.testing.file_writing import check_quanta, replace_file
from floatref_adapters.testing.grouping import ClockGroup, by_clock, count_quanta

VALUE, MASTER, VIRTUAL_MASTER = 0, 2, 3
LINEAR = 1
SOME_INVALID = 2
DATA_TYPES = {"u": (0, 1), "i": (2, 3), "f": (4, 5)}
"""Types of data by the kind of number, low byte first and high byte first."""
HISTORY = (
    "<FHcomment><TX>written</TX><tool_id>floatref</tool_id><tool_vendor>floatref</tool_vendor>"
    "<tool_version>1</tool_version></FHcomment>"
)


@dataclass(frozen=True, eq=False)
class Stored:
    """A channel as stored: ``values`` of any integer or float type, or `V0` for no bytes.

    ``line`` is the factor and the offset of a linear conversion, ``invalid`` marks missing
    samples, ``bits`` is the first bit and how many of the integer hold the value. ``sync`` is
    what a master counts: 1 time, 2 angle, 3 distance.
    """

    name: str
    values: NDArray[Any]
    unit: str = ""
    line: tuple[float, float] | None = None
    kind: int = VALUE
    invalid: NDArray[np.bool_] | None = None
    bits: tuple[int, int] | None = None
    sync: int = 1


@dataclass(frozen=True, eq=False)
class StoredGroup:
    """Channels of one length; ``compressed`` stores them deflated and transposed."""

    name: str
    channels: Sequence[Stored]
    flags: int = 0
    compressed: bool = False


@dataclass
class Blocks:
    """A file in the making."""

    data: bytearray = field(default_factory=bytearray)

    def add(self, kind: str, links: Sequence[int], body: bytes) -> int:
        """Append a block and return its address."""
        self.data += bytes(-len(self.data) % 8)
        address = len(self.data)
        head = struct.pack(
            "<4s4xQQ", b"##" + kind.encode(), 24 + 8 * len(links) + len(body), len(links)
        )
        self.data += head + struct.pack(f"<{len(links)}Q", *links) + body
        return address

    def text(self, text: str, kind: str = "TX") -> int:
        """Append a text and return its address, 0 for an empty one."""
        encoded = text.encode() + b"\0"
        return self.add(kind, (), encoded + bytes(-len(encoded) % 8)) if text else 0


def write(
    groups: Sequence[StoredGroup],
    path: Path,
    start_ns: int = 0,
    time_flags: int = 0,
    mixed: bool = False,
) -> None:
    """Write ``groups`` to ``path``; ``start_ns`` since 1970, local if ``time_flags`` is 1.

    With ``mixed`` their records are in one data group, in turn, as a logger writes them.
    """
    start = struct.pack("<8s8s8s4xH30xHH", b"MDF     ", b"4.10    ", b"floatref", 410, 0, 0)
    blocks = Blocks(bytearray(start))
    header = struct.pack("<QhhBBBxdd", start_ns, 0, 0, time_flags, 0, 0, 0.0, 0.0)
    blocks.add("HD", (0,) * 6, header)
    stamp = struct.pack("<Qhh4x", start_ns, 0, 0)
    history = blocks.add("FH", (0, blocks.text(HISTORY, "MD")), stamp)
    following = 0
    for together in [list(groups)] if mixed else [[group] for group in reversed(groups)]:
        following = _data_group(blocks, together, following)
    struct.pack_into("<QQ", blocks.data, 64 + 24, following, history)
    path.write_bytes(blocks.data)


def _data_group(blocks: Blocks, groups: Sequence[StoredGroup], following: int) -> int:
    made = 0
    for number, group in reversed(list(enumerate(groups))):
        made = _channel_group(blocks, group, number, made)
    records = [_records(group) for group in groups]
    if len(groups) == 1:
        width = records[0].shape[1]
        data = _data(blocks, records[0].tobytes(), width, groups[0].compressed)
    else:
        data = blocks.add("DT", (), _in_turn(records))
    return blocks.add("DG", (following, made, data, 0), bytes([len(groups) > 1, *bytes(7)]))


def _in_turn(records: Sequence[NDArray[np.uint8]]) -> bytes:
    rows = range(max(map(len, records)))
    return b"".join(
        bytes([number]) + part[row].tobytes()
        for row in rows
        for number, part in enumerate(records)
        if row < len(part)
    )


def _channel_group(blocks: Blocks, group: StoredGroup, number: int, following: int) -> int:
    ends = np.cumsum([0, *(c.values.dtype.itemsize for c in group.channels)])
    marks = np.cumsum([0, *(c.invalid is not None for c in group.channels)])
    channel = 0
    for k, item in reversed(list(enumerate(group.channels))):
        channel = _channel(blocks, item, (int(ends[k]), int(marks[k])), channel)
    count = len(group.channels[0].values) if group.channels else 0
    sizes = int(ends[-1]), -(-int(marks[-1]) // 8)
    body = struct.pack("<QQHH4xII", number, count, group.flags, 0, *sizes)
    return blocks.add("CG", (following, channel, blocks.text(group.name), 0, 0, 0), body)


def _data(blocks: Blocks, data: bytes, width: int, compressed: bool) -> int:
    if not compressed:
        return blocks.add("DT", (), data)
    square = np.frombuffer(data, np.uint8).reshape(-1, width).T.tobytes()
    packed = zlib.compress(square)
    head = struct.pack("<2sBxIQQ", b"DT", 1, width, len(data), len(packed))
    block = blocks.add("DZ", (), head + packed)
    lists = blocks.add("DL", (0, block), struct.pack("<B3xIQ", 1, 1, len(data)))
    return blocks.add("HL", (lists,), struct.pack("<HB5x", 1, 1))


def _records(group: StoredGroup) -> NDArray[np.uint8]:
    stored = [c.values for c in group.channels if c.values.dtype.itemsize]
    parts = [values.view(np.uint8).reshape(len(values), -1) for values in stored]
    marked = [c.invalid for c in group.channels if c.invalid is not None]
    if marked:
        parts.append(np.packbits(np.stack(marked, axis=1), axis=1, bitorder="little"))
    return np.concatenate(parts, axis=1) if parts else np.empty((0, 0), np.uint8)


def _channel(blocks: Blocks, item: Stored, place: tuple[int, int], following: int) -> int:
    dtype = item.values.dtype
    first, count = item.bits or (0, 8 * dtype.itemsize)
    data_type = DATA_TYPES.get(dtype.kind, (0, 0))[dtype.newbyteorder("=") != dtype]
    sync = item.sync if item.kind in (MASTER, VIRTUAL_MASTER) else 0
    kinds = item.kind, sync, data_type, first
    flags = 0 if item.invalid is None else SOME_INVALID
    offset, mark = place
    body = struct.pack("<4B4I2BH6d", *kinds, offset, count, flags, mark, 0, 0, 0, *(0.0,) * 6)
    conversion = _line(blocks, item.line) if item.line else 0
    links = (following, 0, blocks.text(item.name), 0, conversion, 0, blocks.text(item.unit), 0)
    return blocks.add("CN", links, body)


def _line(blocks: Blocks, line: tuple[float, float]) -> int:
    factor, offset = line
    body = struct.pack("<BBHHHdddd", LINEAR, 0, 0, 0, 2, 0.0, 0.0, offset, factor)
    return blocks.add("CC", (0, 0, 0, 0), body)


def write_mdf4(recording: Recording, path: Path, quanta: Mapping[str, float] | None = None) -> None:
    """Write ``recording`` to ``path``: a group for each clock, a channel called as `left.height`.

    A uniform clock is a virtual master, the number of the record converted with the step and
    the start; any other is a master of float64 seconds. A channel of ``quanta`` is stored in
    integers with a linear conversion, its missing samples with a bit that marks them.
    """
    check_quanta(recording, quanta)
    with replace_file(path) as beside:
        write([_group(group, quanta) for group in by_clock(recording)], beside)


def _group(group: ClockGroup, quanta: Mapping[str, float] | None) -> StoredGroup:
    if group.times_s is None:
        line = (group.step_s, group.start_s)
        master = Stored("time", np.empty(group.count, "V0"), "s", line, VIRTUAL_MASTER)
    else:
        master = Stored("time", group.times_s, "s", kind=MASTER)
    return StoredGroup(group.name, [master, *(_store(c, quanta) for c in group.channels)])


def _store(channel: Channel, quanta: Mapping[str, float] | None) -> Stored:
    counted = count_quanta(channel, quanta)
    if counted is None:
        return Stored(str(channel.id), channel.values, channel.unit)
    quantum, counts = counted
    missing = np.isnan(channel.values)
    line = (quantum, 0.0)
    return Stored(str(channel.id), counts, channel.unit, line, invalid=missing)
