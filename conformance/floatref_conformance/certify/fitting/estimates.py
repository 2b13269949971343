"""Lag and gain of a run against the reference, from spectra of windows, errors in both.

The run lies farther along by a lag that is a straight line of distance. Its gain is that of
`symmetric`. Whatever is computed of both changes its sign, or becomes its inverse, if run and
reference change places.
"""

import math
from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.fitting.spectra import Spectra, Windows
from floatref_conformance.certify.fitting.symmetric import (
    SymmetricGain,
    bands_of,
    find_division,
    fit_bands,
    footprint,
)

BLOCKS = 12
"""Stretches of the section, each left out once to estimate the scatter of the lag."""
UNDERSTATED = 1.12
"""Factor by which the scatter of so few blocks, weighted by themselves, is too small."""
ROBUST = 2.0
"""A window counts less if its residual is larger than this many times the usual one."""
ITERATIONS = 4


@dataclass(frozen=True, eq=False)
class Estimate:
    """Estimates from the windows, each value with its 1-sigma.

    Attributes:
        gain: of all waves, see `SymmetricGain`.
        incoherent: what is not common to both, the mean of its bands, see `Bands`.
        division, division_sigma: see `find_division`.
        shift_m, slope: lag at ``middle_m``, and per m.
        lags_m: of every window, shape (windows,).
        correlation: of the spectra, window by window, all waves together.
    """

    gain: SymmetricGain
    incoherent: float
    division: float
    division_sigma: float
    shift_m: float
    shift_sigma: float
    slope: float
    slope_sigma: float
    middle_m: float
    lags_m: FloatArray
    correlation: float


def estimate(windows: Windows) -> Estimate:
    """Return gain and lag of a run that lies within a quarter of the shortest wave.

    Waves count by how little the two differ in them, windows less if they differ more than most.
    """
    p, q = windows.reference, windows.run
    weights = np.ones(windows.at_m.size)
    for _ in range(ITERATIONS):
        gain = fit_bands(bands_of(windows, weights))
        squares = np.square(windows.wave_number)
        half = np.exp(0.5 * (gain.log_height + footprint(gain.smoothing_m2, squares)))
        rest = np.square(np.abs(q / half - p * half))
        noise = weights @ rest / weights.sum() + 1e-9 * np.abs(p * q).mean()
        weights = _weights(rest @ (1.0 / noise))
    return _summarise(windows, gain, _lags(windows, weights[:, None] / noise), weights)


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


def _lags(windows: Windows, weights: FloatArray) -> _Normal:
    """Return the normal equations of the lag of every window; its waves count by ``weights``.

    A lag d turns a wave by 2πkd. The geometric mean of both stands for its size, so that neither
    is taken as free of errors.
    """
    p, q = windows.reference, windows.run
    turns = 2.0 * np.pi * windows.wave_number
    matrix = (weights * np.square(turns) * np.abs(p * q)).sum(axis=1)
    right = -(weights * turns * (np.conj(p) * q).imag).sum(axis=1)
    return _Normal(matrix[:, None, None], right[:, None])


def _line(at: FloatArray, each: _Normal) -> _Normal:
    """Return the normal equations of a straight line through the lags of the windows."""
    design = np.stack((np.ones(at.size), at), axis=1)
    matrix = each.matrix * design[:, :, None] * design[:, None, :]
    return _Normal(matrix, each.right * design)


def _weights(misfit: FloatArray) -> FloatArray:
    """Return the weights of windows by their misfit."""
    usual = ROBUST * float(np.median(misfit))
    return np.asarray(np.minimum(1.0, usual / np.maximum(misfit, 1e-300)))


def _summarise(
    windows: Windows, gain: SymmetricGain, each: _Normal, weights: FloatArray
) -> Estimate:
    """Return the estimate of the solved normal equations."""
    middle = float(windows.at_m.mean())
    bands = bands_of(windows, weights)
    division, division_sigma = find_division(bands)
    line = _line(windows.at_m - middle, each)
    (shift, slope), (shift_sigma, slope_sigma) = line.solution(), line.sigma()
    return Estimate(
        gain=gain,
        incoherent=bands.mean_incoherent,
        division=division,
        division_sigma=division_sigma,
        shift_m=float(shift),
        shift_sigma=float(shift_sigma),
        slope=float(slope),
        slope_sigma=float(slope_sigma),
        middle_m=middle,
        lags_m=each.right[:, 0] / each.matrix[:, 0, 0],
        correlation=_correlation(windows.reference, windows.run, weights),
    )


def _correlation(p: Spectra, q: Spectra, weights: FloatArray) -> float:
    """Return the correlation of all windows together."""
    products = float((weights @ (np.conj(p) * q).real).sum())
    energies = [float((weights @ np.square(np.abs(v))).sum()) for v in (p, q)]
    return products / math.sqrt(energies[0] * energies[1])
