"""Time the zero-phase high-pass at a cut-off that follows the speed against a fixed peer.

Ours goes from the speed at every sample to the filtered signal: (5.3), tan, and both passes of
the third-order stages. The peer is `scipy.signal.sosfiltfilt` at a fixed cut-off. Prints medians
and the ratio; below 1 is faster than the peer. Run as
``python tests/benchmarks/bench_varying.py [samples]``.
"""

import statistics
import sys
import time
from collections.abc import Callable

import numpy as np
import scipy.signal

from floatref.kernels.adaptive import adaptive_high_pass

RATE_HZ, CUTOFF_HZ = 16_000.0, 0.05
ROUNDS = 15


def drive(samples: int) -> np.ndarray:
    """Speed in m/s of a vehicle that slows down from 20 m/s to a stop and starts again."""
    times = np.arange(samples) / RATE_HZ
    return np.clip(10.0 + 12.0 * np.cos(0.1 * times), 0.0, 20.0)


def in_turns(*calls: Callable[[], object]) -> list[list[float]]:
    """Seconds of every call, taken in turns after one warm-up."""
    for call in calls:
        call()
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(ROUNDS):
        for call, taken in zip(calls, times, strict=True):
            begin = time.perf_counter()
            call()
            taken.append(time.perf_counter() - begin)
    return times


def main(samples: int) -> None:
    """Print both times and the median of the ratios, pair by pair."""
    speed = drive(samples)
    x = 1e-3 * np.random.default_rng(0).standard_normal(samples).cumsum()
    sos = scipy.signal.butter(3, CUTOFF_HZ, "high", output="sos", fs=RATE_HZ)
    ours, peer = in_turns(
        lambda: adaptive_high_pass(x, speed, 1.0 / RATE_HZ),
        lambda: scipy.signal.sosfiltfilt(sos, x),
    )
    ratio = statistics.median(a / b for a, b in zip(ours, peer, strict=True))
    print(f"zero-phase high-pass, cut-off from the speed, both passes, {samples} samples")
    print(f"  floatref              {statistics.median(ours) / samples * 1e9:7.2f} ns/sample")
    print(
        f"  sosfiltfilt, fixed    {statistics.median(peer) / samples * 1e9:7.2f} ns/sample"
        f"    ratio {ratio:.2f}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 2_000_000)
