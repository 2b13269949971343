"""Time the fixed zero-phase high-pass against scipy's `sosfilt` run twice, in one process.

Prints medians and the ratio; below 1 is faster than the peer. Run as
``python tests/benchmarks/bench_filters.py [points]``.
"""

import statistics
import sys
import time
from functools import partial

import numpy as np
import scipy.signal
from timing import in_turns

from floatref.measures.roughness.zero_phase import high_pass_b3x2

INTERVAL_M, WAVELENGTH_M = 0.00508, 105.91
timed = partial(in_turns, rounds=31, clock=time.perf_counter)


def sosfilt_twice(x: np.ndarray) -> np.ndarray:
    """Both passes of the third-order high-pass as second-order sections."""
    sos = scipy.signal.butter(3, 2.0 * INTERVAL_M / WAVELENGTH_M, "high", output="sos")
    return scipy.signal.sosfilt(sos, scipy.signal.sosfilt(sos, x)[::-1])[::-1]


def main(points: int) -> None:
    """Print both times and the median of the ratios, pair by pair."""
    x = np.random.default_rng(0).standard_normal(points).cumsum()
    ours, peer = timed(
        lambda: high_pass_b3x2(x, INTERVAL_M, WAVELENGTH_M), lambda: sosfilt_twice(x)
    )
    ratio = statistics.median(a / b for a, b in zip(ours, peer, strict=True))
    print(f"zero-phase high-pass, both passes, {points} points")
    print(f"  floatref   {statistics.median(ours) / points * 1e9:8.2f} ns/point")
    print(
        f"  sosfilt    {statistics.median(peer) / points * 1e9:8.2f} ns/point    ratio {ratio:.2f}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
