"""Time the road-prior smoother as a stage and as a pipeline, beside two peers.

One wheel path at 16 kHz, whose blocks are ready before the clock of the stage starts. The peers
filter four seconds of a stop at every sample: the literal smoother of `floatref_reference`, and
filterpy if ``pip install -r tests/benchmarks/requirements-kalman.txt`` has installed it. Times
are of the processor, in turns, so that other work on the machine counts little. Prints medians and
ratios, where the time of the stage goes, and how long whole processes take to start. Run as
``python tests/benchmarks/bench_road_prior.py [metres of constant speed]``; memory is measured by
``python tests/benchmarks/bench_kalman_memory.py --pipeline road-prior-smoother``.
"""

import importlib.util
import sys
import time
from collections import Counter
from pathlib import Path
from unittest import mock

import numpy as np
import road_prior_peers as peers
from bench_levelled_stops import UNLEVELLED, add_plugin
from kalman_task import TRACK, Prepared
from kind_drives import KIND
from timing import RATE_HZ, in_turns, line, ratio, report_peer, report_start

import floatref
from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.kernels.compiling import Kernel
from floatref.stages.signals import REFERENCE_HEIGHT
from floatref.values.channels import ChannelId
from floatref_conformance.proving_ground.scenario import Scenario, scenario_of_run
from floatref_conformance.proving_ground.simulate import simulate

PIPELINE = "road-prior-smoother"
LEAST_REAL_TIME = 300
SHORT = Scenario(
    manoeuvre="stop",
    speed_kmh=12.0,
    final_speed_kmh=12.0,
    event_at_m=4.0,
    dwell_s=1.0,
    length_m=10.0,
    tracks=(TRACK,),
    imu=False,
    gnss=False,
    **KIND,
)
"""Its first four seconds are what the peers filter."""
PARTS = {
    "forward.py": "filter forward",
    "backward.py:smooth": "smoother backward",
    "backward.py:correct": "smoother backward",
    "backward.py:closed_loop": "1-sigma, lag",
    "covariance.py": "1-sigma, lag",
    "excitation.py": "longitudinal acceleration",
}
"""Files of kernels, and kernels, by what they are for."""


def report_stage(name: str, recording: floatref.Recording) -> None:
    """Print the stage beside the whole pipeline, and what part of it takes how long."""
    prepared = Prepared.of(recording, more=())
    stage, whole = in_turns(
        lambda: prepared.through(RoadPriorSmoother()),
        lambda: floatref.process(recording, PIPELINE),
    )
    count = prepared.samples
    print(f"{name}, {count / RATE_HZ:.1f} s at {RATE_HZ / 1000:g} kHz, one wheel path")
    print(f"  {'stage':26} {line(stage, count)}")
    print(f"  {PIPELINE:26} {line(whole, count)}   (at least {LEAST_REAL_TIME})")
    print(f"  {'stage, share of that':26} {ratio(stage, whole):6.2f}")
    for part, share in parts(prepared).most_common():
        print(f"    {part:28} {100.0 * share:4.0f} % of the stage")
    sys.stdout.flush()


def parts(prepared: Prepared) -> Counter[str]:
    """Return what share of the stage's time each of `PARTS` takes, and the rest."""
    found: Counter[str] = Counter()
    call = Kernel.__call__

    def timed(kernel: Kernel[..., object], *given: object) -> object:
        begin = time.perf_counter()
        made = call(kernel, *given)
        found[part_of(kernel)] += time.perf_counter() - begin
        return made

    with mock.patch.object(Kernel, "__call__", timed):
        begin = time.perf_counter()
        prepared.through(RoadPriorSmoother())
        whole = time.perf_counter() - begin
    found["Python and numpy"] = whole - found.total()
    return Counter({part: own / whole for part, own in found.items()})


def part_of(kernel: Kernel[..., object]) -> str:
    """Return what a kernel is for."""
    code = kernel.py_func.__code__
    file = Path(code.co_filename).name
    return PARTS.get(f"{file}:{code.co_name}", PARTS.get(file, "other kernels"))


def report_peers() -> None:
    """Print the stage beside its peers on four seconds of a stop."""
    full = Prepared.of(simulate(SHORT).recording, more=())
    short = Prepared(full.header, full.blocks[:1])
    prior = RoadPrior()
    run, c = peers.signals(short.header, short.blocks[0], prior), peers.constants(prior)
    blocks = short.through(RoadPriorSmoother(prior, tolerance_m=0.0))
    ours = np.concatenate([block[ChannelId(REFERENCE_HEIGHT, TRACK)] for block in blocks])
    ours -= short.blocks[0][ChannelId("height", TRACK)][0]
    print(f"at every sample, {short.samples / RATE_HZ:.1f} s of a stop, six states")
    found = {"literal reference": lambda: peers.by_reference(run, c)}
    if importlib.util.find_spec("filterpy"):
        steps = peers.Steps.of(run, c)
        found["filterpy"] = lambda: peers.by_filterpy(steps)
    for name, peer in found.items():
        report_peer(
            name, short.samples, lambda: short.through(RoadPriorSmoother()), peer, ours, rounds=3
        )


def report_levelling(drive: Scenario) -> None:
    """Print what levelling takes of a pipeline where there is a stop in each kilometre."""
    recording = simulate(drive).recording
    add_plugin()
    whole, without = in_turns(
        lambda: floatref.process(recording, PIPELINE),
        lambda: floatref.process(recording, UNLEVELLED),
    )
    count = recording.channel("vertical_specific_force", TRACK).values.size
    levelling = [one - other for one, other in zip(whole, without, strict=True)]
    print(f"{drive.stops} stops, one in each kilometre, {count / RATE_HZ:.1f} s")
    for name, times in ((PIPELINE, whole), (UNLEVELLED, without), ("levelling", levelling)):
        print(f"  {name:26} {line(times, count)}")
    print(f"  {'levelling of one stop':26} {1e3 * np.median(levelling) / drive.stops:6.0f} ms")
    sys.stdout.flush()


def main(length_m: float) -> None:
    """Report on a drive at constant speed, and on one with a stop."""
    nominal = {"tracks": (TRACK,), "imu": False, "gnss": False, **KIND}
    constant = Scenario(speed_kmh=72.0, length_m=length_m, **nominal)
    stop = scenario_of_run("sg_10.7s_0.20g", **nominal)
    for name, scenario in (("72 km/h", constant), ("stop", stop)):
        report_stage(name, simulate(scenario).recording)
    often = {"stops": 3, "stop_spacing_m": 1000.0, "event_at_m": 500.0, "length_m": 3000.0}
    report_levelling(
        Scenario(manoeuvre="stop", speed_kmh=72.0, final_speed_kmh=58.0, **often, **nominal)
    )
    report_peers()
    report_start(simulate(Scenario(length_m=100.0, **nominal)).recording, PIPELINE)


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 3000.0)
