"""The waves of known lengths in a profile, by least squares."""

import numpy as np
from numpy.typing import NDArray

from floatref.values.arrays import FloatArray

ComplexArray = NDArray[np.complex128]


def waves_of(x: FloatArray, elevation: FloatArray, wavelengths_m: FloatArray) -> ComplexArray:
    """Return the complex amplitude in m of every wave, the phase being that at distance 0.

    A wave c is the real part of c·exp(2πi·x/λ). A level and a slope are fitted with the waves.

    Args:
        x: where the points lie, in m, shape (n,).
        elevation: in m, shape (n,).
        wavelengths_m: shape (m,), all different.
    """
    angle = np.outer(2 * np.pi / wavelengths_m, x)
    level = np.stack([np.ones_like(x), (x - x.mean()) / (x[-1] - x[0])])
    rows = np.concatenate([np.cos(angle), np.sin(angle), level])
    found = np.linalg.solve(rows @ rows.T, rows @ elevation)
    count = wavelengths_m.size
    return np.asarray(found[:count] - 1j * found[count : 2 * count], dtype=np.complex128)
