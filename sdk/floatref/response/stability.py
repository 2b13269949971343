"""Whether the error of an observer decays: the eigenvalues of its composite error matrix (14)."""

from collections.abc import Sequence

import numpy as np

from floatref.errors import InputError
from floatref.response.gains import default_gains
from floatref.response.model import VehicleModel
from floatref.response.reading import Reading
from floatref.values.arrays import FloatArray

SLOWEST_PER_S = 1e-3
"""An error that decays more slowly, with a time constant beyond a quarter of an hour, stays."""
TIME_CONSTANTS = 10.0
"""After so many of the slowest eigenvalue an error has decayed: to a two-thousandth, even at a
double pole."""


def decay_rate(
    model: VehicleModel, measured: Sequence[Reading], outputs: FloatArray, error: FloatArray
) -> float:
    """Return -max Re eig(L) of (15) of Imine, in 1/s: how fast the slowest part of an error decays.

    ``outputs`` is C' of the readings ``measured``, shape (k, 2n), and ``error`` is L. Raises
    InputError if an error does not decay, naming the eigenvalue, the freedom that it belongs to,
    and the gain to raise or the sensor to add.
    """
    values = np.linalg.eigvals(error)
    worst = complex(values[np.argmax(values.real)])
    if -worst.real >= SLOWEST_PER_S:
        return -worst.real
    n = len(model.freedoms)
    share = _moved(error, worst, n) * _moved(error.T, worst, n)
    freedom = model.freedoms[int(np.argmax(share))].name
    if freedom in [reading.freedom for reading in measured]:
        advice = _gain_to_raise(model, freedom, measured, outputs, error)
    else:
        advice = "neither springs nor a reading hold it: measure its displacement"
    raise InputError(
        f"model {model.name}: the observer's error does not decay, eigenvalue {_printed(worst)} "
        f"1/s in the motion of the {freedom}; {advice}"
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


def _gain_to_raise(
    model: VehicleModel,
    freedom: str,
    measured: Sequence[Reading],
    outputs: FloatArray,
    error: FloatArray,
) -> str:
    """Return which of g1 to g2k, more by its default, leaves least of what does not decay.

    Of equals, one of ``freedom``.
    """
    ways, n = [], len(model.freedoms)
    for number, more in enumerate(default_gains(model, measured)):
        on, column = divmod(number, len(measured))
        raised = error.copy()
        raised[on * n + model.index(measured[column].freedom), : 2 * n] -= more * outputs[column]
        growth = np.linalg.eigvals(raised).real + SLOWEST_PER_S
        another = measured[column].freedom != freedom
        ways.append((np.count_nonzero(growth > 0), another, growth[growth > 0].sum(), number))
    best = min(ways)[-1]
    on, column = divmod(best, len(measured))
    return (
        f"raise g{best + 1}, by which the {measured[column]} corrects "
        f"{('that displacement', 'its velocity')[on]}"
    )


def _printed(value: complex) -> str:
    imaginary = f" ± {abs(value.imag):.3g}j" if abs(value.imag) > SLOWEST_PER_S else ""
    # Rounding leaves next to nothing of a zero; adding one takes its sign.
    return f"{round(value.real, 3) + 0.0:.3g}{imaginary}"
