"""Writing such files: block by block, or a whole recording as the logger would have taken it.

python -m acme_roadlogger.writer RECORDING FILE
"""

import sys
import zlib
from collections.abc import Iterable, Iterator
from heapq import merge
from operator import itemgetter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from acme_roadlogger import layout
from acme_roadlogger.layout import Header, LoggedChannel
from floatref import Channel, InputError, Recording, UniformClock, read_recording

G = 9.80665
COUNT_M = 0.0005
"""Travel per count of the encoder, in m."""
FIRST_COUNT = (1 << 31) - 20_000
"""The encoder's counter when logging begins: it wraps after 10 m."""
SENSORS = {
    "vertical_specific_force": ("ACC", "g", 4, 1 / G, 1e-7, 0.0, -(1 << 31)),
    "height": ("LASER", "mm", 2, 1000.0, 0.01, 300.0, -(1 << 15)),
    "distance": ("ENCODER", "counts", 4, 1 / COUNT_M, 1.0, 0.0, None),
}
"""Of our channels: name, unit, width, units in one SI unit, scale, offset and dropout code."""
START_NS = 1_790_000_000 * 10**9
"""When the run of the example began: in September 2026."""
SIDES = {"left": " L", "right": " R"}

Counts = NDArray[np.integer]


def write_blocks(path: Path, header: Header, blocks: Iterable[tuple[int, int, Counts]]) -> None:
    """Write ``header`` and ``blocks``: channel, tick of the first sample, counts of shape (n,)."""
    with path.open("wb") as stream:
        stream.write(packed_header(header))
        for channel, tick, counts in blocks:
            stream.write(packed_block(channel, header.channels[channel].width, tick, counts))


def packed_header(header: Header) -> bytes:
    """Return the bytes of ``header`` in a file."""
    device = header.device.encode("ascii")
    words = (layout.MAGIC, layout.VERSION, len(header.channels), header.ticks_per_s)
    packed = layout.HEADER.pack(*words, header.start_ns, device)
    packed += b"".join(_packed_channel(channel) for channel in header.channels)
    return packed + layout.CHECK.pack(zlib.crc32(packed))


def packed_block(channel: int, width: int, tick: int, counts: Counts) -> bytes:
    """Return the bytes in a file of one block of 1 to 4096 ``counts``."""
    packed = layout.BLOCK.pack(layout.SYNC, channel, len(counts), tick)
    packed += np.asarray(counts, f"<i{width}").tobytes()
    return packed + layout.CHECK.pack(zlib.crc32(packed))


def _packed_channel(channel: LoggedChannel) -> bytes:
    return layout.CHANNEL.pack(
        channel.name.encode("ascii"),
        layout.UNITS.index(channel.unit),
        channel.width,
        int(channel.dropout is not None),
        channel.rate.numerator,
        channel.rate.denominator,
        channel.scale,
        channel.offset,
        channel.dropout or 0,
    )


def write_recording(
    recording: Recording, path: Path, start_ns: int = 0, device: str = "RL-0042"
) -> None:
    """Write the nominal channels of ``recording`` as a RoadLogger would have logged them.

    Samples are rounded to counts; a missing one, or one out of range, becomes the dropout code,
    or a gap if the channel has no code. Raises InputError for a channel without a constant rate.
    """
    taken = [c for c in recording.channels if c.id.name in SENSORS]
    header = Header(tuple(map(_logged, taken)), start_ns=start_ns, device=device)
    blocks = [_blocks(n, header, channel) for n, channel in enumerate(taken)]
    write_blocks(path, header, merge(*blocks, key=itemgetter(1)))


def _logged(channel: Channel) -> LoggedChannel:
    if not isinstance(channel.clock, UniformClock):
        raise InputError(f"channel {channel.id}: the RoadLogger samples at a constant rate")
    name, unit, width, _, scale, offset, dropout = SENSORS[channel.id.name]
    name += SIDES.get(channel.id.track or "", "")
    return LoggedChannel(name, unit, width, channel.clock.rate, scale, offset, dropout)


def _counts(channel: Channel, logged: LoggedChannel) -> tuple[Counts, NDArray[np.bool_]]:
    """Return all counts of ``channel``, and which of them are written."""
    per_si = SENSORS[channel.id.name][3]
    with np.errstate(invalid="ignore"):
        exact = np.rint((channel.values * per_si - logged.offset) / logged.scale)
        if logged.unit == "counts":
            turned = (exact + FIRST_COUNT + 2.0**31) % 2.0**32 - 2.0**31
            there = np.isfinite(turned)
            return np.where(there, turned, 0).astype(np.int64), there
        good = np.abs(exact) < 1 << (8 * logged.width - 1)
    return np.where(good, exact, logged.dropout or 0).astype(np.int64), np.ones(good.size, bool)


def _blocks(number: int, header: Header, channel: Channel) -> Iterator[tuple[int, int, Counts]]:
    logged = header.channels[number]
    counts, there = _counts(channel, logged)
    step = header.ticks_per_s / logged.rate
    first = round(channel.clock.times(1)[0] * header.ticks_per_s)
    for begin in range(0, counts.size, 1024):
        inside = np.flatnonzero(there[begin : begin + 1024]) + begin
        for run in np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1):
            if run.size:
                yield number, first + int(run[0] * step), counts[run]


if __name__ == "__main__":
    write_recording(read_recording(Path(sys.argv[1])), Path(sys.argv[2]), START_NS)
