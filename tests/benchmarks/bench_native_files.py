"""Measure reading native files: throughput beside the bare library, and memory of `process`.

Writes a drive of two wheel paths at 16 kHz with forces and rates (nine channels) into one file per
format; reads it with the format's own library, every channel as float64 and let go of; reads it
so through the adapter; reads it into a recording with ``floatref.read_native``, units, clocks,
checks and all; then runs ``floatref process``. Each in a process of its own, which says its peak
of resident memory. Run as ``python tests/benchmarks/bench_native_files.py [--gigabytes 2]
[--formats mdf4 parquet ...]``, with TMPDIR naming a folder with room for three times that.
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

import floatref
from floatref import Channel, Recording, UniformClock

SUFFIXES = {
    "mdf4": ".mf4",
    "tdms": ".tdms",
    "parquet": ".parquet",
    "arrow": ".arrow",
    "hdf5": ".h5",
    "csv": ".csv",
}
RATE_HZ, SPEED_MPS = 16_000.0, 20.0
SHARED = ("longitudinal_specific_force", "lateral_specific_force", "roll_rate", "pitch_rate")
CSV_GIGABYTES = 0.1
"""Text is read so much slower that less of it tells the rate."""
CHUNK = 1 << 18


def drive(seconds: float) -> Recording:
    """Return a drive at constant speed on a wavy road, the body swaying at 1.5 Hz."""
    count = int(seconds * RATE_HZ)
    clock = UniformClock.of(RATE_HZ)
    times = np.arange(count) / RATE_HZ
    noise = np.random.default_rng(7)
    sway = 2 * np.pi * 1.5
    lift = 0.01 * np.sin(sway * times)
    channels = [Channel.of("distance", SPEED_MPS * times, clock)]
    for track, phase in (("left", 0.0), ("right", 1.0)):
        road = 0.005 * np.sin(2 * np.pi * SPEED_MPS * times / 7.0 + phase)
        force = 9.80665 - sway**2 * lift + 0.01 * noise.standard_normal(count)
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
        channels.append(Channel.of("height", 0.3 + lift - road, clock, track))
    for name in SHARED:
        channels.append(Channel.of(name, 0.02 * noise.standard_normal(count), clock))
    return Recording(tuple(channels))


def make(form: str, path: Path, gigabytes: float) -> None:
    """Write a file of about ``gigabytes``."""
    from floatref_adapters.testing import WRITERS

    size = {"csv": 19.0, "parquet": 6.7}.get(form, 8.0)
    recording = drive(gigabytes * 1e9 / (size * RATE_HZ * 9))
    WRITERS[SUFFIXES[form]](recording, path)


def bare_mdf4(path: Path) -> Iterator[np.ndarray]:
    from asammdf import MDF

    with MDF(path) as mdf:
        for group, _ in enumerate(mdf.groups):
            names = [channel.name for channel in mdf.groups[group].channels]
            for first in range(0, mdf.groups[group].channel_group.cycles_nr, CHUNK):
                picked = [(None, group, index) for index, _ in enumerate(names)]
                yield from (
                    signal.samples
                    for signal in mdf.select(picked, record_offset=first, record_count=CHUNK)
                )


def bare_tdms(path: Path) -> Iterator[np.ndarray]:
    from nptdms import TdmsFile

    with TdmsFile.open(path) as file:
        for chunk in file.data_chunks():
            for group in chunk.groups():
                yield from (channel[:] for channel in group.channels())


def bare_parquet(path: Path) -> Iterator[np.ndarray]:
    from pyarrow.parquet import ParquetFile

    for batch in ParquetFile(path).iter_batches(CHUNK):
        yield from (column.to_numpy(zero_copy_only=False) for column in batch.columns)


def bare_arrow(path: Path) -> Iterator[np.ndarray]:
    import pyarrow as pa

    with pa.memory_map(str(path)) as source, pa.ipc.open_file(source) as reader:
        for index in range(reader.num_record_batches):
            batch = reader.get_batch(index)
            yield from (column.to_numpy(zero_copy_only=False).copy() for column in batch.columns)


def bare_hdf5(path: Path) -> Iterator[np.ndarray]:
    import h5py

    with h5py.File(path) as file:
        found: list[h5py.Dataset] = []
        file.visititems(lambda _, item: found.append(item) if hasattr(item, "shape") else None)
        for dataset in found:
            yield from (dataset[at : at + CHUNK] for at in range(0, dataset.shape[0], CHUNK))


def bare_csv(path: Path) -> Iterator[np.ndarray]:
    import csv
    from itertools import islice

    with path.open(newline="") as stream:
        reader = csv.reader(stream)
        next(reader)
        while rows := list(islice(reader, CHUNK)):
            yield from (
                np.array([float(x) if x else np.nan for x in c]) for c in zip(*rows, strict=True)
            )


BARE: dict[str, Callable[[Path], Iterator[np.ndarray]]] = {
    "mdf4": bare_mdf4,
    "tdms": bare_tdms,
    "parquet": bare_parquet,
    "arrow": bare_arrow,
    "hdf5": bare_hdf5,
    "csv": bare_csv,
}


def bare(form: str, path: Path) -> None:
    """Read ``path`` with the library alone, every sample looked at once as float64."""
    total = 0.0
    for values in BARE[form](path):
        if values.dtype.kind in "fiu":
            total += float(np.asarray(values, np.float64)[-1])


def adapter(form: str, path: Path) -> None:
    """Read every column through the adapter, as a mapping does, and let go of it."""
    from floatref.engine.recordings.readers import native_of, reader_of

    total = 0.0
    with native_of(reader_of(path, None), path, {}) as native:
        for stream in native.streams:
            for rows in stream.read([c.name for c in stream.columns if c.numeric]):
                total += sum(float(values[-1]) for values in rows.values.values())


def ours(form: str, path: Path) -> None:
    assert len(floatref.read_native(path).recording.channels) == 9


def process(form: str, path: Path) -> None:
    from floatref.cli.main import main

    out = path.with_name("profile")
    main(
        [str(x) for x in ("process", path, "--out", out, "--overwrite", "--json")],
        standalone_mode=False,
    )


STEPS = {"bare": bare, "adapter": adapter, "ours": ours, "process": process}


def step(name: str, form: str, path: Path) -> None:
    """Do one step and print seconds and peak memory."""
    started = time.perf_counter()
    STEPS[name](form, path)
    seconds = time.perf_counter() - started
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"seconds": seconds, "peak_mb": peak}))


def measured(name: str, form: str, path: Path, runs: int = 1) -> dict[str, float]:
    """Return the fastest of ``runs`` runs of a step in a process of its own."""
    command = [sys.executable, __file__, "--step", name, form, str(path)]
    found = []
    for _ in range(runs):
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        found.append(json.loads(said.splitlines()[-1]))
    return min(found, key=lambda each: each["seconds"])


def measure(form: str, gigabytes: float, folder: Path) -> None:
    """Print a row for one format."""
    path = folder / f"drive{SUFFIXES[form]}"
    gigabytes = min(gigabytes, CSV_GIGABYTES) if form == "csv" else gigabytes
    command = [sys.executable, __file__, "--make", form, str(path), "--gigabytes", str(gigabytes)]
    subprocess.run(command, check=True)
    size = path.stat().st_size / 1e6
    found = {name: measured(name, form, path, 3) for name in ("bare", "adapter", "ours")}
    found["process"] = measured("process", form, path)
    print(f"{form}, {size / 1e3:.2f} GB")
    for name, each in found.items():
        rate, ratio = size / each["seconds"], found["bare"]["seconds"] / each["seconds"]
        print(
            f"  {name:8s} {each['seconds']:6.1f} s {rate:6.0f} MB/s  {ratio:4.2f} of the bare "
            f"library  {each['peak_mb']:4.0f} MB",
            flush=True,
        )
    path.unlink()


def main() -> None:
    """Measure the formats asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--gigabytes", type=float, default=2.0)
    parser.add_argument("--formats", nargs="*", default=list(SUFFIXES), choices=list(SUFFIXES))
    parser.add_argument("--step", nargs=3)
    parser.add_argument("--make", nargs=2)
    given = parser.parse_args()
    if given.step:
        step(given.step[0], given.step[1], Path(given.step[2]))
    elif given.make:
        make(given.make[0], Path(given.make[1]), given.gigabytes)
    else:
        with tempfile.TemporaryDirectory() as folder:
            for form in given.formats:
                measure(form, given.gigabytes, Path(folder))


if __name__ == "__main__":
    main()
