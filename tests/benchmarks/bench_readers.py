"""Compare the readers of two checkouts: processor time and peak memory, taken in turns.

Writes one file per format with the writers of this checkout: a drive of nine channels at 16 kHz,
fixes of a GNSS receiver, wheel speeds on a CAN bus, and a profile of two wheel paths. Every reader
then reads all numbers of its file in a process of its own, once per checkout and round. Printed are
the median and the least processor time, child processes included, and the median of the peak
memory, with the ratio of each checkout to the first. Run as
``python tests/benchmarks/bench_readers.py old=/path/to/old/.venv/bin/python
new=/path/to/new/.venv/bin/python [--megabytes 200] [--rounds 5] [--formats mdf4 tdms ...]``.
"""

import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from bench_gnss_and_can import PIECES, make
from bench_native_files import SUFFIXES, drive
from bench_native_files import make as make_drive

TEXT_SHARE = 0.1
"""Text is parsed so much slower that a tenth of the size is enough."""
TEXT = ("csv", "erd", *PIECES, "candump", "blf")
FORMATS = [*SUFFIXES, "mdf4-compressed", "mdf4-mixed", "tdms-integers", *PIECES, "candump"]
FORMATS += ["blf", "erd"]


def write(form: str, path: Path, megabytes: float) -> None:
    """Write a file of about ``megabytes``."""
    if form in SUFFIXES:
        make_drive(form, path, megabytes / 1e3)
    elif form in PIECES:
        make(form, path, megabytes)
    else:
        OTHERS[form](path, megabytes)


def _mdf4_compressed(path: Path, megabytes: float) -> None:
    from floatref_adapters.testing.mdf4 import write as write_blocks

    write_blocks(_stored_groups(1, megabytes, True), path)


def _mdf4_mixed(path: Path, megabytes: float) -> None:
    from floatref_adapters.testing.mdf4 import write as write_blocks

    write_blocks(_stored_groups(3, megabytes / 8, False), path, mixed=True)


def _stored_groups(groups: int, megabytes: float, compressed: bool) -> list[Any]:
    from floatref_adapters.testing.mdf4 import MASTER, Stored, StoredGroup

    count = int(megabytes * 1e6 / (8 * 9 * groups))
    noise = np.random.default_rng(3)
    made = []
    for k in range(groups):
        master = Stored("time", np.arange(count) * 6.25e-5, "s", kind=MASTER)
        values = [
            Stored(f"c{n}", noise.integers(0, 1000, count), "m", (1e-5, 0.0)) for n in range(8)
        ]
        made.append(StoredGroup(f"g{k}", [master, *values], compressed=compressed))
    return made


def _tdms_integers(path: Path, megabytes: float) -> None:
    from floatref_adapters.testing import WRITERS

    recording = drive(megabytes * 1e6 / (8.0 * 16_000 * 9))
    WRITERS[".tdms"](recording, path, {c.id.name: 1e-6 for c in recording.channels})


def _candump(path: Path, megabytes: float) -> None:
    from floatref_adapters.testing.can_log import WHEELS_DBC, WHEELS_ID, candump_log, wheels_data

    count = int(megabytes * 1e6 / 47)
    frames = [
        (10_000 * k, WHEELS_ID, wheels_data([7200 + k % 7, 7200, 7201, 7199])) for k in range(count)
    ]
    path.write_text(candump_log(frames))
    path.with_name("wheels.dbc").write_text(WHEELS_DBC)


def _blf(path: Path, megabytes: float) -> None:
    import can

    from floatref_adapters.testing.can_log import WHEELS_DBC, WHEELS_ID, wheels_data

    with can.BLFWriter(path) as writer:
        for k in range(int(megabytes * 1e6 / 12)):
            data = wheels_data([7200 + k % 7, 7200, 7201, 7199])
            message = can.Message(k / 100, WHEELS_ID, is_extended_id=False, data=data, channel=0)
            writer.on_message_received(message)
    path.with_name("wheels.dbc").write_text(WHEELS_DBC)


def _erd(path: Path, megabytes: float) -> None:
    from floatref import Profile, ProfileTrack

    count = int(megabytes * 1e6 / 22)
    noise = np.random.default_rng(5).standard_normal((2, count))
    tracks = [
        ProfileTrack.of(name, 0.01 * row)
        for name, row in zip(("left", "right"), noise, strict=True)
    ]
    _format("erd").write(Profile(0.025, tuple(tracks)), path)


OTHERS = {
    "mdf4-compressed": _mdf4_compressed,
    "mdf4-mixed": _mdf4_mixed,
    "tdms-integers": _tdms_integers,
    "candump": _candump,
    "blf": _blf,
    "erd": _erd,
}


def _format(name: str) -> Any:
    from floatref_adapters.plugin import floatref_register_profile_formats

    found: list[Any] = []
    floatref_register_profile_formats(found.append)
    return next(each for each in found if each.name == name)


def read(form: str, path: Path) -> float:
    """Return the sum of the last numbers of all pieces, so that every number is delivered."""
    from floatref_adapters.plugin import floatref_register_adapters

    if form == "erd":
        return float(sum(track.elevation[-1] for track in _format("erd").read(path).tracks))
    found: list[Any] = []
    floatref_register_adapters(found.append)
    adapter = next(each for each in found if each.recognises(path))
    dbc = path.with_name("wheels.dbc")
    total = 0.0
    with adapter.streams(path, {"dbc": str(dbc)} if dbc.is_file() else {}) as native:
        for stream in native.streams:
            for rows in stream.read([c.name for c in stream.columns if c.numeric]):
                total += sum(float(np.nan_to_num(v[-1])) for v in rows.values.values())
    return total


def step(form: str, path: Path) -> None:
    """Read once; print the sum, seconds of processor time, and peak memory in MB."""
    total = read(form, path)
    used = [resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    seconds = sum(each.ru_utime + each.ru_stime for each in used)
    peak = max(each.ru_maxrss for each in used) / 1024
    print(json.dumps({"total": total, "seconds": seconds, "peak_mb": peak}))


def compare(form: str, path: Path, pythons: dict[str, str], rounds: int) -> None:
    """Print a row for each checkout."""
    found: dict[str, list[dict[str, float]]] = {name: [] for name in pythons}
    for _ in range(rounds):
        for name, python in pythons.items():
            command = [python, __file__, "--step", form, str(path)]
            printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            found[name].append(json.loads(printed.splitlines()[-1]))
    if len({run["total"] for runs in found.values() for run in runs}) > 1:
        print(f"{form}: the checkouts read other numbers")
    first: tuple[float, float] | None = None
    for name, runs in found.items():
        seconds = statistics.median(run["seconds"] for run in runs)
        least = min(run["seconds"] for run in runs)
        peak = statistics.median(run["peak_mb"] for run in runs)
        first = first or (least, peak)
        print(
            f"{form:16s} {path.stat().st_size / 1e6:4.0f} MB  {name:6s} {seconds:6.2f} s, least "
            f"{least:6.2f} s ({least / first[0]:4.2f})  {peak:4.0f} MB ({peak / first[1]:4.2f})",
            flush=True,
        )


def main() -> None:
    """Measure the formats asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pythons", nargs="*", metavar="NAME=PYTHON")
    parser.add_argument("--megabytes", type=float, default=200.0)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--formats", nargs="*", default=FORMATS, choices=FORMATS)
    parser.add_argument("--keep", type=Path, help="folder to keep the files in")
    parser.add_argument("--step", nargs=2)
    parser.add_argument("--write", nargs=2)
    given = parser.parse_args()
    if given.write:
        write(given.write[0], Path(given.write[1]), given.megabytes)
        return
    if given.step:
        step(given.step[0], Path(given.step[1]))
        return
    pythons = dict(text.split("=", 1) for text in given.pythons or [f"this={sys.executable}"])
    with tempfile.TemporaryDirectory() as temporary:
        for form in given.formats:
            folder = Path(given.keep or temporary) / form
            folder.mkdir(parents=True, exist_ok=True)
            path = folder / f"drive{SUFFIXES.get(form, '.log')}"
            if not path.exists():
                # A process that has been large would leave its peak to those that it starts.
                size = given.megabytes * (TEXT_SHARE if form in TEXT else 1.0)
                command = [sys.executable, __file__, "--write", form, str(path)]
                subprocess.run([*command, "--megabytes", str(size)], check=True)
            compare(form, path, pythons, given.rounds)
            if not given.keep:
                path.unlink()


if __name__ == "__main__":
    main()
