"""Gains G of the observer with unknown inputs, (10) of Imine."""

from collections.abc import Sequence
from math import isfinite, pi

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.outputs import Kind, Reading, output_matrices

POSITION_HZ, RATE_HZ = 10.0, 2.0
"""Default frequencies in Hz below which a height follows its sensor, and a velocity the height's.

Lower ones let noise and bias of accelerometers through, higher ones the noise of displacements;
for noise of 10 µm and 0.02 m/s² at 128 Hz, the sum is flat around these.
"""


def default_gains(
    model: VehicleModel,
    measured: Sequence[Reading],
    position_hz: float = POSITION_HZ,
    rate_hz: float = RATE_HZ,
) -> FloatArray:
    """Return g1 to g2k for k measured displacements, shape (2k,), in 1/s and 1/s².

    At a wheel they are a complementary filter of measured displacement and acceleration with two
    real poles: below ``position_hz`` its height is the measured one, above it comes from the
    acceleration; so does its velocity above ``rate_hz``. At another freedom the model replaces the
    acceleration. Such gains make every model stable whose freedoms are all measured. Raises
    InputError for frequencies that are not above zero.
    """
    for name, hertz in (("position_hz", position_hz), ("rate_hz", rate_hz)):
        if not (isfinite(hertz) and hertz > 0):
            raise InputError(f"gains of the observer: {name} is {hertz:g}; give one above zero")
    for reading in measured:
        model.index(reading.freedom)
    fast, slow = 2.0 * pi * position_hz, 2.0 * pi * rate_hz
    return np.repeat([fast + slow, fast * slow], len(measured))


def output_matrix(model: VehicleModel, measured: Sequence[Reading]) -> FloatArray:
    """Return C' of y = C'x, shape (k, 2n); InputError unless all are displacements."""
    if not measured:
        raise InputError(
            f"model {model.name}: the observer measures no displacement; give one of every freedom"
        )
    for reading in measured:
        if reading.kind is not Kind.DISPLACEMENT:
            raise InputError(
                f"model {model.name}: the observer corrects by displacements, not by the "
                f"{reading}; give the displacement"
            )
    return output_matrices(model, measured)[0]


def gain_matrix(model: VehicleModel, measured: Sequence[Reading], gains: ArrayLike) -> FloatArray:
    """Return G, shape (2n, k), of ``gains`` in that shape, or of g1 to g2k as (19) counts them.

    g1 to gk correct, each by the displacement of one reading, the freedom of that reading; gk+1 to
    g2k correct its velocity. Raises InputError for another shape, and for values that are not
    finite.
    """
    given, k, n = np.asarray(gains, dtype=np.float64), len(measured), len(model.freedoms)
    if given.shape not in ((2 * k,), (2 * n, k)):
        raise InputError(
            f"model {model.name}: gains have the shape {given.shape}; {k} measured displacements "
            f"of {n} freedoms need ({2 * k},) or ({2 * n}, {k})"
        )
    if not np.isfinite(given).all():
        raise InputError(f"model {model.name}: a gain is not a finite number; give one for each")
    if given.ndim == 2:
        return given.copy()
    matrix = np.zeros((2 * n, k))
    for column, reading in enumerate(measured):
        place = model.index(reading.freedom)
        matrix[[place, n + place], column] = given[[column, k + column]]
    return matrix


SLOWEST_PER_S = 1e-3
"""Least decay rate in 1/s; an error with a time constant beyond a quarter of an hour stays."""
TIME_CONSTANTS = 10.0
"""Time constants of the slowest eigenvalue until an error has decayed: to 1/2000, even at a
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
    share = _measure_motion(error, worst, n) * _measure_motion(error.T, worst, n)
    freedom = model.freedoms[int(np.argmax(share))].name
    if freedom in [reading.freedom for reading in measured]:
        advice = _gain_to_raise(model, freedom, measured, outputs, error)
    else:
        advice = "neither a spring nor a reading limits it: measure its displacement"
    raise InputError(
        f"model {model.name}: the observer's error does not decay, eigenvalue {_format(worst)} "
        f"1/s in the motion of the {freedom}; {advice}"
    )


def _measure_motion(matrix: FloatArray, eigenvalue: complex, n: int) -> FloatArray:
    """Return how much each freedom moves in the eigenvectors of ``eigenvalue``, shape (n,).

    It is multiplied by the same of the transposed matrix, which removes freedoms moved by others,
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
    """Return which of g1 to g2k, raised by its default, reduces the lasting error most.

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


def _format(value: complex) -> str:
    imaginary = f" ± {abs(value.imag):.3g}j" if abs(value.imag) > SLOWEST_PER_S else ""
    # Rounding may give a negative zero; adding zero removes its sign.
    return f"{round(value.real, 3) + 0.0:.3g}{imaginary}"
