"""The body on its springs: rows of bounce and pitch of a half car, and their derivatives."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array

from floatref.estimators.road_slope.constants import Places
from floatref.estimators.road_slope.jolts import jolts, sharpen
from floatref.estimators.road_slope.layout import SHARES, Layout, triples
from floatref.estimators.road_slope.readings import Readings
from floatref.values.arrays import FloatArray

Parts = list[tuple[slice | str, csr_array | FloatArray]]


class Push(NamedTuple):
    """What the springs of one axle do at the middles; all per mass of the body.

    Attributes:
        operator: K⟨·⟩ + C d⟨·⟩/dt, from compression at the nodes to push.
        stiff, damped: parts of φ by K and by C, in m/s².
        wheels: matrix of the road under the axle.
        ahead_m: d, the axle ahead of the accelerometer.
    """

    operator: csr_array
    stiff: FloatArray
    damped: FloatArray
    wheels: csr_array
    ahead_m: float

    @property
    def total(self) -> FloatArray:
        """φ in m/s²."""
        return self.stiff + self.damped


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
        self.mean = triples(at, nodes, SHARES)
        self.rate = triples(at, nodes, (-0.5 / step, 0.0, 0.5 / step))
        self.second = triples(at, nodes, (step**-2.0, -2.0 * step**-2.0, step**-2.0))
        self.slope = (wheels[0] - wheels[1]) / places.wheelbase_m
        self.along = sharpen(readings, self.mean, self.second)
        self.jolts = jolts(readings)[at]

    def bounce(self, y: FloatArray) -> tuple[csr_array, FloatArray]:
        """Return derivatives and value of the row of bounce at the unknowns ``y``, in m/s²."""
        lay, front, rear = self.layout, self._push(y, front=True), self._push(y, front=False)
        length, swung = self.places.wheelbase_m, self.second @ y[lay.pitch]
        centre = front.ahead_m - y[lay.place("centre")] * length
        value = self.second @ (y[lay.height] - y[lay.in_time("heave")]) + centre * swung
        both = front.operator + rear.operator
        levers = front.ahead_m * front.operator + rear.ahead_m * rear.operator
        parts: Parts = [
            (lay.elevation, -(front.operator @ front.wheels + rear.operator @ rear.wheels)),
            (lay.height, self.second + both),
            (lay.pitch, centre * self.second + levers),
            (lay.in_time("heave"), -self.second),
            (lay.in_time("offset"), -both),
            ("centre", -length * swung),
            ("log_front", -front.stiff),
            ("log_rear", -rear.stiff),
            ("log_front_damping", -front.damped),
            ("log_rear_damping", -rear.damped),
        ]
        return lay.rows(*parts), value - front.total - rear.total

    def pitch(self, y: FloatArray, gravity: float) -> tuple[csr_array, FloatArray]:
        """Return derivatives and value of the row of pitch at the unknowns ``y``, in rad/s²."""
        lay, front, rear = self.layout, self._push(y, front=True), self._push(y, front=False)
        length, at_h = self.places.wheelbase_m, y[lay.place("centre")]
        radius = 0.5 * length * np.exp(y[lay.place("log_gyration")])
        by_front, by_rear = at_h * length / radius**2, -(1.0 - at_h) * length / radius**2
        moment, softness = self._moment(y, radius)
        tilted = self.mean @ (gravity * (self.slope @ y[lay.elevation]) + y[lay.in_time("moment")])
        driven = self.along + tilted
        sprung = by_front * front.total + by_rear * rear.total
        pulls = by_front * front.operator, by_rear * rear.operator
        value = self.second @ (y[lay.pitch] - y[lay.in_time("nod")]) - sprung - moment * driven
        over_road = pulls[0] @ front.wheels + pulls[1] @ rear.wheels
        levers = front.ahead_m * pulls[0] + rear.ahead_m * pulls[1]
        parts: Parts = [
            (lay.elevation, -over_road - moment * gravity * (self.mean @ self.slope)),
            (lay.height, pulls[0] + pulls[1]),
            (lay.pitch, self.second + levers),
            (lay.in_time("nod"), -self.second),
            (lay.in_time("offset"), -pulls[0] - pulls[1]),
            (lay.in_time("moment"), -moment * self.mean),
            ("gain", -moment / y[lay.place("gain")] * driven),
            ("centre", -length / radius**2 * (front.total + rear.total)),
            ("log_front", -by_front * front.stiff - softness[0] * moment * driven),
            ("log_rear", -by_rear * rear.stiff - softness[1] * moment * driven),
            ("log_front_damping", -by_front * front.damped),
            ("log_rear_damping", -by_rear * rear.damped),
            ("log_gyration", 2.0 * (sprung + moment * driven)),
        ]
        return lay.rows(*parts), value

    def _moment(self, y: FloatArray, radius: float) -> tuple[float, tuple[float, float]]:
        """Return M, and the parts of front and rear springs in the body's softness in pitch."""
        place = self.layout.place
        soft = np.exp([-y[place("log_front")], -y[place("log_rear")]])
        total = float(soft.sum())
        moment = float(y[place("gain")]) * self.places.wheelbase_m**2 / (radius**2 * total)
        return moment, (float(soft[0]) / total, float(soft[1]) / total)

    def _push(self, y: FloatArray, front: bool) -> Push:
        """Return what the springs of the ``front`` or of the rear axle do at ``y``."""
        lay, places, name = self.layout, self.places, "log_front" if front else "log_rear"
        wheels = self.wheels[0 if front else 1]
        ahead_m = places.lever_m + (places.front_m if front else places.rear_m)
        stiffness = np.exp(y[lay.place(name)])
        damping = np.exp(y[lay.place(f"{name}_damping")])
        body = y[lay.height] + ahead_m * y[lay.pitch] - y[lay.in_time("offset")]
        pressed = wheels @ y[lay.elevation] - body
        return Push(
            stiffness * self.mean + damping * self.rate,
            stiffness * (self.mean @ pressed),
            damping * (self.rate @ pressed),
            wheels,
            ahead_m,
        )
