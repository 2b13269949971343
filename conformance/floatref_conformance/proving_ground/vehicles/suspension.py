"""What the freedoms of a vehicle truly do, on the clock of the response channels.

An accelerometer is band-limited to its recording: it delivers the mean over the interval around
its sample, which is the gain of velocity over that interval. The trapezoidal rule keeps this
exact, so the model's states are wanted at the samples and half-way between them, and no more.
"""

from dataclasses import dataclass

import numpy as np

from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.clock import UniformClock
from floatref_conformance.proving_ground.drives.drive import Longitudinal
from floatref_conformance.proving_ground.roads.alignment import LEVEL, Alignment
from floatref_conformance.proving_ground.vehicles.kinematics import Course
from floatref_conformance.proving_ground.vehicles.response import INPUTS, STATES, step_response
from floatref_conformance.proving_ground.vehicles.suspended import TYRES, Suspended


@dataclass(frozen=True, eq=False)
class SuspensionMotion:
    """Freedoms, roads and forces at every sample of ``clock``; m samples.

    Attributes:
        clock: of the response channels.
        vehicle: whose freedoms they are.
        position: of the n freedoms against rest on a road at elevation 0, shape (n, m), in m
            and rad.
        velocity: their rates, shape (n, m).
        acceleration: means over the interval around the sample, shape (n, m).
        road: as each tyre feels it, shape (4, m), in m.
        lane: specific force along, across and normal to the lane that the vehicle feels without
            its own motion on its springs, shape (3, m), in m/s².
        grade: of the road's alignment against the lane, shape (m,), uphill positive.
    """

    clock: UniformClock
    vehicle: Suspended
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    road: FloatArray
    lane: FloatArray
    grade: FloatArray

    def tilt(self) -> tuple[FloatArray, FloatArray]:
        """Return pitch and roll of the body against the lane, shapes (m,), in rad."""
        _, pitch, roll = (
            np.zeros(self.position.shape[1]) if place is None else self.position[place]
            for place in self.vehicle.pose
        )
        return pitch, roll


class Watch:
    """Keeps a model's states at every half interval of a clock while it is advanced."""

    def __init__(self, rate_hz: float, inner: UniformClock, count: int) -> None:
        """Prepare for ``count`` steps of ``inner``; the result has ``rate_hz`` in Hz."""
        self.clock = UniformClock.of(rate_hz)
        half = float(inner.rate / (2 * self.clock.rate))
        samples = int((count - 1) / (2 * half)) + 1
        self.at = np.clip((np.arange(2 * samples + 1) - 1) * half, 0.0, count - 1.0)
        self.times_s = self.at / float(inner.rate)
        before = self.at.astype(np.int64)
        between = before[self.at > before]
        if between.size:
            before = np.sort(np.concatenate([before, between + 1]))
        self.steps: IndexArray = before[np.diff(before, prepend=-1) > 0]
        self.states: FloatArray = np.empty((self.steps.size, STATES + INPUTS))

    def within(self, first: int, last: int) -> tuple[IndexArray, FloatArray]:
        """Return the steps wanted of a stretch, from its start, and where to write them."""
        part = slice(*np.searchsorted(self.steps, (first, last)))
        return self.steps[part] - first, self.states[part]

    def motion(
        self, vehicle: Suspended, course: Course, drive: Longitudinal, alignment: Alignment = LEVEL
    ) -> SuspensionMotion:
        """Return what was seen, once the whole drive is done."""
        size = vehicle.masses().size
        rows = self._rows()
        position, road = rows[:size], rows[STATES : STATES + TYRES]
        velocity = rows[size : 2 * size] + step_response(vehicle) @ road
        span = self.times_s[2::2] - self.times_s[:-2:2]
        gain = velocity[:, 2::2] - velocity[:, :-2:2]
        at_ends = drive.motion(self.times_s[::2])
        speed, distance = at_ends.speed, at_ends.distance
        along = np.diff(speed) / span
        return SuspensionMotion(
            self.clock,
            vehicle,
            position[:, 1::2],
            velocity[:, 1::2],
            gain / span,
            road[:, 1::2],
            course.lane_force((speed[1:] + speed[:-1]) / 2, along),
            alignment.grade((distance[1:] + distance[:-1]) / 2),
        )

    def _rows(self) -> FloatArray:
        """Return the states at every half interval, linear between steps, shape (22, 2m + 1)."""
        before = self.at.astype(np.int64)
        place = np.searchsorted(self.steps, before)
        rows = self.states[place]
        weight = (self.at - before)[:, None]
        if weight.any():
            after = self.states[np.minimum(place + 1, self.steps.size - 1)]
            rows += weight * (after - rows)
        return np.ascontiguousarray(rows.T)
