"""What readings tell of states and forces: G and J of (11) of Zhu."""

from collections.abc import Sequence

import numpy as np

from floatref.errors import InputError
from floatref.response.model import VehicleModel
from floatref.response.reading import Kind, Reading
from floatref.response.state_space import state_space
from floatref.values.arrays import FloatArray


def output_matrices(
    model: VehicleModel, readings: Sequence[Reading]
) -> tuple[FloatArray, FloatArray]:
    """Return (G, J) of Z = G·x + J·F for m ``readings``, as in (11) of Zhu.

    G has the shape (m, 2n), J the shape (m, p), in the unit of the reading per N. Raises
    InputError without readings, or for one of a freedom that the model does not have.
    """
    if not readings:
        raise InputError(f"model {model.name}: no readings; give those of its sensors")
    size = len(model.freedoms)
    a, b = state_space(model)
    # Accelerations are the lower half of x' = A·x + B·F.
    rows = {
        Kind.DISPLACEMENT: (np.eye(2 * size)[:size], np.zeros((size, b.shape[1]))),
        Kind.VELOCITY: (np.eye(2 * size)[size:], np.zeros((size, b.shape[1]))),
        Kind.ACCELERATION: (a[size:], b[size:]),
    }
    chosen = selection(model, readings)
    output = np.stack([s @ rows[r.kind][0] for s, r in zip(chosen, readings, strict=True)])
    direct = np.stack([s @ rows[r.kind][1] for s, r in zip(chosen, readings, strict=True)])
    return output, direct


def selection(model: VehicleModel, readings: Sequence[Reading]) -> FloatArray:
    """Return which coordinates each reading is of, shape (m, n): the rows of (10) of Zhu.

    InputError for a freedom that the model does not have.
    """
    matrix = np.zeros((len(readings), len(model.freedoms)))
    for row, reading in zip(matrix, readings, strict=True):
        row[model.index(reading.freedom)] += 1.0
        if reading.minus:
            row[model.index(reading.minus)] -= 1.0
    return matrix
