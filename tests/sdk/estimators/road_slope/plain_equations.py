"""docs/road-prior-slope.md in plain sums over nodes, for runs that are drawn from it."""

from typing import Any

import numpy as np

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.layout import GLOBALS, IN_TIME
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.rows import Stretch
from floatref.values.arrays import FloatArray, IndexArray


def middles(seen: Readings) -> IndexArray:
    """Return the nodes with a neighbour at Δ on both sides."""
    near = np.isclose(seen.pause_s, seen.interval_s)
    inside = range(1, near.size - 1)
    return np.array([k for k in inside if near[k] and near[k + 1]], np.int64)


def second(v: FloatArray, at: IndexArray, step: float) -> FloatArray:
    """D(v)."""
    return np.asarray((v[at - 1] - 2 * v[at] + v[at + 1]) / step**2)


def shared(v: FloatArray, at: IndexArray) -> FloatArray:
    """⟨v⟩."""
    return np.asarray((v[at - 1] + 10 * v[at] + v[at + 1]) / 12)


def rate(v: FloatArray, at: IndexArray, step: float) -> FloatArray:
    """⟨dv/dt⟩."""
    return np.asarray((v[at + 1] - v[at - 1]) / (2 * step))


def by_name(stretch: Stretch, y: FloatArray) -> dict[str, Any]:
    """Return the unknowns by the names of the layout."""
    lay = stretch.layout
    found: dict[str, Any] = {"elevation": y[lay.elevation], "slope": y[lay.slope]}
    found |= {name: y[lay.in_time(name)] for name in IN_TIME}
    return found | {name: float(y[lay.place(name)]) for name in GLOBALS}


def as_vector(stretch: Stretch, x: dict[str, Any]) -> FloatArray:
    """Return the vector of the unknowns ``x``."""
    lay, y = stretch.layout, np.empty(stretch.layout.size)
    y[lay.elevation], y[lay.slope] = x["elevation"], x["slope"]
    for name in IN_TIME:
        y[lay.in_time(name)] = x[name]
    for name in GLOBALS:
        y[lay.place(name)] = x[name]
    return y


def road_places(stretch: Stretch) -> FloatArray:
    """Return where the points of the road are, in m."""
    return stretch.first_m + stretch.model.spacing_m * np.arange(stretch.layout.points)


def passed(stretch: Stretch, values: FloatArray, ahead_m: float) -> FloatArray:
    """Return the mean of a road's ``values`` over what the nodes pass ``ahead_m`` of the laser."""
    seen = stretch.readings
    reach = seen.speed * seen.interval_s / 3
    at = (seen.place + ahead_m + part * reach for part in (-1, 0, 1))
    return np.asarray(sum(np.interp(x, road_places(stretch), values) for x in at) / 3)


def jolts(seen: Readings) -> FloatArray:
    """J."""
    K, jolt = seen.along.size, np.zeros(seen.along.size)
    for k in range(1, K):
        if np.isclose(seen.pause_s[k], seen.interval_s):
            jolt[k] = jolt[k - 1] * np.exp(-seen.interval_s / 0.5)
            jolt[k] += abs(seen.along[k] - seen.along[k - 1])
    return np.array([jolt[max(0, k - 3) : k + 4].max() for k in range(K)])


def sharp(seen: Readings, at: IndexArray) -> FloatArray:
    """Return the acceleration along the road, as sharp as the encoder allows."""
    smooth = shared(seen.along, at)
    off = second(seen.place, at, seen.interval_s) - smooth
    fast = np.abs(off[seen.speed[at] >= 0.5])
    noise = 1.4826 * np.median(fast) if fast.size else 0.0
    return np.asarray(smooth + off / (1 + (noise / 0.1) ** 2))


class Springs:
    """Bounce and pitch of a half car over a road that is known."""

    def __init__(self, stretch: Stretch, x: dict[str, Any]) -> None:
        """Take road and constants from ``x``; height and pitch are those of a call."""
        seen, places, model = stretch.readings, stretch.places, stretch.model
        self.x, self.step, self.length = x, seen.interval_s, places.wheelbase_m
        self.ahead_m = places.lever_m + places.front_m, places.lever_m + places.rear_m
        ends = places.front_m, places.rear_m
        self.under = [passed(stretch, x["elevation"], end) for end in ends]
        self.beta = (self.under[0] - self.under[1]) / self.length
        self.at = middles(seen)
        tilted = shared(model.gravity * self.beta + x["moment"], self.at)
        self.driven = sharp(seen, self.at) + tilted
        self.by_node = seen.along + model.gravity * self.beta + x["moment"]
        self.stiff = np.exp(x["log_front"]), np.exp(x["log_rear"])
        self.damped = np.exp(x["log_front_damping"]), np.exp(x["log_rear_damping"])
        self.radius = 0.5 * np.exp(x["log_gyration"]) * self.length
        self.soft = 1 / self.stiff[0] + 1 / self.stiff[1]

    def values(self, r: FloatArray, theta: FloatArray, at: IndexArray) -> FloatArray:
        """Return the rows of bounce and pitch at the middles ``at``, shape (2, m)."""
        x, H, L, step = self.x, self.x["centre"], self.length, self.step
        push = []
        for under, ahead_m, K, C in zip(
            self.under, self.ahead_m, self.stiff, self.damped, strict=True
        ):
            pressed = under - r - ahead_m * theta + x["offset"]
            push.append(K * shared(pressed, at) + C * rate(pressed, at, step))
        centre = self.ahead_m[0] - H * L
        bounce = second(r - x["heave"] + centre * theta, at, step) - push[0] - push[1]
        turning = (H * L * push[0] - (1 - H) * L * push[1]) / self.radius**2
        moment = x["gain"] * L**2 / (self.radius**2 * self.soft)
        driven = self.driven[np.searchsorted(self.at, at)]
        pitch = second(theta - x["nod"], at, step) - turning - moment * driven
        return np.array([bounce, pitch])

    def at_rest(self, k: int) -> tuple[float, float]:
        """Return height and pitch of a body that does not move at the node ``k``."""
        theta = self.beta[k] + self.x["gain"] * self.by_node[k]
        # Both springs push with nothing more than at rest on level ground.
        share = self.stiff[0] / (self.stiff[0] + self.stiff[1])
        ends = [u[k] - d * theta for u, d in zip(self.under, self.ahead_m, strict=True)]
        return share * ends[0] + (1 - share) * ends[1] + self.x["offset"][k], theta


def spring_sigmas(seen: Readings, model: SlopeModel, at: IndexArray) -> FloatArray:
    """Return 1-σ of bounce and pitch at the middles ``at``, shape (2, m)."""
    jolt, root = jolts(seen)[at], np.sqrt(seen.interval_s)
    bounce = (model.bounce + model.bounce_speed * seen.speed[at]) / root
    pitch = (model.swing + model.swing_speed * seen.speed[at]) / root
    return np.hypot([bounce, pitch], np.multiply.outer([model.jolt_bounce, model.jolt_pitch], jolt))


def height_read(stretch: Stretch, x: dict[str, Any]) -> tuple[FloatArray, FloatArray]:
    """Return what the height sensor reads at all nodes, and its 1-σ."""
    seen, model = stretch.readings, stretch.model
    slope = passed(stretch, x["slope"], 0.0)
    lever = stretch.places.lever_m - model.sway_m * slope
    between_m = np.minimum(seen.speed * seen.interval_s, model.spacing_m)
    sigma = np.sqrt(model.reading_m**2 + model.road * between_m / 3)
    return x["height"] + lever * x["pitch"] - passed(stretch, x["elevation"], 0.0), sigma


def force_read(stretch: Stretch, x: dict[str, Any]) -> tuple[FloatArray, FloatArray]:
    """Return what the accelerometer reads at the middles, and its 1-σ but for the unsure part."""
    seen, model, at = stretch.readings, stretch.model, middles(stretch.readings)
    tilt = x["pitch"] + x["lean"]
    more = shared(seen.along * tilt + model.gravity * tilt**2 / 2 - x["bias"], at)
    lost = np.max([seen.missing[at - 1], seen.missing[at], seen.missing[at + 1]], axis=0)
    square = model.acceleration**2 * (1 - lost) + model.missing_acceleration**2 * lost
    return second(x["height"], at, seen.interval_s) - more, np.sqrt(square / seen.interval_s)


def stretch_of(seen: Readings, places: Places, model: SlopeModel, **changed: Any) -> Stretch:
    """Return a stretch with some of its readings ``changed``."""
    return Stretch(Readings(**(vars(seen) | changed)), places, model)
