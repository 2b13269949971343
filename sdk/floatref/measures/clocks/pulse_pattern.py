"""How well the pulses around one pulse fit the other train, and how probable that is by chance."""

from typing import NamedTuple

import numpy as np

from floatref.values.arrays import BoolArray, FloatArray, IndexArray

FASTEST_DRIFT = 3e-4
"""Largest drift between two clocks, as a ratio; 200 ppm and a margin."""
FINE = 0.1
"""Error of the pulses of a good recorder, as a share of the largest one."""
NEIGHBOURS = 24
"""Number of pulses on either side that make the pattern of one."""
HELD = 1 << 20
"""Differences calculated together."""


class Fits(NamedTuple):
    """How well one pulse of the own train and each of the base train are the same.

    Attributes:
        share: of the pulses around it that fit, shape (m,).
        evidence: minus the logarithm of how probable that is by chance, shape (m,).
    """

    share: FloatArray
    evidence: FloatArray

    def share_beyond(self, needed: float) -> FloatArray:
        """Return the share where there is the evidence that is ``needed``, else -1."""
        return np.where(self.evidence >= needed, self.share, -1.0)


def fit_pattern(own: FloatArray, base: FloatArray, anchor: int, jitter: float) -> Fits:
    """Return how the pulses around ``anchor`` fit if it is each pulse of ``base``.

    Evidence counts those that lie in the time of both trains, however few. If m are expected to
    fit by chance, k or more do with a probability of exp(m - k) (m / k)^k at most (Chernoff's bound
    for Poisson's distribution), with errors up to ``jitter`` or up to a small part of it. So trains
    that repeat are no evidence, though all their pulses fit.
    """
    around = own[max(anchor - NEIGHBOURS, 0) : anchor + NEIGHBOURS + 1] - own[anchor]
    others = around[around != 0.0]
    drifts = FASTEST_DRIFT * np.abs(others)
    rate = base.size / max(float(base[-1] - base[0]), 2.0 * jitter)
    share, evidence = np.zeros((2, base.size))
    step = max(1, HELD // around.size)
    for first in range(0, base.size, step):
        part = slice(first, first + step)
        off, inside = _off(base, base[part, None] + others)
        for most in (FINE * jitter + drifts, jitter + drifts):
            fits = off <= most
            chance = _chance(fits, fits | inside, np.minimum(2.0 * rate * most, 1.0))
            count = fits.sum(axis=1)
            evidence[part] = np.maximum(evidence[part], _surprise(count, chance))
            share[part] = (count + 1) / around.size
    return Fits(share, evidence)


def _off(base: FloatArray, expected: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return how far each time is from the nearest pulse in s, and whether it is among them."""
    after = np.searchsorted(base, expected).clip(1, max(base.size - 1, 1))
    off = np.abs(base[after.clip(max=base.size - 1)] - expected)
    inside = np.asarray((expected >= base[0]) & (expected <= base[-1]))
    return np.minimum(off, np.abs(base[after - 1] - expected)), inside


def _chance(fits: BoolArray, there: BoolArray, least: FloatArray) -> FloatArray:
    """Return how many pulses are expected to fit at each place: as often as they do elsewhere.

    Of those that are ``there``, and no less than the ``least`` of pulses at any times.
    """
    elsewhere = np.maximum(there.sum(axis=0) - there, 1)
    often = np.maximum((fits.sum(axis=0) - fits) / elsewhere, least)
    return np.asarray(np.sum(often, axis=1, where=there))


def _surprise(fits: IndexArray, chance: FloatArray) -> FloatArray:
    """Return k log(k / m) - k + m of k ``fits`` where m come by ``chance``; zero unless k > m."""
    known = np.maximum(chance, 1e-300)
    least = np.maximum(fits, known)
    return np.asarray(least * np.log(least / known) - least + known)
