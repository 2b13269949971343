"""Measure reading logs of GNSS receivers and CAN buses: rate beside the bare libraries, memory.

Writes a drive as NMEA 0183, as NovAtel ASCII and binary logs, and as a Vector ASC log of wheel
speeds; reads each with the format's own library, every number looked at once, and through the
adapter, every column of every stream. Each in a process of its own, which says its peak of
resident memory. Run as ``python tests/benchmarks/bench_gnss_and_can.py [--megabytes 100]
[--formats nmea asc ...]``.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from floatref_adapters.testing.can_log import WHEELS_DBC, WHEELS_ID, asc_log, wheels_data
from floatref_adapters.testing.fixes import Fixes
from floatref_adapters.testing.nmea import nmea_log
from floatref_adapters.testing.novatel import WEEK_MS, ascii_log, binary_log

PIECE = 2000
"""Epochs written together."""
STEP_MS = 10


def fixes(first: int) -> Fixes:
    """Return ``PIECE`` fixes of a drive at 100 Hz, from the epoch ``first`` on."""
    at = first + np.arange(PIECE)
    noise = np.random.default_rng(first).standard_normal((2, PIECE))
    return Fixes(
        (2300 * WEEK_MS + STEP_MS * at).tolist(),
        (48.1 + 1e-7 * at).tolist(),
        (11.5 + 2e-7 * at).tolist(),
        (520 + 0.02 * noise[0]).tolist(),
        [46.9] * PIECE,
        [4] * PIECE,
        [20.0] * PIECE,
        [63.4] * PIECE,
        (0.02 * noise[1]).tolist(),
    )


def frames(first: int) -> str:
    """Return ``PIECE`` frames of an ASC log at 100 Hz, without its header."""
    rows = [
        (10_000 * k, WHEELS_ID, wheels_data([7200 + k % 7, 7200, 7201, 7199]))
        for k in range(first, first + PIECE)
    ]
    text = asc_log(rows)
    return text if first == 0 else "".join(text.splitlines(keepends=True)[4:])


PIECES: dict[str, Callable[[int], bytes]] = {
    "nmea": lambda first: nmea_log(fixes(first)),
    "novatel-ascii": lambda first: ascii_log(fixes(first)),
    "novatel-binary": lambda first: binary_log(fixes(first)),
    "asc": lambda first: frames(first).encode("ascii"),
}


def make(form: str, path: Path, megabytes: float) -> None:
    """Write a log of about ``megabytes``."""
    with path.open("wb") as stream:
        first = 0
        while stream.tell() < megabytes * 1e6:
            stream.write(PIECES[form](first))
            first += PIECE
    path.with_name("wheels.dbc").write_text(WHEELS_DBC)


def bare_nmea(path: Path) -> Iterator[float]:
    import pynmea2

    with path.open(encoding="ascii") as stream:
        for line in stream:
            for field in pynmea2.parse(line, check=True).data:
                yield _number(field)


def bare_novatel(path: Path) -> Iterator[float]:
    from novatel_edie.oem import FileParser

    for message in FileParser(path):
        for name in message.get_field_names():
            yield _number(getattr(message, name))


def bare_asc(path: Path) -> Iterator[float]:
    import can
    import cantools

    database = cantools.database.load_file(path.with_name("wheels.dbc"))
    with can.ASCReader(path) as reader:
        for frame in reader:
            found = database.decode_message(frame.arbitration_id, frame.data, decode_choices=False)
            yield from found.values()


def _number(field: object) -> float:
    try:
        return float(field)  # type: ignore[arg-type]  # What is no number is 0.
    except (TypeError, ValueError):
        return 0.0


BARE: dict[str, Callable[[Path], Iterator[float]]] = {
    "nmea": bare_nmea,
    "novatel-ascii": bare_novatel,
    "novatel-binary": bare_novatel,
    "asc": bare_asc,
}


def bare(form: str, path: Path) -> int:
    """Read ``path`` with the library alone; return how many numbers it had."""
    return sum(1 for _ in BARE[form](path))


def adapter(form: str, path: Path) -> int:
    """Read every column through the adapter; return how many numbers they had."""
    from floatref.engine.recordings.readers import native_of, reader_of

    options = {"dbc": str(path.with_name("wheels.dbc"))} if form == "asc" else {}
    count = 0
    with native_of(reader_of(path, None), path, options) as native:
        for stream in native.streams:
            for rows in stream.read([c.name for c in stream.columns if c.numeric]):
                count += sum(values.size for values in rows.values.values())
    return count


STEPS = {"bare": bare, "adapter": adapter}


def step(name: str, form: str, path: Path) -> None:
    """Do one step and print seconds of CPU time, peak memory and the count of numbers."""
    started = time.process_time()
    count = STEPS[name](form, path)
    seconds = time.process_time() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"seconds": seconds, "peak_mb": peak, "count": count}))


def measure(form: str, megabytes: float, folder: Path) -> None:
    """Print the rows of one format."""
    path = folder / f"drive-{form}.{'asc' if form == 'asc' else 'gps'}"
    make(form, path, megabytes)
    size = path.stat().st_size / 1e6
    print(f"{form}, {size:.0f} MB")
    found = {}
    for name in STEPS:
        command = [sys.executable, __file__, "--step", name, form, str(path)]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        each = found[name] = json.loads(said.splitlines()[-1])
        rate, ratio = size / each["seconds"], found["bare"]["seconds"] / each["seconds"]
        print(
            f"  {name:8s} {each['seconds']:6.1f} s {rate:5.1f} MB/s  {ratio:4.2f} of the bare "
            f"library  {each['peak_mb']:4.0f} MB  {each['count']} numbers",
            flush=True,
        )
    path.unlink()


def main() -> None:
    """Measure the formats asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--megabytes", type=float, default=100.0)
    parser.add_argument("--formats", nargs="*", default=list(PIECES), choices=list(PIECES))
    parser.add_argument("--step", nargs=3)
    given = parser.parse_args()
    if given.step:
        step(given.step[0], given.step[1], Path(given.step[2]))
        return
    with tempfile.TemporaryDirectory() as folder:
        for form in given.formats:
            measure(form, given.megabytes, Path(folder))


if __name__ == "__main__":
    main()
