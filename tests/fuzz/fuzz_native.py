"""Fuzz the reader of one native format: any bytes are streams, or one `InputError` of one line.

Run it as `harness` says, with the name of an adapter of `floatref adapters` before the options:

    python tests/fuzz/fuzz_native.py mdf4 -max_total_time=300 CORPUS

A file that is read has as many rows as were counted, in every column of numbers.
"""

import sys
from pathlib import Path

import can
from harness import fuzz, instrumented, one_line, scratch
from parsers import NATIVE

with instrumented():
    import numpy as np

    from floatref import Channel, Recording, Stream, UniformClock
    from floatref.engine.plugins import plugins

    ADAPTERS = plugins().adapters()

from floatref_adapters.formats.mcap_log.adapter import Mcap
from floatref_adapters.testing import WRITERS

TEXTS = {
    "nmea": (
        b"$GPGGA,123519.00,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*69\r\n"
        b"$GPRMC,123519.00,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*44\r\n",
        b"$GNVTG,054.7,T,034.4,M,005.5,N,010.2,K*56\r\n$PASHR,130533.62,0.2,T,1,2,3,4,5,6,1*00\n",
    ),
    "novatel": (
        b"#BESTVELA,COM1,0,60.0,FINESTEERING,2000,345600.000,0,0,0;SOL_COMPUTED,DOPPLER_VELOCITY,"
        b"0.15,0.0,10.0,45.0,0.1,0.0*00000000\r\n",
        bytes.fromhex("aa44121c2a0000204800000090b4d0070000000000000000000000000000"),
    ),
    "can": (
        b"date Mon Jan 1 00:00:00 2024\nbase hex timestamps absolute\n0.1 1 123 Rx d 2 00 01\n",
        b"(1700000000.000100) can0 123#0001\n(1700000000.000200) can0 00000124#02\n",
        b";$FILEVERSION=2.1\n;$STARTTIME=45000.0\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n"
        b" 1 0.1 DT 1 0123 Rx - 2 00 01\n",
        b"timestamp,arbitration_id,extended,remote,error,dlc,data\n1.0,0x123,0,0,0,2,AAE=\n",
    ),
}
NAME = sys.argv.pop(1) if len(sys.argv) > 1 else ""
FOLDER = scratch("native")
MOST_ROWS = 100_000
"""Rows that are read: a file of a few bytes that counts more is only counted."""


def make_seeds(name: str) -> list[bytes]:
    """Return sound files of the format ``name``."""
    if name in TEXTS:
        return [*TEXTS[name], *(write_blf(level) for level in (0, 9) if name == "can")]
    clock = UniformClock.of(100.0)
    heights = Channel.of("height", 0.3 + 0.01 * np.sin(np.arange(40) / 3.0), clock, "left")
    distance = Channel.of("distance", 0.1 * np.arange(40.0), clock)
    recording, path = Recording((heights, distance)), FOLDER / f"seed{NATIVE[name]}"
    if name == "mcap":
        Mcap().write(recording, path)
    else:
        WRITERS[NATIVE[name]](recording, path, None)
    return [path.read_bytes()]


def write_blf(level: int) -> bytes:
    """Return a BLF log of python-can; at ``level`` 0 its objects are as they are in the file."""
    path = FOLDER / "seed.blf"
    with can.BLFWriter(path, compression_level=level) as log:
        for k in range(8):
            log(can.Message(timestamp=k / 64, arbitration_id=0x123, data=bytes([k] * 8), channel=0))
    return path.read_bytes()


def read_any(data: bytes) -> None:
    path = FOLDER / f"a{NATIVE[NAME]}"
    path.write_bytes(data)
    ADAPTERS[NAME].recognises(path)
    one_line(check_all, path)


def check_all(path: Path) -> None:
    if NAME == "mcap":  # It holds our own channels.
        ADAPTERS[NAME].read(path)
        return
    with ADAPTERS[NAME].streams(path, {}) as native:
        for stream in native.streams:
            check(stream)


def check(stream: Stream) -> None:
    """Raise AssertionError unless all columns of numbers have the rows that were counted."""
    names = [column.name for column in stream.columns if column.numeric]
    if not names or stream.count > MOST_ROWS:
        return
    rows = [*stream.read(names)]
    for name in names:
        found = sum(each.values[name].size for each in rows)
        if found != stream.count:
            raise AssertionError(f"{found} rows of {stream.count}")


if __name__ == "__main__":
    if NAME not in NATIVE:
        sys.exit(f"name one of these first: {', '.join(NATIVE)}")
    fuzz(NAME, read_any, make_seeds(NAME))
