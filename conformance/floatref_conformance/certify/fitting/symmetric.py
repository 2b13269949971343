"""Gain of a run against the reference with errors in both, from their energies and coherence.

Least squares takes the reference as free of errors: what the reference alone contains, another
line on the road for one, makes every gain too low. Here both are treated alike. In a band of waves
the gain is half the logarithm of the ratio of energies, $y = ½ ln(S_q / S_p)$, which changes its
sign if run and reference change places. The coherence $γ² = |S_pq|² / (S_p S_q)$ of n independent
waves gives its variance, $(1 - γ²) / (2 n)$.

Two lines on a road have the same energy and share the long waves: they lose coherence with the wave
number, and no gain. What is not common even in the longest waves is noise of an instrument. If all
of it is in the run, the gain is $u = -½ ln γ²$ too high, if it is in the reference as much too low
(the bounds of Frisch, 1934). How it divides is not known: it is uniform in between, of variance
$u²/3$.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.fitting.spectra import Spectra, Windows

BAND = 2.0 ** (1.0 / 3.0)
"""Ratio of the limits of a band, a third of an octave."""
LEAST_BANDS = 3
"""With fewer bands, all waves share one gain."""
LEAST_WAVES = 8.0
"""Independent waves that a band holds at least; narrower ones are joined."""
INDEPENDENT = 0.49
"""Independent waves in one number of one of Hann's windows that lie half over each other."""
BESIDE = 4.0 / 9.0, 1.0 / 36.0
"""Squared correlation of neighbouring numbers of such a window, and of those next to them."""
FLOOR = 1e-4
"""Error of a gain that no coherence undercuts: rounding, and points between points."""
DIVISION_VARIANCE = 1.0 / 3.0
CERTAIN = 3.0
"""A footprint counts beyond this number of sigma: what the bands do not show is not estimated."""
ITERATIONS = 4


@dataclass(frozen=True, eq=False)
class Bands:
    """Waves in bands, shape (bands,).

    Attributes:
        wave_number: in cycles per m, the mean of the band's.
        gain: half the logarithm of the ratio of energies, run over reference.
        phase: of the cross spectrum, in rad; above zero where the run is ahead.
        incoherent: half the logarithm of 1 / γ².
        sigma: 1-sigma of ``gain``; that of ``phase`` is larger by 1 / γ.
    """

    wave_number: FloatArray
    gain: FloatArray
    phase: FloatArray
    incoherent: FloatArray
    sigma: FloatArray

    @property
    def phase_sigma(self) -> FloatArray:
        """1-sigma of ``phase`` in rad."""
        return np.asarray(self.sigma * np.exp(self.incoherent))

    @property
    def mean_incoherent(self) -> float:
        """Mean of ``incoherent``, in which bands count as they do for the gain."""
        weights = 1.0 / np.square(self.sigma)
        return float(weights @ self.incoherent / weights.sum())


@dataclass(frozen=True)
class SymmetricGain:
    """The gain that all bands share, and what it is not.

    Attributes:
        log_height, log_sigma: logarithm of the scale of heights, and its 1-sigma, noise apart.
        smoothing_m2, smoothing_sigma: of the footprint, see `footprint`; 0 if it is not certain.
    """

    log_height: float
    log_sigma: float
    smoothing_m2: float
    smoothing_sigma: float

    def with_noise(self, longest: Bands, most: float) -> "SymmetricGain":
        """Return it with the sigma of how the noise that ``longest`` show divides.

        There is not more noise than ``most``, what is not common to all other waves.
        """
        noise = min(longest.mean_incoherent, most)
        sigma = math.hypot(self.log_sigma, math.sqrt(DIVISION_VARIANCE) * noise)
        return replace(self, log_sigma=sigma)


def footprint(smoothing: float, squares: FloatArray) -> FloatArray:
    """Return the logarithm of the gain of an average over a length, or of its inverse.

    ``squares`` are those of the wave numbers. It is the beginning of ln(sin x / x).
    """
    bend = math.copysign(0.2 * smoothing**2, smoothing)
    return np.asarray(smoothing * squares + bend * np.square(squares))


def bands_of(windows: Windows, weights: FloatArray) -> Bands:
    """Return the bands of ``windows``, which count by ``weights``, shape (windows,).

    Within a band a window counts the less the more energy it holds, beyond the usual energy:
    otherwise a few broken joints decide.
    """
    p, q = windows.reference, windows.run
    energies = np.stack((np.square(np.abs(p)), np.square(np.abs(q))))
    cross = np.conj(p) * q
    return Bands(
        *np.array(
            [
                _band(windows.wave_number[part], energies[:, :, part], cross[:, part], weights)
                for part in _parts(windows.wave_number, weights.size)
            ]
        )
        .reshape(-1, 5)
        .T
    )


def fit_bands(bands: Bands) -> SymmetricGain:
    """Return the gain of one band or more, with a footprint if they show one.

    Its sigma grows with the misfit, if the bands agree less than their coherence lets expect.
    """
    if bands.gain.size < LEAST_BANDS:
        theta, sigma = _fit(bands, (True, False, False))
        return SymmetricGain(float(theta[0]), float(sigma[0]), 0.0, math.inf)
    theta, sigma = _fit(bands, (True, True, False))
    if abs(theta[1]) < CERTAIN * sigma[1]:
        smoothing_sigma = sigma[1]
        theta, sigma = _fit(bands, (True, False, False))
        sigma[1] = smoothing_sigma
    found = (theta[0], sigma[0], theta[1], sigma[1])
    return SymmetricGain(*(float(value) for value in found))


def find_division(bands: Bands) -> tuple[float, float]:
    """Return where what is not common lies, and its 1-sigma.

    It is 1 if the run alone holds it, 0 if both hold as much, -1 if the reference alone does.
    """
    if bands.gain.size < LEAST_BANDS:
        return 0.0, math.inf
    theta, sigma = _fit(bands, (True, True, True))
    return float(theta[2]), float(sigma[2])


def _fit(bands: Bands, used: tuple[bool, bool, bool]) -> tuple[FloatArray, FloatArray]:
    """Return height, footprint and division, those of ``used``, else 0, and their 1-sigma."""
    squares, inverse = np.square(bands.wave_number), 1.0 / np.square(bands.sigma)
    chosen = np.flatnonzero(used)
    prior = np.diag((0.0, 0.0, 1.0 / DIVISION_VARIANCE))[np.ix_(chosen, chosen)]
    theta, sigma = np.zeros(3), np.zeros(3)
    # Only the bend of a footprint is not linear.
    for _ in range(ITERATIONS if used[1] else 1):
        slope = 1.0 + 0.4 * abs(theta[1]) * squares
        columns = np.stack((np.ones(squares.size), squares * slope, bands.incoherent))[chosen]
        normal = (columns * inverse) @ columns.T + prior
        right = columns @ (inverse * _rest(bands, theta)) - prior @ theta[chosen]
        theta[chosen] += np.linalg.solve(normal, right)
    misfit = float(inverse @ np.square(_rest(bands, theta))) / max(squares.size - chosen.size, 1)
    sigma[chosen] = np.sqrt(max(1.0, misfit) * np.diag(np.linalg.inv(normal)))
    return theta, sigma


def _rest(bands: Bands, theta: FloatArray) -> FloatArray:
    """Return what height, footprint and division leave of the gain of every band."""
    model = theta[0] + footprint(theta[1], np.square(bands.wave_number))
    return np.asarray(bands.gain - model - theta[2] * bands.incoherent)


def _parts(wave_number: FloatArray, windows: int) -> list[slice]:
    """Return the numbers of the waves of every band."""
    parts, first = [], 0
    for end in range(1, wave_number.size + 1):
        wide = end == wave_number.size or wave_number[end] > BAND * wave_number[first]
        if wide and INDEPENDENT * windows * (end - first) >= LEAST_WAVES:
            parts.append(slice(first, end))
            first = end
    return parts or [slice(0, wave_number.size)]


def _band(
    wave_number: FloatArray, energies: FloatArray, cross: Spectra, weights: FloatArray
) -> tuple[float, float, float, float, float]:
    """Return a band's `Bands`: energies have shape (2, windows, waves)."""
    usual = np.maximum(np.median(energies.sum(axis=2), axis=1), 1e-300)
    held = (energies.sum(axis=2) / usual[:, None]).sum(axis=0)
    shares = weights / (2.0 + held)
    p, q = np.einsum("w,iwk->i", shares, energies)
    common = np.einsum("w,wk->", shares, cross)
    waves = _count_waves(shares * held, wave_number.size)
    coherence = min(float(abs(common) ** 2 / (p * q)), 1.0)
    # What is not coherent looks coherent in so few waves, by a wave in n.
    coherence = max(coherence - (1.0 - coherence) ** 2 / waves, 1e-3)
    sigma = math.hypot(math.sqrt((1.0 - coherence) / (2.0 * waves)), FLOOR)
    return (
        float(wave_number.mean()),
        0.5 * math.log(q / p),
        float(np.angle(common)),
        -0.5 * math.log(coherence),
        sigma,
    )


def _count_waves(counted: FloatArray, numbers: int) -> float:
    """Return how many independent waves a band holds, by what every window adds to its energy.

    The energies of like windows scatter, because each has few waves; what they scatter beyond
    that makes some windows count more than others, and the waves fewer.
    """
    beside = 2.0 * max(numbers - 1, 0) * BESIDE[0] + 2.0 * max(numbers - 2, 0) * BESIDE[1]
    expected = (numbers + beside) / numbers**2
    scatter = counted.size * float(np.square(counted).sum() / counted.sum() ** 2)
    return INDEPENDENT * counted.size * numbers * min(1.0, (1.0 + expected) / scatter)
