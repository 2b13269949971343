"""Measurements of a model: accelerations, velocities, displacements of its freedoms."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import isfinite

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.models.model import VehicleModel
from floatref.vehicle_response.models.state_space import state_space


class Kind(Enum):
    """The measured derivative of a coordinate: the rows of S_d, S_v, S_a (10) of Zhu."""

    DISPLACEMENT = 0
    VELOCITY = 1
    ACCELERATION = 2


@dataclass(frozen=True)
class Reading:
    """One measured signal of a model.

    Attributes:
        kind: which derivative.
        freedom: name of the coordinate.
        sigma: standard deviation of one sample, in the unit of the signal.
        minus: name of a coordinate whose derivative is subtracted, for a suspension deflection;
            "" for no coordinate.
    """

    kind: Kind
    freedom: str
    sigma: float
    minus: str = ""

    def __post_init__(self) -> None:
        """Refuse a standard deviation not above zero, and a freedom measured against itself."""
        if not (isfinite(self.sigma) and self.sigma > 0):
            raise InputError(f"{self}: sigma is {self.sigma:g}; give a number above zero")
        if self.minus == self.freedom:
            raise InputError(f"{self}: a freedom against itself measures nothing; name another")

    def __str__(self) -> str:
        """Return it in words, as in "acceleration of the front wheel"."""
        other = f" against the {self.minus}" if self.minus else ""
        return f"{self.kind.name.lower()} of the {self.freedom}{other}"


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
