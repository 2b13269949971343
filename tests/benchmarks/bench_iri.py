"""Time the IRI of 100 km and the cross correlation against scipy, in one process.

Prints medians and ratios; below 1 is faster than the peer. Run as
``python tests/benchmarks/bench_iri.py [kilometres]``.
"""

import statistics
import sys
import time
from functools import partial

import numpy as np
import scipy.signal
from timing import in_turns

from floatref.measures import cross_correlation, iri
from floatref.measures.roughness.quarter_car import KMH

INTERVAL_M = 0.00508
timed = partial(in_turns, rounds=7, clock=time.perf_counter)


def road(points: int, seed: int) -> np.ndarray:
    """White-noise slope, about 2 m/km."""
    return np.cumsum(np.random.default_rng(seed).normal(0.0, 1e-4, points))


def lfilter_iri(z: np.ndarray, interval: float) -> float:
    """IRI by scipy: the moving average as one difference, the car as one call of lfilter."""
    n, start = round(0.25 / interval), round(11.0 / interval)
    slope = np.empty(z.size - 1)
    slope[: z.size - n] = (z[n:] - z[:-n]) / (n * interval)
    slope[z.size - n :] = (z[-1] - z[z.size - n : -1]) / (np.arange(n - 1, 0, -1) * interval)
    slope -= (z[start] - z[0]) / (start * interval)
    response = scipy.signal.lfilter(*car_polynomials(interval), slope)
    return 1000.0 * float(np.mean(np.abs(response)))


def car_polynomials(interval: float) -> tuple[np.ndarray, np.ndarray]:
    """The car at 80 km/h with its input held over each interval, as (b, a)."""
    k1, k2, c, mu = 653.0, 63.3, 6.0, 0.15
    system = np.array(
        [[0, 1, 0, 0], [-k2, -c, k2, c], [0, 0, 0, 1], [k2 / mu, c / mu, -(k1 + k2) / mu, -c / mu]]
    )
    held = (system, np.array([[0], [0], [0], [k1 / mu]]), np.array([[1.0, 0, -1, 0]]), [[0.0]])
    discrete = scipy.signal.cont2discrete(held, interval / (80 * KMH), method="zoh")
    b, a = scipy.signal.ss2tf(*discrete[:4])
    return b[0, 1:], a


def scipy_correlation(p: np.ndarray, q: np.ndarray, largest: int) -> float:
    """Best correlation by scipy's FFT method, mean and σ of the whole signals."""
    p, q = p - p.mean(), q - q.mean()
    full = scipy.signal.correlate(q, p, mode="full", method="fft")
    middle = full[p.size - 1 - largest : p.size + largest]
    return float(middle.max() / (p.size * p.std() * q.std()))


def main(kilometres: float) -> None:
    """Print one line for each comparison."""
    z = road(int(kilometres * 1000 / INTERVAL_M), seed=1)
    ours, peer = map(
        statistics.median, timed(lambda: iri(z, INTERVAL_M), lambda: lfilter_iri(z, INTERVAL_M))
    )
    print(f"IRI of {kilometres:g} km at {INTERVAL_M * 1000:g} mm ({z.size} points)")
    print(f"  value      {iri(z, INTERVAL_M):.9f} against {lfilter_iri(z, INTERVAL_M):.9f} m/km")
    print(f"  floatref   {ours / z.size * 1e9:8.2f} ns/point")
    print(f"  lfilter    {peer / z.size * 1e9:8.2f} ns/point    ratio {ours / peer:.2f}")
    for largest in (196, 1968):
        compare_correlations(largest)


def compare_correlations(largest: int) -> None:
    """Print the times of a cross correlation over ±``largest`` lags."""
    p, q = (np.diff(road(31_674, seed)) for seed in (2, 3))
    taken = timed(
        lambda: cross_correlation(p, q, INTERVAL_M, largest * INTERVAL_M),
        lambda: scipy_correlation(p, q, largest),
    )
    ours, peer = map(statistics.median, taken)
    print(f"cross correlation of {p.size} points over ±{largest} lags")
    print(f"  floatref   {ours * 1e3:8.2f} ms")
    print(f"  correlate  {peer * 1e3:8.2f} ms          ratio {ours / peer:.2f}")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 100.0)
