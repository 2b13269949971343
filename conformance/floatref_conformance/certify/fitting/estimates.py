"""Gain and lag of a run against the reference, from spectra of windows, and their scatter.

A run takes a wave of wave number k as h·exp(c·k² ∓ c²·k⁴/5) times the reference: h is the scale of
heights, the rest is what footprints do to the shorter waves, and nothing to the longest. It is
the beginning of ln(sin x / x), the gain of an average over a length. The run lies farther along
by a lag that is a straight line of distance.
"""

import math
from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.fitting.spectra import Spectra, Windows

BLOCKS = 12
"""Stretches of the section, each left out once to estimate the scatter."""
UNDERSTATED = 1.12
"""Factor by which the scatter of so few blocks, weighted by themselves, is too small."""
ROBUST = 2.0
"""A window counts less if its residual is larger than this many times the usual one."""
ITERATIONS = 8


@dataclass(frozen=True, eq=False)
class Estimate:
    """Estimates from the windows, each value with its 1-sigma.

    Attributes:
        height: h.
        smoothing_m2: c.
        shift_m, slope: lag at ``middle_m``, and per m.
        lags_m: of every window, shape (windows,).
            correlation: of the spectra, window by window, all waves together.
    """

    height: float
    height_sigma: float
    smoothing_m2: float
    smoothing_sigma: float
    shift_m: float
    shift_sigma: float
    slope: float
    slope_sigma: float
    middle_m: float
    lags_m: FloatArray
    correlation: float


def estimate(windows: Windows) -> Estimate:
    """Return gain and lag of a run that lies within a quarter of the shortest wave.

    Waves count by how little the run differs in them, windows less if they differ more than most.
    """
    p, q = windows.reference, windows.run
    squares = np.square(windows.wave_number)
    gain = np.array([0.5 * math.log(_energy(q) / _energy(p)), 0.0])
    weights = np.ones(windows.at_m.size)
    for _ in range(ITERATIONS):
        model = np.exp(gain[0] + _footprint(gain[1], squares)) * p
        rest = q - model
        noise = (
            weights @ np.square(np.abs(rest)) / weights.sum() + 1e-9 * np.square(np.abs(q)).mean()
        )
        weights = _weights(np.square(np.abs(rest)) @ (1.0 / noise))
        bent = squares * (1.0 + 0.4 * abs(gain[1]) * squares)
        normal = _normal(np.stack((model, bent * model)), rest, weights[:, None] / noise)
        gain = gain + normal.solution()
    lag = -2j * np.pi * windows.wave_number * model
    each = _normal(lag[None], rest, weights[:, None] / noise)
    return _summarise(windows, gain, normal, each, weights)


def _footprint(smoothing: float, squares: FloatArray) -> FloatArray:
    """Return the logarithm of the gain of an average over a length, or of its inverse."""
    bend = math.copysign(0.2 * smoothing**2, smoothing)
    return np.asarray(smoothing * squares + bend * np.square(squares))


@dataclass(frozen=True, eq=False)
class _Normal:
    """Normal equations of every window: shapes (windows, n, n) and (windows, n)."""

    matrix: FloatArray
    right: FloatArray

    def solution(self) -> FloatArray:
        """Return the solution of all windows together."""
        return np.asarray(np.linalg.solve(self.matrix.sum(axis=0), self.right.sum(axis=0)))

    def sigma(self) -> FloatArray:
        """Return the 1-sigma of the solution, by leaving out one block of windows after another."""
        count = min(BLOCKS, self.right.shape[0])
        blocks = np.array_split(np.arange(self.right.shape[0]), count)
        matrix, right = self.matrix.sum(axis=0), self.right.sum(axis=0)
        without = np.array(
            [
                np.linalg.solve(
                    matrix - self.matrix[b].sum(axis=0), right - self.right[b].sum(axis=0)
                )
                for b in blocks
            ]
        )
        spread = np.square(without - without.mean(axis=0)).sum(axis=0)
        return np.asarray(UNDERSTATED * np.sqrt((count - 1) / count * spread))


def _normal(columns: Spectra, rest: Spectra, weights: FloatArray) -> _Normal:
    """Return the normal equations of ``rest`` by ``columns``, shape (n, windows, waves)."""
    weighted = np.conj(columns) * weights
    matrix = np.einsum("iwk,jwk->wij", weighted, columns).real
    right = np.einsum("iwk,wk->wi", weighted, rest).real
    return _Normal(matrix, right)


def _line(at: FloatArray, each: _Normal) -> _Normal:
    """Return the normal equations of a straight line through the lags of the windows."""
    design = np.stack((np.ones(at.size), at), axis=1)
    matrix = each.matrix * design[:, :, None] * design[:, None, :]
    return _Normal(matrix, each.right * design)


def _weights(misfit: FloatArray) -> FloatArray:
    """Return the weights of windows by their misfit."""
    usual = ROBUST * float(np.median(misfit))
    return np.asarray(np.minimum(1.0, usual / np.maximum(misfit, 1e-300)))


def _energy(spectra: Spectra) -> float:
    """Return the usual energy of a window."""
    return max(float(np.median(np.square(np.abs(spectra)).sum(axis=1))), 1e-300)


def _summarise(
    windows: Windows, gain: FloatArray, normal: _Normal, each: _Normal, weights: FloatArray
) -> Estimate:
    """Return the estimate of the solved normal equations."""
    p, q = windows.reference, windows.run
    middle = float(windows.at_m.mean())
    line = _line(windows.at_m - middle, each)
    (shift, slope), (shift_sigma, slope_sigma) = line.solution(), line.sigma()
    height = math.exp(gain[0])
    gain_sigma = normal.sigma()
    products = float((weights @ (np.conj(p) * q).real).sum())
    energies = [float((weights @ np.square(np.abs(v))).sum()) for v in (p, q)]
    return Estimate(
        height=height,
        height_sigma=height * float(gain_sigma[0]),
        smoothing_m2=float(gain[1]),
        smoothing_sigma=float(gain_sigma[1]),
        shift_m=float(shift),
        shift_sigma=float(shift_sigma),
        slope=float(slope),
        slope_sigma=float(slope_sigma),
        middle_m=middle,
        lags_m=each.right[:, 0] / each.matrix[:, 0, 0],
        correlation=products / math.sqrt(energies[0] * energies[1]),
    )


def long_gain(windows: Windows) -> tuple[float, float]:
    """Return the gain of all waves of ``windows`` alike, and its 1-sigma."""
    p, q = windows.reference, windows.run
    normal = _normal(p[None], q, np.ones(p.shape))
    return float(normal.solution()[0]), float(normal.sigma()[0])
