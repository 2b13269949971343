"""The random parts of a sensor's error, each drawn from its channel's own stream."""

from zlib import crc32

import numpy as np

from floatref.values.arrays import FloatArray

WALK_STEP_S = 0.01
"""A random walk is held for this long, in s; its steps there are far below any resolution."""


def stream(seed: int, channel: str) -> np.random.Generator:
    """Return the generator of one channel: the same for the same seed, whatever else is drawn."""
    name = crc32(channel.encode())
    return np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(name,))))


def draw_value(rng: np.random.Generator, nominal: float) -> float:
    """Return 0.5 to 1.5 times ``nominal``, of either sign: never so small that it vanishes."""
    return float(nominal * rng.uniform(0.5, 1.5) * rng.choice((-1.0, 1.0)))


def white(rng: np.random.Generator, density: float, rate_hz: float, count: int) -> FloatArray:
    """Return white noise of a two-sided ``density`` per √Hz sampled at ``rate_hz``."""
    if density == 0.0:
        return np.zeros(count)
    noise = rng.standard_normal(count)
    noise *= density * rate_hz**0.5
    return noise


def random_walk(rng: np.random.Generator, density: float, rate_hz: float, count: int) -> FloatArray:
    """Return a walk from 0 that spreads by ``density`` per √s, held for `WALK_STEP_S`."""
    if density == 0.0:
        return np.zeros(count)
    held = max(1, round(WALK_STEP_S * rate_hz))
    steps = rng.standard_normal(-(-count // held)) * density * (held / rate_hz) ** 0.5
    steps[0] = 0.0
    return np.repeat(np.cumsum(steps), held)[:count]


def gauss_markov(
    rng: np.random.Generator, sigma: float, time_constant_s: float, times_s: FloatArray
) -> FloatArray:
    """Return a first-order Gauss-Markov process of standard deviation ``sigma``, shape (n,)."""
    drift = sigma * rng.standard_normal(times_s.size)
    keep = np.exp(-np.diff(times_s) / time_constant_s)
    for k, factor in enumerate(keep, start=1):
        drift[k] = factor * drift[k - 1] + np.sqrt(1 - factor**2) * drift[k]
    return drift


def quantize(values: FloatArray, step: float) -> FloatArray:
    """Round ``values`` to multiples of ``step``, in place; a step of 0 leaves them."""
    if step > 0:
        values /= step
        np.rint(values, out=values)
        values *= step
    return values
