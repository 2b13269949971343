"""The body on its springs: rows of bounce and pitch of a half car, and their derivatives."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array

from floatref.estimators.road_slope.constants import Places
from floatref.estimators.road_slope.jolts import jolts, sharpen
from floatref.estimators.road_slope.layout import SHARES, Layout, triples
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.sparse.pattern import Part, Pattern, in_common
from floatref.values.arrays import FloatArray

STIFFNESSES = ("log_front", "log_rear")
MEANS = np.array(SHARES)
BOTH = ("centre", *STIFFNESSES, "log_front_damping", "log_rear_damping")
"""The constants of the vehicle that are in both rows."""


class Push(NamedTuple):
    """What the springs of one axle do at the middles; all per mass of the body.

    Attributes:
        operator: K⟨·⟩ + C d⟨·⟩/dt as shares of three nodes, from compression to push.
        pulls: what each of `HalfCar.of_road` has in it, shape (4,).
        stiff, damped: parts of φ by K and by C, in m/s².
        ahead_m: d, the axle ahead of the accelerometer.
    """

    operator: FloatArray
    pulls: FloatArray
    stiff: FloatArray
    damped: FloatArray
    ahead_m: float

    @property
    def total(self) -> FloatArray:
        """φ in m/s²."""
        return self.stiff + self.damped


class Turn(NamedTuple):
    """What pitches the body.

    Attributes:
        by_front, by_rear: what the pushes of both axles are multiplied by, in 1/m.
        moment: M.
        softness: parts of front and rear springs in the body's softness in pitch, shape (2,).
        driven: what M is multiplied by, in m/s².
    """

    by_front: float
    by_rear: float
    moment: float
    softness: FloatArray
    driven: FloatArray


class HalfCar:
    """Operators of bounce and pitch over one stretch, that do not change from pass to pass."""

    def __init__(
        self,
        readings: Readings,
        places: Places,
        layout: Layout,
        wheels: tuple[csr_array, csr_array],
    ) -> None:
        """Take ``wheels``, matrices of the road under the front and the rear axle."""
        self.layout, self.places, self.wheels = layout, places, wheels
        at, step, nodes = readings.middles, readings.interval_s, layout.nodes
        self.rates = np.array([-0.5 / step, 0.0, 0.5 / step])
        self.seconds = np.array([1.0, -2.0, 1.0]) / step**2
        self.mean, self.rate, self.second = (
            triples(at, nodes, each.tolist()) for each in (MEANS, self.rates, self.seconds)
        )
        self.slope = (wheels[0] - wheels[1]) / places.wheelbase_m
        self.along = sharpen(readings, self.mean, self.second)
        self.jolts = jolts(readings)[at]
        self.grades = np.array([1.0, 0.0, -1.0, 0.0]) / places.wheelbase_m
        self._lay_out()

    def _lay_out(self) -> None:
        """Find where the derivatives have values; those of the road have four parts.

        They are the means and rates of the road under the front axle, and under the rear one.
        """
        lay, mean = self.layout, self.mean
        parts = [each @ wheels for wheels in self.wheels for each in (mean, self.rate)]
        under, self.of_road = in_common(*parts)
        body = [(lay.in_time(name), mean) for name in ("height", "pitch", "offset")]
        shared: list[Part] = [(lay.elevation, under), *body, *BOTH]
        heave, nod, moment = ((lay.in_time(name), mean) for name in ("heave", "nod", "moment"))
        self.of_bounce = Pattern(lay, *shared, heave)
        self.of_pitch = Pattern(lay, *shared, nod, moment, "gain", "log_gyration")

    def bounce(self, y: FloatArray) -> tuple[csr_array, FloatArray]:
        """Return derivatives and value of the row of bounce at the unknowns ``y``, in m/s²."""
        front, rear = self._pushes(y)
        centre, both = self._centre(y), front.operator + rear.operator
        levers = front.ahead_m * front.operator + rear.ahead_m * rear.operator
        derivative = self.of_bounce.fill(
            -(front.pulls + rear.pulls) @ self.of_road,
            self._each(self.seconds + both),
            self._each(centre * self.seconds + levers),
            self._each(-both),
            -self.places.wheelbase_m * (self.second @ y[self.layout.pitch]),
            -front.stiff,
            -rear.stiff,
            -front.damped,
            -rear.damped,
            self._each(-self.seconds),
        )
        return derivative, self._bounce(y, (front, rear))

    def pitch(self, y: FloatArray, gravity: float) -> tuple[csr_array, FloatArray]:
        """Return derivatives and value of the row of pitch at the unknowns ``y``, in rad/s²."""
        front, rear = self._pushes(y)
        turn, gain = self._turn(y, gravity), y[self.layout.place("gain")]
        pulls = turn.by_front * front.operator, turn.by_rear * rear.operator
        on_road = turn.by_front * front.pulls + turn.by_rear * rear.pulls
        driven, grades = turn.moment * turn.driven, self.grades * gravity * turn.moment
        sprung = turn.by_front * front.total + turn.by_rear * rear.total
        derivative = self.of_pitch.fill(
            -(on_road + grades) @ self.of_road,
            self._each(pulls[0] + pulls[1]),
            self._each(self.seconds + front.ahead_m * pulls[0] + rear.ahead_m * pulls[1]),
            self._each(-pulls[0] - pulls[1]),
            -(turn.by_front - turn.by_rear) * (front.total + rear.total),
            -turn.by_front * front.stiff - turn.softness[0] * driven,
            -turn.by_rear * rear.stiff - turn.softness[1] * driven,
            -turn.by_front * front.damped,
            -turn.by_rear * rear.damped,
            self._each(-self.seconds),
            self._each(-turn.moment * MEANS),
            -driven / gain,
            2.0 * (sprung + driven),
        )
        return derivative, self._pitch(y, (front, rear), turn)

    def values(self, y: FloatArray, gravity: float) -> tuple[FloatArray, FloatArray]:
        """Return the values of both rows alone, which takes a fifth of the time."""
        pushes = self._pushes(y)
        return self._bounce(y, pushes), self._pitch(y, pushes, self._turn(y, gravity))

    def _bounce(self, y: FloatArray, pushes: tuple[Push, Push]) -> FloatArray:
        lay, (front, rear) = self.layout, pushes
        swung = y[lay.height] - y[lay.in_time("heave")] + self._centre(y) * y[lay.pitch]
        found: FloatArray = self.second @ swung - front.total - rear.total
        return found

    def _pitch(self, y: FloatArray, pushes: tuple[Push, Push], turn: Turn) -> FloatArray:
        lay, (front, rear) = self.layout, pushes
        sprung = turn.by_front * front.total + turn.by_rear * rear.total
        swung = self.second @ (y[lay.pitch] - y[lay.in_time("nod")])
        found: FloatArray = swung - sprung - turn.moment * turn.driven
        return found

    def _each(self, shares: FloatArray) -> FloatArray:
        """Return ``shares`` of three nodes for each middle."""
        return np.tile(shares, self.along.size)

    def _centre(self, y: FloatArray) -> float:
        """Return c, in m."""
        front_m = self.places.lever_m + self.places.front_m
        return float(front_m - y[self.layout.place("centre")] * self.places.wheelbase_m)

    def _turn(self, y: FloatArray, gravity: float) -> Turn:
        """Return what pitches the body at ``y``."""
        lay, length = self.layout, self.places.wheelbase_m
        at_h, soft = y[lay.place("centre")], np.exp(-y[[lay.place(name) for name in STIFFNESSES]])
        radius, total = 0.5 * length * np.exp(y[lay.place("log_gyration")]), soft.sum()
        by_front, by_rear = at_h * length / radius**2, -(1.0 - at_h) * length / radius**2
        moment = y[lay.place("gain")] * length**2 / (radius**2 * total)
        tilt = gravity * (self.slope @ y[lay.elevation]) + y[lay.in_time("moment")]
        return Turn(by_front, by_rear, moment, soft / total, self.along + self.mean @ tilt)

    def _pushes(self, y: FloatArray) -> tuple[Push, Push]:
        """Return what the springs of the front and of the rear axle do at ``y``."""
        return self._push(y, 0, self.places.front_m), self._push(y, 1, self.places.rear_m)

    def _push(self, y: FloatArray, axle: int, place_m: float) -> Push:
        """Return what the springs of the ``axle``, 0 in front and 1 behind, do."""
        lay, name, ahead_m = self.layout, STIFFNESSES[axle], self.places.lever_m + place_m
        stiffness, damping = np.exp([y[lay.place(name)], y[lay.place(f"{name}_damping")]])
        body = y[lay.height] + ahead_m * y[lay.pitch] - y[lay.in_time("offset")]
        pressed = self.wheels[axle] @ y[lay.elevation] - body
        pulls = np.zeros(4)
        pulls[2 * axle : 2 * axle + 2] = stiffness, damping
        operator = stiffness * MEANS + damping * self.rates
        stiff, damped = stiffness * (self.mean @ pressed), damping * (self.rate @ pressed)
        return Push(operator, pulls, stiff, damped, ahead_m)
