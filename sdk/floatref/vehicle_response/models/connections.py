"""Models assembled from masses, tyres, springs and dampers.

A spring k whose length changes by r·q adds k·r·rᵀ to K, a damper likewise to C: both are symmetric
and store or take energy, whatever the numbers.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.vehicle_response.models.model import Freedom, Tyre, VehicleModel


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


def connect(
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


UNITS = {
    "_n_per_m": "N/m",
    "_ns_per_m": "N·s/m",
    "_kg_m2": "kg·m²",
    "_kg": "kg",
    "_m": "m",
}
"""Units by the end of a parameter's name, the longer first."""


def unit_of(parameter: str) -> str:
    """Return the unit that the name of ``parameter`` ends with."""
    return next(unit for end, unit in UNITS.items() if parameter.endswith(end))


def check_parameters(
    model: str,
    values: Mapping[str, float],
    not_below_zero: Collection[str] = (),
    any_sign: Collection[str] = (),
) -> None:
    """Raise InputError unless ``values`` are finite and, except for those named, above zero."""
    for name, value in values.items():
        if name in any_sign:
            right, wanted = True, "a finite number"
        elif name in not_below_zero:
            right, wanted = value >= 0, "a finite number, zero or above"
        else:
            right, wanted = value > 0, "a finite number above zero"
        if not (right and isfinite(value)):
            raise InputError(
                f"model {model}: {name} is {value:g} {unit_of(name)}; give it in "
                f"{unit_of(name)}, {wanted}"
            )


def check_inertia(model: str, name: str, inertia: float, mass: float, reach_m: float) -> None:
    """Raise InputError if a body of ``mass`` in kg cannot have ``inertia`` in kg·m².

    With all of the mass at ``reach_m``, in m, from its centre, it would be mass·reach².
    """
    most = mass * reach_m**2
    if inertia > most:
        raise InputError(
            f"model {model}: {name} is {inertia:g} kg·m², above the {most:g} kg·m² of {mass:g} kg "
            f"at {reach_m:g} m from the centre; check its unit and those of mass and distances"
        )
