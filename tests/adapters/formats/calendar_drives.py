"""A drive at a moment of the calendar, written in every format that holds the time of day.

``passed_ns`` are ns of UTC that have passed, as if no leap second came: 23:59:60 is the number of
the second behind it. ``stamps`` are what a clock in UTC shows of them.
"""

from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

import asammdf
import can
import h5py
import nptdms
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from floatref_adapters.testing.fixes import Fixes
from floatref_adapters.testing.nmea import nmea_log
from floatref_adapters.testing.novatel import ascii_log, binary_log

Ns = NDArray[np.int64]
S = 10**9
GPS_EPOCH_S = 315_964_800
STEP_NS = 50_000_000


def unix_ns(*when: int) -> int:
    return int(datetime(*when, tzinfo=UTC).timestamp()) * S


class Kept(NamedTuple):
    """How a format is written and read.

    ``write(path, stamps, leaps)`` writes the UTC ``stamps`` in ns since 1970, GPS time being
    ``leaps`` s ahead; ``stream`` is the stream to read, its first if empty.
    """

    suffix: str
    write: Callable[[Path, Ns, int], None]
    stream: str = ""
    options: Mapping[str, str] = {}


def fixes(stamps: Ns, ahead_s: int = 0) -> Fixes:
    n = len(stamps)
    ms = [int(stamp) // 10**6 + 1000 * ahead_s for stamp in stamps]
    return Fixes(
        ms, [48.0] * n, [11.0] * n, [500.0] * n, [46.0] * n, [4] * n, [20.0] * n, [90.0] * n,
        [0.0] * n,
    )  # fmt: skip


def value(stamps: Ns) -> NDArray[np.float64]:
    return np.arange(len(stamps), dtype=np.float64)


def write_mdf(path: Path, stamps: Ns, leaps: int) -> None:
    with asammdf.MDF(version="4.10") as mdf:
        mdf.header.abs_time, mdf.header.time_flags = int(stamps[0]), 0
        seconds = (stamps - stamps[0]) / S
        mdf.append(asammdf.Signal(value(stamps), seconds, "m", "x"))
        Path(mdf.save(path, overwrite=True)).replace(path)


def write_tdms_waveform(path: Path, stamps: Ns, leaps: int) -> None:
    start = np.datetime64(int(stamps[0]) // 1000, "us")
    wave = {"wf_start_time": start, "wf_increment": float(stamps[1] - stamps[0]) / S}
    with nptdms.TdmsWriter(str(path)) as writer:
        writer.write_segment([nptdms.ChannelObject("g", "x", value(stamps), wave)])


def write_tdms_stamps(path: Path, stamps: Ns, leaps: int) -> None:
    times = (stamps // 1000).astype("datetime64[us]")
    with nptdms.TdmsWriter(str(path)) as writer:
        writer.write_segment(
            [
                nptdms.ChannelObject("g", "time", times),
                nptdms.ChannelObject("g", "x", value(stamps)),
            ]
        )


def table(stamps: Ns) -> Any:
    times = pa.array(stamps, pa.timestamp("ns", tz="UTC"))
    return pa.table({"time": times, "x": value(stamps)})


def write_parquet(path: Path, stamps: Ns, leaps: int) -> None:
    pq.write_table(table(stamps), path)


def write_arrow(path: Path, stamps: Ns, leaps: int) -> None:
    rows = table(stamps)
    with pa.ipc.new_file(path, rows.schema) as writer:
        writer.write_table(rows)


def write_hdf5(path: Path, stamps: Ns, leaps: int) -> None:
    with h5py.File(path, "w") as file:
        file["time"], file["x"] = stamps // 10**6, value(stamps)
        file["time"].attrs["units"] = "milliseconds since 1970-01-01"


def iso(stamp: int, second: str = "") -> str:
    whole, part = divmod(stamp, S)
    text = f"{np.datetime64(whole, 's')}"
    return f"{text[:17]}{second or text[17:]}.{part // 10**6:03d}Z"


def write_csv_text(path: Path, stamps: Ns, leaps: int) -> None:
    rows = [f"{iso(stamp)},{k}" for k, stamp in enumerate(stamps.tolist())]
    path.write_text("\n".join(["time,x", *rows, ""]), encoding="ascii")


def write_csv_numbers(path: Path, stamps: Ns, leaps: int) -> None:
    rows = [f"{n // S}.{n % S // 10**6:03d},{k}" for k, n in enumerate(stamps.tolist())]
    path.write_text("\n".join(["time_s,x", *rows, ""]), encoding="ascii")


def write_nmea(path: Path, stamps: Ns, leaps: int) -> None:
    path.write_bytes(nmea_log(fixes(stamps)))


def gps(stamps: Ns, leaps: int) -> Fixes:
    return fixes(stamps - GPS_EPOCH_S * S, leaps)


def write_novatel_text(path: Path, stamps: Ns, leaps: int) -> None:
    path.write_bytes(ascii_log(gps(stamps, leaps)))


def write_novatel_binary(path: Path, stamps: Ns, leaps: int) -> None:
    path.write_bytes(binary_log(gps(stamps, leaps)))


def write_can(path: Path, stamps: Ns, leaps: int) -> None:
    with can.Logger(str(path)) as log:
        for stamp in stamps.tolist():
            log.on_message_received(
                can.Message(timestamp=stamp / S, arbitration_id=1, data=bytes(2), channel=0,
                            is_extended_id=False)
            )  # fmt: skip


ABSOLUTE: Mapping[str, Kept] = {
    "MDF4": Kept(".mf4", write_mdf),
    "TDMS waveform": Kept(".tdms", write_tdms_waveform),
    "TDMS stamps": Kept(".tdms", write_tdms_stamps),
    "Parquet": Kept(".parquet", write_parquet),
    "Arrow": Kept(".arrow", write_arrow),
    "HDF5": Kept(".h5", write_hdf5),
    "CSV text": Kept(".csv", write_csv_text),
    "CSV numbers": Kept(".csv", write_csv_numbers, options={"epoch": "utc"}),
    "NMEA": Kept(".nmea", write_nmea, "GGA"),
    "NovAtel ASCII": Kept(".gps", write_novatel_text, "BESTPOS"),
    "NovAtel binary": Kept(".gps", write_novatel_binary, "BESTPOS"),
    "candump": Kept(".log", write_can),
    "CSV of python-can": Kept(".csv", write_can),
}
"""Formats that hold the date."""
RELATIVE: Mapping[str, Kept] = {
    "BLF": Kept(".blf", write_can),
    "ASC": Kept(".asc", write_can),
    "TRC": Kept(".trc", write_can),
}
"""Formats that count from the start of the log, whose date is of an unknown zone."""
OF_STAMPS = ("TDMS stamps", "Parquet", "Arrow", "HDF5", "CSV text", "CSV numbers", "NMEA",
             "candump", "CSV of python-can")  # fmt: skip
"""Those of `ABSOLUTE` in which every row has the time that a clock in UTC showed."""


def exact(seconds: Fraction) -> int:
    """Return whole ns."""
    return round(seconds * S)
