"""Fuzz the example of a vendor's adapter: any bytes are streams, or one `InputError` of one line.

Run it as `harness` says. No fuzzer guesses a CRC-32: after the first byte of an input, the checks
of the header and of the blocks are put right, so that what lies behind them is reached.
"""

import sys
import warnings
import zlib
from fractions import Fraction
from pathlib import Path

import numpy as np
from harness import fuzz, instrumented, one_line, scratch

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs" / "examples" / "vendor_plugin"))

with instrumented():
    from acme_roadlogger import layout
    from acme_roadlogger.adapter import RoadLogger
    from acme_roadlogger.blocks import Skipped, sound_blocks
    from acme_roadlogger.header import read_header
    from acme_roadlogger.layout import Header, LoggedChannel
    from acme_roadlogger.writer import packed_block, packed_header

    from floatref import NativeFile, Stream

FILE = scratch("logger") / "run.arl"
WHOLE, BLOCKS_AS_THEY_ARE, AS_IT_IS = range(3)
"""What the first byte of an input says of the checks."""


def read_any(data: bytes) -> None:
    FILE.write_bytes(checked(data[1:], data[0] % 3) if data else b"")
    RoadLogger().recognises(FILE)
    native = one_line(RoadLogger().streams, FILE, {})
    if native is None:
        return
    for stream in native.streams:
        whole(stream)
    accounted(native)


def whole(stream: Stream) -> None:
    """Raise AssertionError unless ``stream`` holds what it says, finite and with its ticks."""
    rows, name = 0, stream.columns[0].name
    for part in stream.read([name]):
        if part.ticks is None or part.ticks.size != part.values[name].size:
            raise AssertionError("rows without ticks")
        if (
            part.ticks.dtype != np.int64
            or part.ticks.min() < 0
            or np.isinf(part.values[name]).any()
        ):
            raise AssertionError("ticks or samples beyond their range")
        rows += part.ticks.size
    if rows != stream.count or not name.isprintable():
        raise AssertionError(f"{rows} rows of {stream.count} in {name!r}")


def accounted(native: NativeFile) -> None:
    """Raise AssertionError unless every byte is of the header, of a sound block, or skipped."""
    header, at = read_header(FILE)
    skipped = Skipped()
    for _, _, counts in sound_blocks(FILE, header, at, skipped):
        at += layout.AROUND + counts.nbytes
    if at + skipped.size != FILE.stat().st_size or skipped.warnings() != native.warnings:
        raise AssertionError("bytes are lost and nobody says so")
    if bool(skipped.size) != bool(native.warnings):
        raise AssertionError("damage is not told")


def checked(data: bytes, kept: int) -> bytes:
    """Return ``data`` with checks put in where they belong, as far as ``kept`` says."""
    if kept == AS_IT_IS or len(data) < layout.HEADER.size:
        return data
    channels = layout.HEADER.unpack_from(data)[2] % (layout.MOST_CHANNELS + 1)
    end = layout.HEADER.size + channels * layout.CHANNEL.size
    head, rest = data[:end], data[end:]
    head += layout.CHECK.pack(zlib.crc32(head))
    if kept == BLOCKS_AS_THEY_ARE:
        return head + rest
    return head + b"".join(blocks(rest))


def blocks(data: bytes) -> list[bytes]:
    """Return the pieces of ``data`` between syncs, each with its check."""
    pieces = [layout.SYNC + piece for piece in data.split(layout.SYNC)]
    return [piece + layout.CHECK.pack(zlib.crc32(piece)) for piece in pieces]


def seeds() -> list[bytes]:
    """Return inputs to begin with: files as they are written, without the checks put right."""
    channels = (
        LoggedChannel("A", "g", 4, Fraction(1000), 1e-6, dropout=5),
        LoggedChannel("B", "mm", 2, Fraction(3, 2), 0.5, -1.0),
    )
    head = packed_header(Header(channels, start_ns=7, device="X"))
    parts = [packed_block(n % 2, 4 - 2 * (n % 2), 10**6 * n, np.arange(9)) for n in range(4)]
    bare = head[:-4] + b"".join(part[4:-4] + layout.SYNC for part in parts)
    return [bytes([WHOLE]) + bare, bytes([AS_IT_IS]) + head + b"".join(parts)]


def main() -> None:
    """Fuzz with every warning an error."""
    warnings.simplefilter("error")
    fuzz("vendor_logger", read_any, seeds())


if __name__ == "__main__":
    main()
