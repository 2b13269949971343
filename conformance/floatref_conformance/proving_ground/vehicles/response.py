"""The vehicle's response to the road and to acceleration, sampled by the trapezoidal rule.

M·q'' + C·q' + K·q = F·u + D·u', with the inputs u of `Suspended.forcing`. The states are q and
w = q' − M⁻¹·D·u: they need no derivative of the road, and w is q' where no tyre has a damper. For a
constant linear system the trapezoidal rule is the bilinear transform
x⁺ = (I − hA/2)⁻¹((I + hA/2)·x + (h/2)·B·(u + u⁺)); position, velocity and acceleration then obey
the rule exactly, sample by sample. What the corners add to the linear forces, if anything, enters
as further inputs.
"""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray, IndexArray
from floatref_conformance.proving_ground.roads.road import Road
from floatref_conformance.proving_ground.vehicles.corner_forces import SLIDE_M, Corners
from floatref_conformance.proving_ground.vehicles.suspended import TYRES, Suspended

LOWEST_RATE_HZ = 8000.0
"""The model is stepped at least this often, at a whole multiple of the recording's rate."""
ENVELOPE_M = 0.25
"""Length over which a tyre averages the road, in m."""
STATES, INPUTS = 16, 6
NONE: IndexArray = np.empty(0, dtype=np.int64)
NOWHERE: FloatArray = np.empty((0, STATES + INPUTS))


def count_steps(rate_hz: float) -> int:
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
        pose: places of heave, pitch, roll and their rates in ``vector``, shape (6,).
        corners: what is not linear there; None: the vehicle is linear.
    """

    update: FloatArray
    outputs: FloatArray
    vector: FloatArray
    lanes: FloatArray
    grid: FloatArray
    wheel_x: FloatArray
    pose: IndexArray
    corners: Corners | None = None

    @classmethod
    def of(cls, vehicle: Suspended, road: Road, step_s: float, ground: FloatArray) -> "Response":
        """Return ``vehicle`` at rest on its springs at distance 0 of ``road``.

        ``step_s`` is the model's step in s, ``ground`` the longitudinal and lateral specific
        force at the start, shape (2,), in m/s².
        """
        lanes = under_wheels(vehicle, road)
        wheel_x = np.zeros(TYRES)
        wheel_x[: len(vehicle.contacts())] = [x for x, _ in vehicle.contacts()]
        index = (wheel_x - road.start_m) / road.spacing_m
        points = np.arange(road.points, dtype=np.float64)
        start = [np.interp(i, points, lane) for i, lane in zip(index, lanes, strict=True)]
        inputs = np.array([*start, *ground])
        update, outputs = bilinear(vehicle, step_s)
        vector = np.zeros(STATES + INPUTS)
        at_rest = equilibrium(vehicle, inputs)
        vector[: at_rest.size] = at_rest
        vector[at_rest.size : 2 * at_rest.size] = -step_response(vehicle) @ inputs[:TYRES]
        vector[STATES:] = inputs
        corners = corners_of(vehicle, step_s, at_rest)
        grid, pose = grid_of(road), places(vehicle)
        return cls(update, outputs, vector, lanes, grid, wheel_x, pose, corners)

    def advance(
        self,
        distance: FloatArray,
        ground: FloatArray,
        steps: IndexArray = NONE,
        states: FloatArray = NOWHERE,
    ) -> FloatArray:
        """Return the body's motion at every step of the next stretch.

        Args:
            distance: at every step, shape (n,), in m.
            ground: specific force of the ground, shape (2, n), in m/s².
            steps: rising steps of the stretch whose states are kept, shape (m,).
            states: written, states and inputs after these steps, shape (m, 22).

        Returns:
            Heave, pitch, roll and their first and second derivatives, shape (9, n).
        """
        from floatref_conformance.proving_ground.vehicles.response_kernels import (
            BODY_ROWS,
            respond,
            respond_with_corners,
        )

        body = np.empty((BODY_ROWS, distance.size))
        own = self.update, self.outputs, self.vector, self.lanes, self.grid, self.wheel_x
        stretch = distance, ground, self.pose, body, steps, states
        if self.corners is None:
            respond(*own, *stretch)
        else:
            respond_with_corners(*own, *stretch, self.corners)
        return body


def equilibrium(vehicle: Suspended, inputs: FloatArray) -> FloatArray:
    """Return the freedoms at rest under constant inputs of shape (6,), shape (n,)."""
    return vehicle.at_rest(vehicle.forcing() @ inputs)


def step_response(vehicle: Suspended) -> FloatArray:
    """Return M⁻¹·D, by which a step of the road changes the freedoms' rates, shape (n, 4)."""
    return vehicle.tyre_damping() / vehicle.masses()[:, None]


def places(vehicle: Suspended) -> IndexArray:
    """Return where heave, pitch, roll and their rates stand among the kernel's states.

    What the body does not do stands at the last state, which a model of seven freedoms leaves 0.
    """
    size = vehicle.masses().size
    known = [*vehicle.pose, *(None if p is None else size + p for p in vehicle.pose)]
    return np.array([STATES - 1 if p is None else p for p in known], dtype=np.int64)


def state_space(vehicle: Suspended) -> tuple[FloatArray, FloatArray]:
    """Return A, shape (2n, 2n), and B, shape (2n, 6), of x' = A·x + B·u, x = (q, w)."""
    inverse = 1.0 / vehicle.masses()[:, None]
    size = inverse.size
    a = np.zeros((2 * size, 2 * size))
    a[:size, size:] = np.eye(size)
    a[size:, :size] = -inverse * vehicle.stiffness()
    a[size:, size:] = -inverse * vehicle.damping()
    b = np.zeros((2 * size, INPUTS))
    b[:size, :TYRES] = step_response(vehicle)
    b[size:] = inverse * vehicle.forcing()
    b[size:, :TYRES] += a[size:, size:] @ b[:size, :TYRES]
    return a, b


def bilinear(vehicle: Suspended, step_s: float) -> tuple[FloatArray, FloatArray]:
    """Return the kernel's matrices ``update``, (22, 16), and ``outputs``, (22, 4), for a step."""
    a, b = state_space(vehicle)
    half = step_s / 2 * a
    implicit = np.eye(half.shape[0]) - half
    size = half.shape[0]
    update = np.zeros((STATES + INPUTS, STATES))
    update[:size, :size] = np.linalg.solve(implicit, np.eye(size) + half).T
    update[STATES:, :size] = np.linalg.solve(implicit, step_s / 2 * b).T
    outputs = np.zeros((STATES + INPUTS, 4))
    for column, freedom in enumerate(vehicle.pose):
        if freedom is not None:
            outputs[:size, column] = a[size // 2 + freedom]
            outputs[STATES:, column] = b[size // 2 + freedom]
    return update, outputs


def corners_of(vehicle: Suspended, step_s: float, at_rest: FloatArray) -> Corners | None:
    """Return the kernel's corners for a step, at rest at ``at_rest``; None: all is linear.

    A force g at the corners adds −M⁻¹·Rᵀ·g to w'; the rule then makes it
    (I − hA/2)⁻¹·(h/2)·B·(g + g⁺) of the states. Friction begins at 0.
    """
    found = vehicle.corner_forces()
    if found is None:
        return None
    a, _ = state_space(vehicle)
    size, wheels = at_rest.size, len(found.rows)
    pull = -found.rows.T / vehicle.masses()[:, None]
    enters = np.linalg.solve(
        np.eye(2 * size) - step_s / 2 * a, step_s / 2 * np.vstack([0 * pull, pull])
    )
    lift = np.array([np.zeros(wheels) if p is None else pull[p] for p in vehicle.pose])
    entry = np.zeros((STATES, wheels))
    entry[: 2 * size] = enters
    travel = found.rows @ at_rest
    return Corners(
        found.rows,
        found.cubic,
        found.limit,
        SLIDE_M,
        entry,
        found.rows @ enters[:size],
        lift,
        travel,
        np.zeros(wheels),
        found.cubic * travel**3,
    )


def under_wheels(vehicle: Suspended, road: Road) -> FloatArray:
    """Return the road as each tyre feels it, shape (4, m), in m; zeros without a tyre.

    Linear in y between the wheel paths, averaged over the tyre's envelope. Tyres behind each other
    feel one road.
    """
    x = road.distance_m
    lanes = np.zeros((TYRES, x.size))
    felt: dict[float, FloatArray] = {}
    for lane, (_, y) in zip(lanes, vehicle.contacts(), strict=False):
        if y not in felt:
            felt[y] = envelope_of(road.across(x, np.full(x.size, y)), road.spacing_m)
        lane[:] = felt[y]
    return lanes


def envelope_of(elevation: FloatArray, spacing_m: float) -> FloatArray:
    """Return the centred moving average over `ENVELOPE_M`, shape and unit as given."""
    side = max(0, round((ENVELOPE_M / spacing_m - 1) / 2))
    padded = np.concatenate([[0.0], np.pad(elevation, side, mode="edge")])
    sums = np.cumsum(padded)
    count = 2 * side + 1
    return np.asarray((sums[count:] - sums[:-count]) / count)


def grid_of(road: Road) -> FloatArray:
    """Return the start of a road's grid in m and its points per m, as kernels take it."""
    return np.array([road.start_m, 1.0 / road.spacing_m])
