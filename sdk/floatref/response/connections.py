"""Models put together from masses, tyres, springs and dampers.

A spring k whose length changes by r·q adds k·r·rᵀ to K, a damper likewise to C: both are symmetric
and store or take energy, whatever the numbers.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.response.model import Freedom, Tyre, VehicleModel
from floatref.values.arrays import FloatArray


@dataclass(frozen=True)
class Connection:
    """A spring and a damper side by side.

    Attributes:
        row: r, the lengthening r·q in m for the coordinates q.
        stiffness: in N/m.
        damping: in N·s/m.
    """

    row: tuple[float, ...]
    stiffness: float
    damping: float = 0.0


def connected(
    name: str,
    freedoms: Sequence[tuple[Freedom, float]],
    tyres: Sequence[Tyre],
    connections: Sequence[Connection],
) -> VehicleModel:
    """Return the model of ``freedoms``, each with its mass in kg or its inertia in kg·m².

    The tyres' own stiffness and damping are added to K and C, as in (7) of Zhu and of Imine.
    Raises InputError for a row of another length than q, and as `VehicleModel`.
    """
    coordinates = tuple(freedom for freedom, _ in freedoms)
    names = [freedom.name for freedom in coordinates]
    for connection in connections:
        if len(connection.row) != len(names):
            raise InputError(
                f"model {name}: a connection has the row {connection.row}; give a number for each "
                f"of {', '.join(names)}"
            )
    ends = [_tyre_connection(tyre, names) for tyre in tyres]
    everything = [*connections, *ends]
    return VehicleModel(
        name=name,
        freedoms=coordinates,
        tyres=tuple(tyres),
        mass=np.diag([mass for _, mass in freedoms]),
        damping=_sum_of([(c.damping, c.row) for c in everything]),
        stiffness=_sum_of([(c.stiffness, c.row) for c in everything]),
    )


def _tyre_connection(tyre: Tyre, names: list[str]) -> Connection:
    row = tuple(float(name == tyre.freedom) for name in names)
    return Connection(row, tyre.stiffness, tyre.damping)


def _sum_of(parts: Sequence[tuple[float, tuple[float, ...]]]) -> FloatArray:
    values, rows = np.array([value for value, _ in parts]), np.array([row for _, row in parts])
    return np.asarray((rows.T * values) @ rows)
