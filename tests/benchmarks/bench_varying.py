"""Time the zero-phase high-pass at a cut-off that follows the speed against a fixed peer.

Ours goes from the speed at every sample to the filtered signal: (5.3), tan, and both passes of
the third-order stages, once on whole arrays and once as the stages of a pipeline, block by block.
The peer is `scipy.signal.sosfiltfilt` at a fixed cut-off. Prints medians and ratios; below 1 is
faster than the peer. Run as
``python tests/benchmarks/bench_varying.py [samples]``.
"""

import statistics
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from functools import partial

import numpy as np
import scipy.signal
from timing import in_turns

from floatref.intake.blocks import BLOCK
from floatref.kernels.memories import VARYING
from floatref.kernels.schedule import frequencies, tangents
from floatref.kernels.varying import high_pass_12, high_pass_21
from floatref.stages.filters.schedule import ScheduleCutOff
from floatref.stages.filters.varying import VaryingHighPassB3, VaryingHighPassB3R
from floatref.values.arrays import new_record
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

ELEVATION, SPEED = ChannelId("elevation", "main"), ChannelId("travel_speed")
RATE_HZ, CUTOFF_HZ = 16_000.0, 0.05
timed = partial(in_turns, rounds=15, clock=time.perf_counter)
PIECE = 16_384
"""Samples taken together, so that what lies between two loops stays in the cache."""
CONSTANTS = 0.45, 105.91, 2.778, 2.5
"""Of (5.3)."""


def drive(samples: int) -> np.ndarray:
    """Speed in m/s of a vehicle that slows down from 20 m/s to a stop and starts again."""
    times = np.arange(samples) / RATE_HZ
    return np.clip(10.0 + 12.0 * np.cos(0.1 * times), 0.0, 20.0)


def on_arrays(x: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Return ``x`` after both passes: what the filter costs without blocks, flags and states."""
    y, c, cutoff = np.empty(x.size), np.empty(x.size), np.empty(PIECE)
    first, second = new_record(VARYING), new_record(VARYING)
    pieces = [slice(at, at + PIECE) for at in range(0, x.size, PIECE)]
    for part in pieces:
        frequencies(speed[part], cutoff, *CONSTANTS)
        tangents(cutoff[: c[part].size], 1.0 / RATE_HZ, c[part])
        high_pass_12(x[part], y[part], c[part], first, second, False)
    first, second = new_record(VARYING), new_record(VARYING)
    for part in reversed(pieces):
        high_pass_21(y[part], y[part], c[part], second, first, True)
    return y


def staged(x: np.ndarray, speed: np.ndarray) -> None:
    """Pass ``x`` through the stages of both passes, forward and then from the last block."""
    channels = frozenset({ELEVATION, SPEED})
    header = Header(Axis.TIME, 1.0 / RATE_HZ, 0.0, Fraction(RATE_HZ), channels, ("main",))
    stages = ScheduleCutOff(), VaryingHighPassB3("elevation"), VaryingHighPassB3R("elevation")
    for stage in stages:
        header = stage.start(header)
    schedule, forward, backward = stages
    parts = [slice(at, at + BLOCK) for at in range(0, x.size, BLOCK)]
    blocks = [Block(part.start, {ELEVATION: x[part], SPEED: speed[part]}) for part in parts]
    there = [forward.push(schedule.push(block)) for block in blocks]
    while there:
        backward.push(there.pop())


def main(samples: int) -> None:
    """Report what the filter costs on arrays, and in the stages of a pipeline."""
    speed = drive(samples)
    x = 1e-3 * np.random.default_rng(0).standard_normal(samples).cumsum()
    sos = scipy.signal.butter(3, CUTOFF_HZ, "high", output="sos", fs=RATE_HZ)
    print(f"zero-phase high-pass, cut-off from the speed, both passes, {samples} samples")
    report("on arrays", lambda: on_arrays(x, speed), sos, x)
    report("as stages", lambda: staged(x, speed), sos, x)


def report(name: str, ours: Callable[[], object], sos: np.ndarray, x: np.ndarray) -> None:
    """Print ours beside the peer and the median of their ratios."""
    times, peer = timed(ours, lambda: scipy.signal.sosfiltfilt(sos, x))
    ratio = statistics.median(a / b for a, b in zip(times, peer, strict=True))
    print(
        f"  {name}  floatref {statistics.median(times) / x.size * 1e9:6.2f} ns/sample"
        f"    sosfiltfilt, fixed {statistics.median(peer) / x.size * 1e9:6.2f} ns/sample"
        f"    ratio {ratio:.2f}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2_000_000)
