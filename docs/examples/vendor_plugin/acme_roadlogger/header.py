"""Reading the header of a file, and refusing other files in one line."""

import zlib
from fractions import Fraction
from pathlib import Path
from typing import Any

from acme_roadlogger import layout
from acme_roadlogger.layout import Header, LoggedChannel
from floatref import InputError

RATES = Fraction(1, 1000), Fraction(10**7)
"""Slowest and fastest sensor, in Hz."""
LARGEST = 1e30
"""Largest scale and offset; a sample is then finite."""


def read_header(source: Path) -> tuple[Header, int]:
    """Return the header of ``source`` and the place of the first block, or raise InputError."""
    with source.open("rb") as stream:
        start = stream.read(layout.HEADER.size)
        if len(start) < layout.HEADER.size or not start.startswith(layout.MAGIC):
            raise InputError(f"{source}: no file of a RoadLogger; copy it again, as binary")
        _, version, size, ticks_per_s, start_ns, device = layout.HEADER.unpack(start)
        if version != layout.VERSION:
            raise InputError(f"{source}: version {version}; this reads version {layout.VERSION}")
        if not 0 < size <= layout.MOST_CHANNELS or not ticks_per_s:
            numbers = f"{size} channels and {ticks_per_s} ticks per second"
            raise InputError(f"{source}: {numbers} are no logger's; copy it again")
        table, check = stream.read(size * layout.CHANNEL.size), stream.read(layout.CHECK.size)
    if check != layout.CHECK.pack(zlib.crc32(start + table)):
        raise InputError(f"{source}: the header is truncated or damaged; copy it again")
    channels = tuple(_channel(source, entry) for entry in layout.CHANNEL.iter_unpack(table))
    begin = len(start) + len(table) + len(check)
    return Header(channels, ticks_per_s, start_ns, _text(device)), begin


def _channel(source: Path, entry: tuple[Any, ...]) -> LoggedChannel:
    name, unit, width, dropouts, top, bottom, scale, offset, code = entry
    place = f"{source}: channel {_text(name)!r}"
    if width not in layout.WIDTHS:
        raise InputError(f"{place}: samples of {width} bytes; the logger has 2 and 4")
    if unit >= len(layout.UNITS):
        raise InputError(f"{place}: unit code {unit} is unknown; update this plug-in")
    if not bottom or not RATES[0] <= Fraction(top, bottom) <= RATES[1]:
        raise InputError(f"{place}: a rate of {top}/{bottom} Hz is no sensor's; set the logger up")
    if not (0 < abs(scale) <= LARGEST and abs(offset) <= LARGEST):
        raise InputError(f"{place}: scale {scale}, offset {offset}; set the logger up")
    dropout = code if dropouts else None
    rate = Fraction(top, bottom)
    return LoggedChannel(_text(name), layout.UNITS[unit], width, rate, scale, offset, dropout)


def _text(padded: bytes) -> str:
    text = padded.rstrip(b"\0").decode("ascii", "backslashreplace")
    return text if text.isprintable() else ascii(text)[1:-1]
