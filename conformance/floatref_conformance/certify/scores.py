"""The score of a piece of the reference at every place of a run, by way of their spectra."""

from collections.abc import Sequence

import numpy as np
from numpy.fft import irfft, rfft
from numpy.typing import NDArray

from floatref.values.arrays import FloatArray
from floatref_conformance.certify.slopes import Slope


class Searched:
    """A run's slopes and, once asked for, their spectra."""

    def __init__(self, slopes: Sequence[Slope]) -> None:
        self.slopes = slopes
        self._spectra: dict[int, list[NDArray[np.complex128]]] = {}

    def spectra(self, padded: int) -> list[NDArray[np.complex128]]:
        """Return the spectra of all wheel paths, padded with zeros to so many points."""
        if padded not in self._spectra:
            self._spectra[padded] = [rfft(slope.values, padded) for slope in self.slopes]
        return self._spectra[padded]


def scores_of(templates: Sequence[FloatArray], searched: Searched) -> list[list[FloatArray]]:
    """Return the score of every template in every wheel path, by place.

    Place k has the template's last point on point k of the run; places run over its end.
    """
    run, size = searched.slopes, templates[0].size
    count = run[0].values.size
    padded = 1 << (count + size - 2).bit_length()
    energies = [_windowed_energy(slope.values, size) for slope in run]
    rows = []
    for template in templates:
        spectrum = rfft(template[::-1], padded)
        own = float(np.square(template).sum())
        rows.append(
            [
                _normalised(irfft(spectrum * s, padded)[: count + size - 1], own * energy)
                for s, energy in zip(searched.spectra(padded), energies, strict=True)
            ]
        )
    return rows


def _windowed_energy(values: FloatArray, size: int) -> FloatArray:
    """Return the sum of squares of the ``size`` points up to every point, and over the end."""
    total = np.concatenate((np.zeros(size), np.cumsum(np.square(values))))
    padded = np.concatenate((total, np.full(size - 1, total[-1])))
    return np.asarray(padded[size:] - padded[: padded.size - size])


def _normalised(products: FloatArray, energies: FloatArray) -> FloatArray:
    """Return ``products`` over the root of ``energies``, 0 where there is next to none."""
    least = 1e-6 * float(energies.max(initial=0.0))
    shaped = energies > least
    out = np.zeros(products.size)
    np.divide(products, np.sqrt(np.where(shaped, energies, 1.0)), out=out, where=shaped)
    return out
