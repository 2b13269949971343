"""What the proving ground asks of a vehicle: a model on four tyres or fewer.

A linear model of n freedoms obeys M·q'' + C·q' + K·q = F·u + D·u'. Among its freedoms are the heave
and, if it has them, the pitch and the roll of the body, in the axes of `floatref`. A model may add
forces at its corners that are not linear.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from floatref.values.arrays import FloatArray
from floatref.values.recording import AxleSetup, Vector
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.proving_ground.vehicles.corner_forces import CornerForces

LARGEST = 7
"""Most freedoms of a model: the kernel's states have room for no more."""
TYRES = 4
"""A model with fewer has columns of zeros in their place."""


@dataclass(frozen=True, eq=False)
class Gauges:
    """What the response channels of one wheel path, or of all, measure.

    Attributes:
        forces: accelerometers by channel: height in m per unit of each freedom, shape (n,).
        deflections: travel of a suspension by channel, likewise.
        test_rig: displacements, velocities, angles and their accelerations by channel,
            likewise; only a test rig has them.
    """

    forces: Mapping[str, FloatArray] = field(default_factory=dict)
    deflections: Mapping[str, FloatArray] = field(default_factory=dict)
    test_rig: Mapping[str, FloatArray] = field(default_factory=dict)


class Suspended(Protocol):
    """A vehicle that can be driven over a road."""

    @property
    def name(self) -> str:
        """Name of the parameter set."""
        ...

    @property
    def cg_height_m(self) -> float:
        """Height of the body's centre of gravity above the ground, in m."""
        ...

    @property
    def sensor_x_m(self) -> float:
        """Reference points of the profiler ahead of the centre of gravity, in m."""
        ...

    @property
    def sensor_z_m(self) -> float:
        """Their height above the ground at rest, in m."""
        ...

    @property
    def antenna_m(self) -> Vector:
        """GNSS antenna from the point on the ground below the centre of gravity, in m."""
        ...

    @property
    def pose(self) -> tuple[int | None, int | None, int | None]:
        """Places of the body's heave, pitch and roll among the freedoms; None: not among them."""
        ...

    def contacts(self) -> Sequence[tuple[float, float]]:
        """Return where each tyre stands, ahead of and to the left of the CG, in m."""
        ...

    def masses(self) -> FloatArray:
        """Return the diagonal of M, shape (n,), in kg and kg·m²."""
        ...

    def stiffness(self) -> FloatArray:
        """Return K, shape (n, n), in N/m, N and N·m."""
        ...

    def damping(self) -> FloatArray:
        """Return C, shape (n, n), in N·s/m, N·s and N·m·s."""
        ...

    def forcing(self) -> FloatArray:
        """Return F, shape (n, 6): roads under four wheels, longitudinal and lateral force."""
        ...

    def tyre_damping(self) -> FloatArray:
        """Return the part of D that the roads drive, shape (n, 4), in N·s/m."""
        ...

    def at_rest(self, force: FloatArray) -> FloatArray:
        """Return the freedoms under a constant force of shape (n,), shape (n,)."""
        ...

    def corner_forces(self) -> CornerForces | None:
        """Return what is not linear at the corners; None where everything is."""
        ...

    def gauges(self, lateral_m: float) -> Gauges:
        """Return what is measured of the wheel path at a lateral position in m."""
        ...

    def shared_gauges(self) -> Gauges:
        """Return what is measured once, whatever the wheel paths."""
        ...

    def make_setup(self) -> VehicleSetup:
        """Return the true parameters of the model that an estimator of the road uses."""
        ...


def axles_of(vehicle: Suspended) -> AxleSetup | None:
    """Return where the axles are, from the point below the CG; None for a vehicle on one."""
    places = [x for x, _ in vehicle.contacts()]
    wheelbase_m = max(places) - min(places)
    return AxleSetup(wheelbase_m, max(places)) if wheelbase_m > 0 else None
