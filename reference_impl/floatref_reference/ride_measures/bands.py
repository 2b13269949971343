"""How much of a road lies between two wavelengths."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from floatref_reference.appendix_a.filters import hpf_b3x2, lpf_b3x2
from floatref_reference.chapter_2.section_2_1_1_iri import slope
from floatref_reference.signals import ZERO, Samples, Signal, samples


class Energy(NamedTuple):
    """What a band holds.

    Attributes:
        elevation: RMS elevation, m.
        slope: RMS slope, m/m.
    """

    elevation: np.longdouble
    slope: np.longdouble


def continued(z: npt.ArrayLike, margin: int) -> Samples:
    """Take the line through both ends off a profile, and continue it on both sides.

    Equation:
        r_k = z_k - z_0 - (z_{N-1} - z_0) k / (N - 1), r_{-k} = -r_k, r_{N-1+k} = -r_{N-1-k}

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        margin: points to be added on each side.

    Returns:
        r from -margin to N - 1 + margin.
    """
    z_x = samples(z)
    last = len(z_x) - 1
    r = [z_x[k] - z_x[0] - (z_x[last] - z_x[0]) * k / last for k in range(last + 1)]
    found: Samples = []
    for k in range(-margin, last + margin + 1):
        place = k % (2 * last)
        found.append(r[place] if place <= last else -r[2 * last - place])
    return found


def band_elevation(z: npt.ArrayLike, dx: float, longest: float, shortest: float) -> Signal:
    """Keep what lies between two wavelengths.

    Equation: Section 2.1.5.2, on elevation: HPF_B3x2 at the longest wavelength and LPF_B3x2 at the
    shortest one, unless that is not above two intervals; the profile is continued by three longest
    wavelengths on both sides.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        longest: longest wavelength, m.
        shortest: shortest wavelength, m.

    Returns:
        Elevation in the band, m, shape (N,).
    """
    margin = math.ceil(3 * longest / dx)
    passed = hpf_b3x2(continued(z, margin), 1 / np.longdouble(longest), dx)
    if shortest > 2 * dx:
        passed = lpf_b3x2(passed, 1 / np.longdouble(shortest), dx)
    return passed[margin : len(passed) - margin]


def root_mean_square(x: npt.ArrayLike) -> np.longdouble:
    """Compute a root mean square.

    Equation:
        √(Σ x_k² / N)

    Args:
        x: signal, shape (N,).

    Returns:
        The root mean square, in the unit of x.
    """
    x_k, total = samples(x), ZERO
    for value in x_k:
        total += value * value
    return np.longdouble(np.sqrt(total / len(x_k)))


def waveband_energy(z: npt.ArrayLike, dx: float, longest: float, shortest: float) -> Energy:
    """Compute RMS elevation and RMS slope between two wavelengths.

    Equation:
        Root mean squares of `band_elevation` and of its slope, step 1 of section 2.1.1.

    Args:
        z: elevation, m, shape (N,), N ≥ 2.
        dx: constant interval Δx, m.
        longest: longest wavelength, m.
        shortest: shortest wavelength, m.

    Returns:
        Both.
    """
    inside = band_elevation(z, dx, longest, shortest)
    return Energy(root_mean_square(inside), root_mean_square(slope(inside, dx)))
