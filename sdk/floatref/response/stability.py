"""Whether the error of an observer decays: the eigenvalues of its composite error matrix (14)."""

from collections.abc import Sequence

import numpy as np

from floatref.errors import InputError
from floatref.response.model import VehicleModel
from floatref.response.reading import Reading
from floatref.values.arrays import FloatArray

SLOWEST_PER_S = 1e-3
"""An error that decays more slowly, with a time constant beyond a quarter of an hour, stays."""
TIME_CONSTANTS = 10.0
"""After so many of the slowest eigenvalue an error has decayed: to a two-thousandth, even at a
double pole."""


def decay_rate(
    model: VehicleModel, measured: Sequence[Reading], gain: FloatArray, error: FloatArray
) -> float:
    """Return -max Re eig(L) of (14) in 1/s, that with which the slowest part of an error decays.

    ``gain`` is G, shape (2n, k), and ``error`` L. Raises InputError if it does not decay, naming the eigenvalue, the freedom
    that it belongs to and what to do there.
    """
    values = np.linalg.eigvals(error)
    worst = complex(values[np.argmax(values.real)])
    if -worst.real >= SLOWEST_PER_S:
        return -worst.real
    n = len(model.freedoms)
    share = _moved(error, worst, n) * _moved(error.T, worst, n)
    freedom = model.freedoms[int(np.argmax(share))].name
    raise InputError(
        f"model {model.name}: the observer's error does not decay, eigenvalue {_printed(worst)} "
        f"1/s in the motion of the {freedom}; "
        + _advice(model, freedom, measured, gain, worst.imag)
    )


def _moved(matrix: FloatArray, eigenvalue: complex, n: int) -> FloatArray:
    """Return how much each freedom moves in the eigenvectors of ``eigenvalue``, shape (n,).

    Times the same of the transposed matrix, that leaves those freedoms out which others move,
    and the units of angles and heights.
    """
    values, vectors = np.linalg.eig(matrix)
    near = np.abs(values - eigenvalue) <= SLOWEST_PER_S + 1e-6 * abs(eigenvalue)
    amounts = np.abs(vectors[: 2 * n, near]).sum(axis=1)
    return np.asarray(amounts[:n] + amounts[n:])


def _advice(
    model: VehicleModel, freedom: str, measured: Sequence[Reading], gain: FloatArray, swing: float
) -> str:
    """Return which sensor or gain is missing.

    What does not swing, ``swing`` in 1/s, and has no gain on its velocity lacks a spring; all
    else that is measured lacks damping.
    """
    names = [reading.freedom for reading in measured]
    if freedom not in names:
        return f"neither springs nor a reading hold it: measure the displacement of the {freedom}"
    column, n = names.index(freedom), len(model.freedoms)
    held = gain[n + model.index(freedom), column] > 0
    if held or abs(swing) > SLOWEST_PER_S:
        return f"raise g{column + 1}, the gain of its displacement on its displacement"
    return f"raise g{column + len(names) + 1}, the gain of its displacement on its velocity"


def _printed(value: complex) -> str:
    imaginary = f" ± {abs(value.imag):.3g}j" if abs(value.imag) > SLOWEST_PER_S else ""
    return f"{value.real:.3g}{imaginary}"
