"""The vehicle's response to the road and to acceleration, sampled by the trapezoidal rule.

M·q'' + C·q' + K·q = F·u, with the inputs u of `Vehicle.forcing`. For a constant linear system
the trapezoidal rule is the bilinear transform x⁺ = (I − hA/2)⁻¹((I + hA/2)·x + (h/2)·B·(u + u⁺));
position, velocity and acceleration then obey the rule exactly, sample by sample.
"""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray
from floatref_conformance.proving_ground.road import Road
from floatref_conformance.proving_ground.vehicle import FREEDOMS, Vehicle

LOWEST_RATE_HZ = 8000.0
"""The model is stepped at least this often, at a whole multiple of the recording's rate."""
ENVELOPE_M = 0.25
"""Length over which a tyre averages the road, in m."""
STATES, INPUTS = 16, 6


def oversampling(rate_hz: float) -> int:
    """Return how many steps of the model make one sample of a recording at ``rate_hz``."""
    return max(1, int(np.ceil(LOWEST_RATE_HZ / rate_hz)))


@dataclass(eq=False)
class Response:
    """A vehicle on a road, advanced stretch by stretch from static equilibrium.

    Attributes:
        update: kernel matrix to the next state, shape (22, 16).
        outputs: kernel matrix to the body's second derivatives, shape (22, 4).
        vector: states and inputs after the last step, shape (22,).
        lanes: enveloped road under each wheel, shape (4, m), in m.
        grid: start of ``lanes`` in m and their points per m.
        wheel_x: wheels ahead of the vehicle point, shape (4,), in m.
    """

    update: FloatArray
    outputs: FloatArray
    vector: FloatArray
    lanes: FloatArray
    grid: FloatArray
    wheel_x: FloatArray

    @classmethod
    def of(cls, vehicle: Vehicle, road: Road, step_s: float, ground: FloatArray) -> "Response":
        """Return ``vehicle`` at rest on its springs at distance 0 of ``road``.

        ``step_s`` is the model's step in s, ``ground`` the longitudinal and lateral specific
        force at the start, shape (2,), in m/s².
        """
        lanes = under_wheels(vehicle, road)
        wheel_x = np.array([axle.x_m for axle, _ in vehicle.wheels()])
        index = (wheel_x - road.start_m) / road.spacing_m
        points = np.arange(road.points, dtype=np.float64)
        start = [np.interp(i, points, lane) for i, lane in zip(index, lanes, strict=True)]
        inputs = np.array([*start, *ground])
        update, outputs = bilinear(vehicle, step_s)
        vector = np.zeros(STATES + INPUTS)
        vector[:FREEDOMS] = equilibrium(vehicle, inputs)
        vector[STATES:] = inputs
        return cls(update, outputs, vector, lanes, grid_of(road), wheel_x)

    def advance(self, distance: FloatArray, ground: FloatArray) -> FloatArray:
        """Return the body's motion at every step of the next stretch.

        Args:
            distance: at every step, shape (n,), in m.
            ground: specific force of the ground, shape (2, n), in m/s².

        Returns:
            Heave, pitch, roll and their first and second derivatives, shape (9, n).
        """
        from floatref_conformance.proving_ground.kernels import BODY_ROWS, respond

        body = np.empty((BODY_ROWS, distance.size))
        respond(
            self.update,
            self.outputs,
            self.vector,
            self.lanes,
            self.grid,
            self.wheel_x,
            distance,
            ground,
            body,
        )
        return body


def equilibrium(vehicle: Vehicle, inputs: FloatArray) -> FloatArray:
    """Return the seven displacements at rest under constant inputs of shape (6,)."""
    return np.asarray(np.linalg.solve(vehicle.stiffness(), vehicle.forcing() @ inputs))


def state_space(vehicle: Vehicle) -> tuple[FloatArray, FloatArray]:
    """Return A, shape (14, 14), and B, shape (14, 6), of x' = A·x + B·u, x = (q, q')."""
    inverse = 1.0 / vehicle.masses()[:, None]
    a = np.zeros((2 * FREEDOMS, 2 * FREEDOMS))
    a[:FREEDOMS, FREEDOMS:] = np.eye(FREEDOMS)
    a[FREEDOMS:, :FREEDOMS] = -inverse * vehicle.stiffness()
    a[FREEDOMS:, FREEDOMS:] = -inverse * vehicle.damping()
    b = np.zeros((2 * FREEDOMS, INPUTS))
    b[FREEDOMS:] = inverse * vehicle.forcing()
    return a, b


def bilinear(vehicle: Vehicle, step_s: float) -> tuple[FloatArray, FloatArray]:
    """Return the kernel's matrices ``update``, (22, 16), and ``outputs``, (22, 4), for a step."""
    a, b = state_space(vehicle)
    half = step_s / 2 * a
    implicit = np.eye(half.shape[0]) - half
    size = half.shape[0]
    update = np.zeros((STATES + INPUTS, STATES))
    update[:size, :size] = np.linalg.solve(implicit, np.eye(size) + half).T
    update[STATES:, :size] = np.linalg.solve(implicit, step_s / 2 * b).T
    outputs = np.zeros((STATES + INPUTS, 4))
    outputs[:size, :3] = a[FREEDOMS : FREEDOMS + 3].T
    outputs[STATES:, :3] = b[FREEDOMS : FREEDOMS + 3].T
    return update, outputs


def under_wheels(vehicle: Vehicle, road: Road) -> FloatArray:
    """Return the road as each tyre feels it, shape (4, m), in m.

    Linear in y between the wheel paths, averaged over the tyre's envelope.
    """
    x = road.distance_m
    rows = [road.across(x, np.full(x.size, y)) for _, y in vehicle.wheels()]
    return np.stack([enveloped(row, road.spacing_m) for row in rows])


def enveloped(elevation: FloatArray, spacing_m: float) -> FloatArray:
    """Return the centred moving average over `ENVELOPE_M`, shape and unit as given."""
    side = max(0, round((ENVELOPE_M / spacing_m - 1) / 2))
    padded = np.concatenate([[0.0], np.pad(elevation, side, mode="edge")])
    sums = np.cumsum(padded)
    count = 2 * side + 1
    return np.asarray((sums[count:] - sums[:-count]) / count)


def grid_of(road: Road) -> FloatArray:
    """Return the start of a road's grid in m and its points per m, as kernels take it."""
    return np.array([road.start_m, 1.0 / road.spacing_m])
