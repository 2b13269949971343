"""What `floatref batch` costs: long recordings by one and by two workers in turn, empty tasks."""

import os
import statistics
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import psutil
from batch_checks import efforts
from batch_runs import batch, cluster
from bench_memory import write_document, write_samples

ROUNDS = 2
TASKS = 3000
SECONDS = 300.0
PIPELINES = ("temporal-basic", "temporal-adaptive-hpf-spatial-backward", "road-prior-smoother")
"""The conventional one, and those recommended to nominal sensors."""
FEW = 2
"""Long recordings that every pipeline is given."""


def write_drives(folder: Path, count: int, seconds: float = SECONDS) -> Path:
    """Write recordings of two wheel paths at 16 kHz, each in files of its own."""
    for k in range(count):
        drive = folder / f"drive-{k:02d}"
        drive.mkdir(parents=True)
        write_document(drive)
        write_samples(drive, seconds)
    return folder


def scale(work: Path, count: int, jobs: Sequence[int] = (1, 2)) -> dict[str, Any]:
    """Return costs of long recordings, and the throughput by the number of workers.

    The numbers of workers take turns. The start-up is the wall time of the same command for one
    recording of two seconds; it counts in `wall_s` and is left out in `steady_s`.
    """
    tiny = write_drives(work / "tiny", 1, 2.0)
    drives = write_drives(work / "drives", count)
    walls: dict[int, list[float]] = {n: [] for n in jobs}
    starts: dict[int, list[float]] = {n: [] for n in jobs}
    peaks: list[int] = []
    costs: list[dict[str, float]] = []
    for turn in range(ROUNDS):
        for n in jobs:
            out = work / f"out-{turn}-{n}"
            starts[n].append(_run(tiny, work / f"start-{turn}-{n}", n, []))
            walls[n].append(_run(drives, out, n, peaks))
            costs += efforts(out) if n == jobs[0] else []
    return {
        "recordings": count,
        "recording_s": SECONDS,
        "rounds": ROUNDS,
        "workers": [_throughput(n, walls[n], starts[n], costs, count) for n in jobs],
        "peak_bytes": max(peaks),
        **_costs(costs),
    }


def by_pipeline(work: Path) -> dict[str, Any]:
    """Return what a km costs one worker, by pipeline."""
    drives, found = write_drives(work / "pipelines", FEW), {}
    for name in PIPELINES:
        peaks: list[int] = []
        out = work / f"out-{name}"
        _run(drives, out, 1, peaks, "--pipeline", name)
        costs = _costs(efforts(out))
        kept = ("cpu_s_per_km", "bytes_out_per_km")
        found[name] = {**{key: costs[key] for key in kept}, "largest_bytes": max(peaks)}
    return {"recordings": FEW, "recording_s": SECONDS, "of": found}


def _run(source: Path, out: Path, jobs: int, peaks: list[int], *more: str) -> float:
    run = batch([source, "--out", out, "--jobs", str(jobs), *more])
    if run.code:
        raise RuntimeError(f"exit {run.code}: {run.stderr}")
    peaks.extend(run.peaks.values())
    return run.seconds


def _throughput(
    n: int, walls: list[float], starts: list[float], costs: list[dict[str, float]], count: int
) -> dict[str, Any]:
    km = sum(cost["length_m"] for cost in costs) / len(costs) * count / 1000
    wall, start = statistics.median(walls), statistics.median(starts)
    steady = wall - start
    return {
        "workers": n,
        "wall_s": wall,
        "start_s": start,
        "steady_s": steady,
        "km_per_h": 3600 * km / wall,
        "steady_km_per_h": 3600 * km / steady,
    }


def _costs(costs: list[dict[str, float]]) -> dict[str, float]:
    km = sum(cost["length_m"] for cost in costs) / 1000
    total = {name: sum(cost[name] for cost in costs) for name in costs[0]}
    return {
        "km_per_file": km / len(costs),
        "bytes_in_per_km": total["bytes_in"] / km,
        "bytes_out_per_km": total["bytes_out"] / km,
        "cpu_s_per_km": total["cpu_s"] / km,
        "seconds_per_km": total["seconds"] / km,
        "recorded_peak_bytes": max(cost["peak_bytes"] for cost in costs),
    }


def overhead(work: Path) -> dict[str, float]:
    """Return what a task costs the scheduler and everyone, on loopback with two workers."""
    from distributed import Client, as_completed

    with cluster(2, work) as (address, _, scheduler), Client(address) as client:
        client.wait_for_workers(2)
        client.gather([client.submit(abs, k, pure=False) for k in range(100)])
        process = psutil.Process(scheduler)
        used, begin = _cpu_s(process), time.perf_counter()
        futures = [client.submit(abs, k, pure=False) for k in range(TASKS)]
        for future in as_completed(futures):
            future.release()
        wall, cpu = time.perf_counter() - begin, _cpu_s(process) - used
        resident = process.memory_info().rss
    return {
        "tasks": TASKS,
        "wall_s_per_task": wall / TASKS,
        "scheduler_cpu_s_per_task": cpu / TASKS,
        "scheduler_bytes": resident,
    }


def _cpu_s(process: psutil.Process) -> float:
    times = process.cpu_times()
    return float(times.user + times.system)


def machine() -> dict[str, Any]:
    """Return where and when this was measured, and what else the machine had to do."""
    import platform

    import distributed
    import numpy as np

    model = [
        line.partition(":")[2].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    return {
        "taken": time.strftime("%Y-%m-%d", time.gmtime()),
        "processor": model[0] if model else platform.processor(),
        "cores": os.cpu_count(),
        "load_before": round(os.getloadavg()[0], 2),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "dask": distributed.__version__,
    }
