"""Gains G of the observer with unknown inputs, (10) of Imine."""

from collections.abc import Sequence
from math import isfinite, pi

import numpy as np
from numpy.typing import ArrayLike

from floatref.errors import InputError
from floatref.response.model import VehicleModel
from floatref.response.output import output_matrices
from floatref.response.reading import Kind, Reading
from floatref.values.arrays import FloatArray

POSITION_HZ, RATE_HZ = 10.0, 2.0
"""By default, below which frequency a height follows its sensor, and a velocity the height's.

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

    At a wheel they are a complementary filter of measured displacement and acceleration with
    two real poles: below ``position_hz`` its height is the measured one, above it comes from the
    acceleration; so does its velocity above ``rate_hz``. At another freedom the model takes the
    place of the acceleration. Such gains make every model stable whose freedoms are all measured.
    Raises InputError for frequencies that are not above zero.
    """
    for name, hertz in (("position_hz", position_hz), ("rate_hz", rate_hz)):
        if not (isfinite(hertz) and hertz > 0):
            raise InputError(f"gains of the observer: {name} is {hertz:g}; give one above zero")
    for reading in measured:
        model.index(reading.freedom)
    fast, slow = 2.0 * pi * position_hz, 2.0 * pi * rate_hz
    return np.repeat([fast + slow, fast * slow], len(measured))


def output_matrix(model: VehicleModel, measured: Sequence[Reading]) -> FloatArray:
    """Return C' of y = C'x, shape (k, 2n); InputError for what is no displacement, or none."""
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

    g1 to gk correct, each by the displacement of one reading, the freedom of that reading; gk+1
    to g2k correct its velocity. Raises InputError for another shape, and for what is no number.
    """
    given, k, n = np.asarray(gains, dtype=np.float64), len(measured), len(model.freedoms)
    if given.shape not in ((2 * k,), (2 * n, k)):
        raise InputError(
            f"model {model.name}: gains have the shape {given.shape}; {k} measured displacements "
            f"of {n} freedoms need ({2 * k},) or ({2 * n}, {k})"
        )
    if not np.isfinite(given).all():
        raise InputError(f"model {model.name}: a gain is no finite number; give one for each")
    if given.ndim == 2:
        return given.copy()
    matrix = np.zeros((2 * n, k))
    for column, reading in enumerate(measured):
        place = model.index(reading.freedom)
        matrix[[place, n + place], column] = given[[column, k + column]]
    return matrix
