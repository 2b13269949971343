"""Clocks that the benchmarks share."""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import floatref
from floatref.files import write_recording

RATE_HZ, ROUNDS = 16_000, 9
RUN = "import sys; from floatref.cli.main import main; sys.exit(main())"


def in_turns(
    *calls: Callable[[], object],
    rounds: int = ROUNDS,
    clock: Callable[[], float] = time.process_time,
) -> list[list[float]]:
    """Seconds of every call by ``clock``, in turns after one warm-up."""
    for call in calls:
        call()
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(rounds):
        for call, taken in zip(calls, times, strict=True):
            begin = clock()
            call()
            taken.append(clock() - begin)
    return times


def ratio(times: list[float], peer: list[float]) -> float:
    """Median of the ratios of neighbours."""
    return statistics.median(a / b for a, b in zip(times, peer, strict=True))


def line(times: list[float], count: int) -> str:
    """Median as time per sample, and as a multiple of real time."""
    each = statistics.median(times) / count
    return f"{each * 1e9:6.1f} ns/sample {1 / RATE_HZ / each:6.0f} x real time"


def report_peer(
    name: str,
    samples: int,
    ours: Callable[[], object],
    peer: Callable[[], np.ndarray],
    expected: np.ndarray,
    rounds: int,
) -> None:
    """Print the time of ``peer``, how many times ours that is, and how far apart both are."""
    found: list[np.ndarray] = []
    mine, theirs = in_turns(
        lambda: [ours() for _ in range(3)], lambda: found.append(peer()), rounds=rounds
    )
    apart = np.nanmax(np.abs(found[-1] - expected))
    print(
        f"  {name:26} {statistics.median(theirs) / samples * 1e9:9.0f} ns/sample    "
        f"{3 * ratio(theirs, mine):6.0f} of ours, {apart:.1e} m apart",
        flush=True,
    )


def report_start(recording: floatref.Recording, pipeline: str) -> None:
    """Print how long the command takes with nothing compiled, and with all of it."""
    with tempfile.TemporaryDirectory(prefix="floatref-start-") as name:
        write_recording(recording, Path(name) / "run")
        command = ["process", f"{name}/run", "--out", f"{name}/profile", "--overwrite", "--json"]
        command += ["--pipeline", pipeline]
        environment = {**os.environ, "NUMBA_CACHE_DIR": f"{name}/cache"}
        taken = [seconds_of([sys.executable, "-c", RUN, *command], environment) for _ in range(6)]
    print(f"floatref {' '.join(command[-2:])}, {recording.channels[0].span_s[1]:.1f} s of driving")
    for state, runs in (("nothing compiled", taken[:1]), ("compiled", taken[1:])):
        wall, processor = (statistics.median(column) for column in zip(*runs, strict=True))
        print(f"  {state:26} {wall:6.2f} s, {processor:6.2f} s of the processor")


def seconds_of(
    command: list[str], environment: dict[str, str], codes: tuple[int, ...] = (0,)
) -> tuple[float, float]:
    """Run a process, which ends with one of ``codes``; return its wall and processor time in s."""
    begin = time.perf_counter()
    child = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if os.waitstatus_to_exitcode(status) not in codes:
        sys.exit(1)
    return time.perf_counter() - begin, used.ru_utime + used.ru_stime
