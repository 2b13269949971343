"""A vehicle of seven degrees of freedom: heave, pitch and roll of the body, and four wheels.

Linear springs, dampers, anti-roll bars and tyres; the springs may also rub and stiffen
(`vehicles.corner_forces`). Longitudinal and lateral acceleration act at
the centre of gravity, above the ground that resists them, and so pitch and roll the body; the
suspension links carry a share of that load past the springs (anti-dive, roll centre). Axes as
in `floatref`: nose down and left side up are positive. The springs' coordinates are
z - x·θ + y·φ at a corner (x, y), small-angle; the sensors' kinematics are exact.
"""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.recording import Vector
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.proving_ground.vehicles.axle import Axle
from floatref_conformance.proving_ground.vehicles.corner_forces import CornerForces
from floatref_conformance.proving_ground.vehicles.suspended import TYRES, Gauges

HEAVE, PITCH, ROLL = 0, 1, 2
FREEDOMS = 7
"""Heave, pitch, roll, then the wheels: front left, front right, rear left, rear right."""
BAR_SHARE = 1 / 3
"""Of the anti-roll bar in one corner's spring: over the roads of the proving ground, the travels
of the two front corners correlate at 0.5 to 0.7, so a bar acts on a third of a corner's travel."""


@dataclass(frozen=True)
class Vehicle:
    """The parameters of a vehicle and where its profiler is mounted.

    Attributes:
        name: of the parameter set.
        sprung_kg: mass of the body, in kg.
        pitch_inertia, roll_inertia: of the body about its centre of gravity, in kg·m².
        cg_height_m: of the body's centre of gravity above the ground, in m.
        front, rear: the axles; the front one lies ahead of the centre of gravity.
        anti_dive: share of the longitudinal load transfer that the links carry, 0 to 1.
        roll_links: share of the lateral load transfer that the links carry, 0 to 1.
        sensor_x_m: reference points of the profiler ahead of the centre of gravity, in m.
        sensor_z_m: their height above the ground at rest, in m.
        antenna_m: GNSS antenna, from the point on the ground below the centre of gravity, in m.
        response_axle: place in `axles` of the one whose wheels bear response sensors.
    """

    name: str
    sprung_kg: float
    pitch_inertia: float
    roll_inertia: float
    cg_height_m: float
    front: Axle
    rear: Axle
    anti_dive: float
    roll_links: float
    sensor_x_m: float
    sensor_z_m: float = 0.282
    antenna_m: Vector = (-1.0, 0.0, 2.464)
    response_axle: int = 0

    def __post_init__(self) -> None:
        """Refuse parameters that no vehicle has; InputError names the first."""
        for name in ("sprung_kg", "pitch_inertia", "roll_inertia", "cg_height_m", "sensor_z_m"):
            self._check_positive(name, getattr(self, name))
        for where, axle in zip(("front", "rear"), self.axles, strict=True):
            for name in ("half_track_m", "wheel_kg", "spring", "damper", "tyre"):
                self._check_positive(f"{where}.{name}", getattr(axle, name))
            for name in ("friction", "progression"):
                self._check_option(f"{where}.{name}", getattr(axle, name))
        self._check_loads()

    def _check_positive(self, name: str, value: float) -> None:
        """Raise InputError unless a parameter is a finite number above zero."""
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"vehicle {self.name}: {name} is {value}; it must be above zero")

    def _check_option(self, name: str, value: float) -> None:
        """Raise InputError unless a parameter is a finite number, 0 or above."""
        if not (np.isfinite(value) and value >= 0):
            raise InputError(f"vehicle {self.name}: {name} is {value}; it must be 0 or above")

    def _check_loads(self) -> None:
        """Raise InputError unless the springs can bear the body and the links their share."""
        if not self.rear.x_m < 0 < self.front.x_m:
            raise InputError(f"vehicle {self.name}: the centre of gravity is not between the axles")
        if not (0 <= self.anti_dive < 1 and 0 <= self.roll_links < 1):
            raise InputError(f"vehicle {self.name}: anti_dive and roll_links must be in [0, 1)")
        for where, travel in zip(("front", "rear"), self.static_deflections(), strict=True):
            if not 0.01 <= travel <= 0.4:
                raise InputError(
                    f"vehicle {self.name}: {where} springs sag {travel:.3g} m under the body; "
                    "0.01 to 0.4 m is plausible, check spring and mass"
                )

    @property
    def axles(self) -> tuple[Axle, Axle]:
        """Front and rear axle."""
        return self.front, self.rear

    @property
    def wheelbase_m(self) -> float:
        """Distance between the axles, in m."""
        return self.front.x_m - self.rear.x_m

    def load_shares(self) -> tuple[float, float]:
        """Return the shares of the body's weight on the front and on the rear axle."""
        return -self.rear.x_m / self.wheelbase_m, self.front.x_m / self.wheelbase_m

    def static_deflections(self) -> tuple[float, float]:
        """Return how far the front and the rear springs sag under the body, in m."""
        weight = self.sprung_kg * STANDARD_GRAVITY / 2
        front, rear = self.load_shares()
        return weight * front / self.front.spring, weight * rear / self.rear.spring

    def wheels(self) -> list[tuple[Axle, float]]:
        """Return axle and lateral position in m of every wheel, in the order of the freedoms."""
        return [(axle, side * axle.half_track_m) for axle in self.axles for side in (1, -1)]

    @property
    def pose(self) -> tuple[int, int, int]:
        """Places of heave, pitch and roll among the freedoms."""
        return HEAVE, PITCH, ROLL

    def contacts(self) -> list[tuple[float, float]]:
        """Return where every wheel stands, ahead of and to the left of the CG, in m."""
        return [(axle.x_m, y) for axle, y in self.wheels()]

    def masses(self) -> FloatArray:
        """Return the diagonal of the mass matrix, shape (7,), in kg and kg·m²."""
        wheels = [axle.wheel_kg for axle, _ in self.wheels()]
        return np.array([self.sprung_kg, self.pitch_inertia, self.roll_inertia, *wheels])

    def stiffness(self) -> FloatArray:
        """Return the stiffness matrix, shape (7, 7), in N/m, N and N·m."""
        matrix = self._assemble([axle.spring for axle in self.axles])
        travel = self._travel()
        for number, axle in enumerate(self.axles):
            twist = travel[2 * number] - travel[2 * number + 1]
            matrix += axle.anti_roll * np.outer(twist, twist)
        tyres = [axle.tyre for axle, _ in self.wheels()]
        return matrix + np.diag([0.0, 0.0, 0.0, *tyres])

    def damping(self) -> FloatArray:
        """Return the damping matrix, shape (7, 7), in N·s/m, N·s and N·m·s."""
        return self._assemble([axle.damper for axle in self.axles])

    def forcing(self) -> FloatArray:
        """Return the forces per unit of input, shape (7, 6).

        Inputs are the road's elevation under the four wheels in m, and the longitudinal and
        lateral specific force of the ground on the body in m/s².
        """
        matrix = np.zeros((FREEDOMS, 6))
        transfer = self.sprung_kg * self.cg_height_m
        matrix[PITCH, 4] = -transfer * (1 - self.anti_dive)
        matrix[ROLL, 5] = transfer * (1 - self.roll_links)
        shares = self.load_shares()
        for wheel, (axle, y) in enumerate(self.wheels()):
            matrix[3 + wheel, wheel] = axle.tyre
            ahead = 1 if axle is self.front else -1
            matrix[3 + wheel, 4] = ahead * self.anti_dive * transfer / (2 * self.wheelbase_m)
            matrix[3 + wheel, 5] = self.roll_links * transfer * shares[wheel // 2] / (2 * y)
        return matrix

    def tyre_damping(self) -> FloatArray:
        """Return zeros, shape (7, 4): these tyres are springs alone."""
        return np.zeros((FREEDOMS, TYRES))

    def at_rest(self, force: FloatArray) -> FloatArray:
        """Return the freedoms under a constant force, shapes (7,)."""
        corners = self.corner_forces()
        if corners is not None:
            return corners.at_rest(self.stiffness(), force)
        return np.asarray(np.linalg.solve(self.stiffness(), force))

    def corner_forces(self) -> CornerForces | None:
        """Return what friction and progression add; None where every axle's are 0."""
        axles = [axle for axle, _ in self.wheels()]
        cubic = np.array([axle.spring * axle.progression for axle in axles])
        limit = np.array([axle.friction for axle in axles])
        if not (cubic.any() or limit.any()):
            return None
        return CornerForces(self._travel(), cubic, limit)

    def gauges(self, lateral_m: float) -> Gauges:
        """Return what is measured at the wheel of ``response_axle`` nearest to ``lateral_m``.

        The body's height above it is the springs' own, z − x·θ + y·φ; in the middle, the left
        wheel counts.
        """
        half_m = self.axles[self.response_axle].half_track_m
        right = abs(lateral_m + half_m) < abs(lateral_m - half_m)
        wheel = 2 * self.response_axle + int(right)
        travel = self._travel()[wheel]
        unsprung = np.eye(FREEDOMS)[3 + wheel]
        forces = {
            "unsprung_specific_force": unsprung,
            "sprung_specific_force": travel + unsprung,
        }
        return Gauges(forces, {"suspension_deflection": travel})

    def shared_gauges(self) -> Gauges:
        """Return nothing: all of this vehicle's response channels belong to a wheel path."""
        return Gauges()

    def make_setup(self) -> VehicleSetup:
        """Return the quarter car of a measured corner: its share of the body on its own wheel."""
        axle = self.axles[self.response_axle]
        parameters = {
            "sprung_kg": self.sprung_kg * self.load_shares()[self.response_axle] / 2,
            "unsprung_kg": axle.wheel_kg,
            "suspension_n_per_m": axle.spring + BAR_SHARE * axle.anti_roll,
            "suspension_ns_per_m": axle.damper,
            "tyre_n_per_m": axle.tyre,
            "tyre_ns_per_m": 0.0,
        }
        return VehicleSetup("quarter-car", parameters, axle.x_m)

    def _travel(self) -> FloatArray:
        """Return each corner's suspension travel per unit of freedom, shape (4, 7)."""
        rows = np.zeros((4, FREEDOMS))
        for wheel, (axle, y) in enumerate(self.wheels()):
            rows[wheel, :3] = 1.0, -axle.x_m, y
            rows[wheel, 3 + wheel] = -1.0
        return rows

    def _assemble(self, per_axle: list[float]) -> FloatArray:
        """Return the sum over the corners of travel·travelᵀ times an axle's element."""
        rows = self._travel()
        return np.asarray(rows.T @ (np.repeat(per_axle, 2)[:, None] * rows))
