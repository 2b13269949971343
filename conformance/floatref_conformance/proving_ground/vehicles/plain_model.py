"""A linear model as a paper prints it: coordinates, tyres and the matrices M, C and K.

It answers to the road alone: what brakes or corners the vehicle does not tilt it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Protocol, TypeVar

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.recording import Vector
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.proving_ground.vehicles.corner_forces import CornerForces
from floatref_conformance.proving_ground.vehicles.suspended import LARGEST, TYRES, Gauges

ANGULAR = ("pitch", "roll")
NO_SPRING = 1e-12
"""Of the largest stiffness per mass: a motion with less is free, as rounding leaves it."""
NEITHER: Mapping[str, FloatArray] = MappingProxyType({})


class _Placed(Protocol):
    """Something measured, with or without a wheel path nearest to it."""

    @property
    def channel(self) -> str: ...

    @property
    def y_m(self) -> float | None: ...


P = TypeVar("P", bound=_Placed)


@dataclass(frozen=True)
class Coordinate:
    """A freedom in the paper's own coordinates.

    Attributes:
        channel: how its channels begin: "sprung", "unsprung", "pitch", …
        inertia: in kg or kg·m².
        sign: of the recording's channel for a positive coordinate, 1 or −1.
        y_m: where it is, left positive, in m; the wheel path nearest to it has its channels.
            None: they are shared by all.
    """

    channel: str
    inertia: float
    sign: float = 1.0
    y_m: float | None = None


@dataclass(frozen=True)
class Contact:
    """A tyre under the freedom at place ``wheel``; in m, N/m and N·s/m."""

    wheel: int
    stiffness: float
    damping: float = 0.0
    x_m: float = 0.0
    y_m: float = 0.0


@dataclass(frozen=True, eq=False)
class Travel:
    """A suspension: body minus wheel, per unit of the paper's coordinates."""

    channel: str
    row: tuple[float, ...]
    y_m: float = 0.0


@dataclass(frozen=True, eq=False)
class PlainModel:
    """A paper's model as a vehicle that can be driven; matrices with the tyres' part.

    Attributes:
        name: of the parameter set.
        coordinates: up to 7, one of them "sprung".
        tyres: up to 4.
        paper_damping, paper_stiffness: C and K in the paper's coordinates, shape (n, n).
        suspensions: whose travel is measured.
        setup: name and parameters of the model, as `floatref` takes them.
        sensor_x_m, sensor_z_m, cg_height_m, antenna_m: as of `vehicle.Vehicle`.
    """

    name: str
    coordinates: tuple[Coordinate, ...]
    tyres: tuple[Contact, ...]
    paper_damping: FloatArray
    paper_stiffness: FloatArray
    suspensions: tuple[Travel, ...]
    setup: VehicleSetup
    sensor_x_m: float
    cg_height_m: float
    antenna_m: Vector
    sensor_z_m: float = 0.282

    def __post_init__(self) -> None:
        """Refuse what the kernel has no room for, and matrices that do not fit."""
        size = len(self.coordinates)
        if size > LARGEST or len(self.tyres) > TYRES:
            raise InputError(f"vehicle {self.name}: more than {LARGEST} freedoms or {TYRES} tyres")
        for matrix in (self.paper_damping, self.paper_stiffness):
            if matrix.shape != (size, size) or not np.allclose(matrix, matrix.T, rtol=1e-12):
                raise InputError(
                    f"vehicle {self.name}: a matrix is not symmetric, or not {size} wide"
                )

    @property
    def pose(self) -> tuple[int | None, int | None, int | None]:
        """Places of the body's heave, pitch and roll; None: not in the model."""
        names = [c.channel for c in self.coordinates]
        heave, pitch, roll = (
            names.index(name) if name in names else None for name in ("sprung", *ANGULAR)
        )
        return heave, pitch, roll

    def contacts(self) -> list[tuple[float, float]]:
        """Return where each tyre stands, ahead of and to the left of the body's centre, in m."""
        return [(tyre.x_m, tyre.y_m) for tyre in self.tyres]

    def masses(self) -> FloatArray:
        """Return the diagonal of M, shape (n,), in kg and kg·m²."""
        return np.array([c.inertia for c in self.coordinates])

    def stiffness(self) -> FloatArray:
        """Return K in the recording's axes, shape (n, n), in N/m, N and N·m."""
        return self.paper_stiffness * np.outer(self._signs, self._signs)

    def damping(self) -> FloatArray:
        """Return C in the recording's axes, shape (n, n), in N·s/m, N·s and N·m·s."""
        return self.paper_damping * np.outer(self._signs, self._signs)

    def forcing(self) -> FloatArray:
        """Return the tyres' stiffness, shape (n, 6); acceleration along the lane does nothing."""
        matrix = np.zeros((len(self.coordinates), TYRES + 2))
        for column, tyre in enumerate(self.tyres):
            matrix[tyre.wheel, column] = tyre.stiffness
        return matrix

    def tyre_damping(self) -> FloatArray:
        """Return the tyres' damping, shape (n, 4), in N·s/m."""
        matrix = np.zeros((len(self.coordinates), TYRES))
        for column, tyre in enumerate(self.tyres):
            matrix[tyre.wheel, column] = tyre.damping
        return matrix

    def at_rest(self, force: FloatArray) -> FloatArray:
        """Return the freedoms under a constant force, shapes (n,).

        Of the solutions of K·q = f, that of least norm, each freedom weighted by the root of its
        mass: a motion without springs starts at zero momentum and place, and stays there.
        """
        root = np.sqrt(self.masses())
        scaled = self.stiffness() / np.outer(root, root)
        return np.asarray(np.linalg.pinv(scaled, NO_SPRING, hermitian=True) @ (force / root) / root)

    def corner_forces(self) -> CornerForces | None:
        """Return None: the model is linear."""
        return None

    def gauges(self, lateral_m: float) -> Gauges:
        """Return what is measured nearest to a lateral position in m; the left of two alike."""
        near = _nearest((c for c in self.coordinates if c.y_m is not None), lateral_m)
        travels = _nearest(self.suspensions, lateral_m)
        rows = {t.channel: np.array(t.row) * self._signs for t in travels}
        return _gauges(self._rows(near), rows)

    def shared_gauges(self) -> Gauges:
        """Return what is measured of the body, whatever the wheel paths."""
        shared = [c for c in self.coordinates if c.y_m is None]
        return _gauges(self._rows(shared), NEITHER)

    def make_setup(self) -> VehicleSetup:
        """Return the model's name and parameters."""
        return self.setup

    @property
    def _signs(self) -> FloatArray:
        return np.array([c.sign for c in self.coordinates])

    def _rows(self, wanted: Iterable[Coordinate]) -> dict[str, FloatArray]:
        """Return the freedom of every coordinate ``wanted``, by the start of its channels."""
        unit = np.eye(len(self.coordinates))
        return {c.channel: unit[self.coordinates.index(c)] for c in wanted}


def _nearest(placed: Iterable[P], lateral_m: float) -> list[P]:
    """Return of each channel that which is nearest to ``lateral_m``, the first of two alike."""
    best: dict[str, P] = {}
    for one in placed:
        other = best.get(one.channel)
        if other is None or abs((one.y_m or 0.0) - lateral_m) < abs((other.y_m or 0.0) - lateral_m):
            best[one.channel] = one
    return list(best.values())


def _gauges(rows: Mapping[str, FloatArray], deflections: Mapping[str, FloatArray]) -> Gauges:
    """Return the channels of a test rig, where heights have accelerometers too."""
    heights = {name: row for name, row in rows.items() if name not in ANGULAR}
    forces = {f"{name}_specific_force": row for name, row in heights.items()}
    test_rig = {
        f"{n}_{kind}": r for n, r in heights.items() for kind in ("displacement", "velocity")
    }
    for name in rows.keys() - heights.keys():
        test_rig |= {f"{name}_{kind}": rows[name] for kind in ("angle", "acceleration")}
    return Gauges(forces, deflections, test_rig)
