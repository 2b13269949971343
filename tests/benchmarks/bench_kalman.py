"""Time the Kalman smoother of chapter 6 as a stage, beside C and other packages.

One wheel path at 16 kHz, whose blocks are ready before the clock starts. `kalman_c` is the same
design in C, built here by ``cc -O3``; filterpy and a scan in JAX filter a few seconds
at every sample, if ``pip install -r tests/benchmarks/requirements-kalman.txt`` has installed them.
Times are of the processor, in turns, so that other work on the machine counts little. Prints
medians and ratios, then how long whole processes take to start. Run as
``python tests/benchmarks/bench_kalman.py [metres of constant speed]``.
"""

import ctypes
import importlib.util
import os
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")

import kalman_peers as peers
import numpy as np
from kalman_task import TRACK, Prepared, Task
from kind_drives import KIND
from timing import RATE_HZ, in_turns, line, ratio, report_peer, report_start

import floatref
from floatref.estimators.kalman import Noise, Plan
from floatref.estimators.models.kalman_values import FORGET
from floatref_conformance.proving_ground.scenario import Scenario, scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate

PLANS = {"kalman-smoother": Plan(reflects=False), "kalman-smoother-reflection": Plan()}
WHOLE = "kalman-smoother-reflection"
SOURCES = Path(__file__).with_name("kalman_c")
SEVEN_STATES = Noise(gnss_height_walk=0.0, lean_rad=0.0)
"""The drift of the GNSS height and the lean are nothing: the model of appendix C is left."""
PEER_BLOCKS = 2
CUTOFF_M = 105.91


class Observations(ctypes.Structure):
    _fields_ = (
        ("count", ctypes.c_int64),
        *((name, ctypes.c_void_p) for name in ("at", "marks", "rows")),
    )


class InC:
    """The smoother of `kalman_c` on a task."""

    def __init__(self, folder: Path, task: Task) -> None:
        """Build the library in ``folder``, unless it is there, and lay out the arguments."""
        library = folder / "kalman.so"
        if not library.exists():
            command = ["cc", "-O3", "-fPIC", "-shared", "-o", library]
            subprocess.run([*command, *SOURCES.glob("*.c"), "-lm"], check=True)
        self.call = ctypes.CDLL(str(library)).kalman_smoother
        self.call.restype = ctypes.c_int64
        self.task, (self.height, self.sigma) = task, np.empty((2, task.height.size))
        rest = task.sub_block, CUTOFF_M, Noise().height_m
        self.model = np.concatenate((task.model, task.x, task.variance, rest))
        self.u = (ctypes.c_void_p * 7)(*(a.ctypes.data for a in (*task.u, task.distance)))
        arrays = (a.ctypes.data for a in (task.at, task.marks, task.rows))
        self.seen = Observations(task.at.size, *arrays)

    def __call__(self) -> None:
        """Smooth."""
        size, model = ctypes.c_int64(self.height.size), ctypes.c_void_p(self.model.ctypes.data)
        out = (ctypes.c_void_p(values.ctypes.data) for values in (self.height, self.sigma))
        if self.call(model, size, self.u, ctypes.byref(self.seen), *out) < 0:
            raise MemoryError


def report_stage(folder: Path, name: str, prepared: Prepared) -> None:
    """Print the stage beside C, by every plan."""
    count = prepared.samples
    print(f"{name}, {count / RATE_HZ:.1f} s at {RATE_HZ / 1000:g} kHz, one wheel path")
    for pipeline, plan in PLANS.items():
        task = Task(prepared, plan, Noise())
        in_c = InC(folder, task)
        stage, peer = in_turns(lambda plan=plan: prepared.smoothed(plan, Noise()), in_c)
        apart = np.abs(in_c.height - task.height).max()
        sure = np.abs(in_c.sigma / task.sigma - 1.0).max()
        print(f"  {pipeline}, C {line(peer, count)}, {apart:.1e} m apart, sigma {sure:.1e}")
        print(
            f"    {'stage':24} {line(stage, count)}    ratio {ratio(stage, peer):5.2f}", flush=True
        )


def report_peers(prepared: Prepared) -> None:
    """Print the stage beside the packages on the first blocks of a drive."""
    short = Prepared(prepared.header, prepared.blocks[:PEER_BLOCKS])
    task = Task(short, PLANS["kalman-smoother"], SEVEN_STATES)
    seen = ~np.isnan(task.rows[:, 0])
    if (task.marks[seen] & ~FORGET).any():
        raise ValueError("the peers know GNSS readings alone")
    model, at, rows = task.model, task.at[seen], task.rows[seen, :8]
    inputs = np.array(task.u)
    inputs[2] += model[1]
    arm, process, states = model[2:5], model[5:12], peers.STATES
    start, variance = task.x[:states], task.variance[:states]
    problem = peers.Problem(model[0], model[1], arm, process, start, variance, inputs, at, rows)
    print(f"at every sample, {short.samples / RATE_HZ:.1f} s, seven states, GNSS at 20 Hz")

    def ours() -> object:
        return short.smoothed(PLANS["kalman-smoother"], SEVEN_STATES)

    # The first sample of a peer is where it starts.
    expected = np.append(np.nan, task.height[1:])
    if importlib.util.find_spec("filterpy"):
        by_filterpy = partial(peers.by_filterpy, problem)
        report_peer("filterpy", short.samples, ours, by_filterpy, expected, rounds=1)
    if importlib.util.find_spec("jax"):
        report_peer("JAX scan", short.samples, ours, peers.by_jax(problem), expected, rounds=5)


def main(length_m: float) -> None:
    """Report on a drive at constant speed, and on one with a stop."""
    constant = Scenario(speed_kmh=72.0, length_m=length_m, tracks=(TRACK,), **KIND)
    stop = scenario_of_run("sg_10.7s_0.20g", tracks=(TRACK,), **KIND)
    drives = {name: simulate(s).recording for name, s in (("72 km/h", constant), ("stop", stop))}
    with tempfile.TemporaryDirectory(prefix="floatref-kalman-") as folder:
        for name, recording in drives.items():
            prepared = Prepared.of(recording)
            report_stage(Path(folder), name, prepared)
            (whole,) = in_turns(lambda r=recording: floatref.process(r, WHOLE))
            print(f"  whole {line(whole, prepared.samples)}    {WHOLE}, in memory", flush=True)
    report_peers(Prepared.of(drives["72 km/h"]))
    short = simulate(Scenario(length_m=100.0, tracks=(TRACK,), **KIND)).recording
    report_start(short, WHOLE)


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 3000.0)
