"""The rows of a stretch: misfits and their derivatives, all over their 1-σ."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array, diags_array, eye_array, vstack

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.layout import Layout, between_points, triples
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.swinging import SMALL, Swing
from floatref.values.arrays import FloatArray

SIXTHS = (1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)
"""Shares of three nodes in the mean of what is linear in between, under three boxes."""


class Rows(NamedTuple):
    """Derivatives of the predictions, shape (m, unknowns), and misfits, both over their 1-σ."""

    derivative: csr_array
    misfit: FloatArray


class Stretch:
    """Operators of one stretch that do not change from pass to pass."""

    def __init__(self, readings: Readings, places: Places, model: SlopeModel) -> None:
        """Lay the road's points under the laser and both axles."""
        self.readings, self.places, self.model = readings, places, model
        x, front, rear = readings.place, places.front_m, places.rear_m
        under = np.concatenate((x, x + front, x + rear))
        self.first_m = float(under.min()) - 1.0
        points = int(np.ceil((under.max() + 1.0 - self.first_m) / model.spacing_m)) + 2
        self.layout = Layout(points, x.size)
        grid = self.first_m, model.spacing_m, points
        self.under_laser = between_points(x, *grid)
        under_front, under_rear = (between_points(x + end, *grid) for end in (front, rear))
        self.slope = (under_front - under_rear) / places.wheelbase_m
        ahead = -(places.lever_m + rear) / places.wheelbase_m
        self.line = (1.0 - ahead) * under_rear + ahead * under_front
        self.middles = readings.middles
        self.rate = _rate(readings)
        self.fixed, self.target, self.fixed_sigma = _fixed_rows(self)

    def start(self) -> FloatArray:
        """Return the unknowns before the first pass."""
        found, model, place = np.zeros(self.layout.size), self.model, self.layout.place
        found[place("gain")], found[place("lean")] = model.gain, model.lean_rad
        found[place("centre")] = model.centre
        found[place("log_hz")], found[place("log_damping")] = np.log([model.hz, model.damping])
        return found

    def rows(self, y: FloatArray, bends: FloatArray) -> Rows:
        """Return all rows at the unknowns ``y``, with the intensities ``bends`` of the slope."""
        sigma = self.fixed_sigma.copy()
        sigma[-bends.size :] = np.sqrt(bends * self.model.spacing_m)
        fixed = _over(self.fixed, self.target - self.fixed @ y, sigma)
        parts = fixed, *self._curved(y)
        derivative = vstack([part.derivative for part in parts], format="csr")
        return Rows(derivative, np.concatenate([part.misfit for part in parts]))

    def misfit(self, y: FloatArray, bends: FloatArray) -> float:
        """Return the sum of the squared misfits."""
        misfit = self.rows(y, bends).misfit
        return float(misfit @ misfit)

    def _curved(self, y: FloatArray) -> tuple[Rows, Rows, Rows]:
        return _acceleration(self, y), _swing(self, y), _even(self, y)


def _over(derivative: csr_array, misfit: FloatArray, sigma: FloatArray) -> Rows:
    return Rows(diags_array(1.0 / sigma) @ derivative, misfit / sigma)


def _rate(readings: Readings) -> csr_array:
    """Return the matrix of rates over time, one-sided at the ends of each piece, in 1/s."""
    near = readings.pause_s < 1.5 * readings.interval_s
    nodes = np.arange(near.size)
    before = np.where(near & (nodes > 0), nodes - 1, nodes)
    behind = np.where(np.append(near[1:], False), nodes + 1, nodes)
    steps = np.maximum(behind - before, 1) * readings.interval_s
    values = np.concatenate((-1.0 / steps, 1.0 / steps))
    columns = np.concatenate((before, behind))
    return csr_array((values, (np.tile(nodes, 2), columns)), (near.size, near.size))


def _fixed_rows(stretch: Stretch) -> tuple[csr_array, FloatArray, FloatArray]:
    """Return the rows that are linear: height, bias, priors and road; the slope's steps last."""
    lay, model, seen = stretch.layout, stretch.model, stretch.readings
    known, nodes = ~np.isnan(seen.height), eye_array(lay.nodes, format="csr")
    under = -stretch.under_laser
    lever = stretch.places.lever_m * nodes
    height = lay.rows((lay.height, nodes), (lay.pitch, lever), (lay.elevation, under))[known]
    between_m = np.minimum(seen.speed * seen.interval_s, model.spacing_m)
    of_height = np.sqrt(model.reading_m**2 + model.road * between_m / 3.0)
    steady, walked = np.zeros(lay.nodes - 1), model.walk * np.sqrt(seen.pause_s[1:])
    bias = lay.rows((lay.bias, _steps(lay.nodes)))
    parts = (
        (height, seen.height[known], of_height[known]),
        (bias, steady, walked),
        *_priors(stretch),
        *_road(lay, model),
    )
    matrices, targets, sigmas = zip(*parts, strict=True)
    found: csr_array = vstack(matrices, format="csr")
    return found, np.concatenate(targets), np.concatenate(sigmas)


def _priors(stretch: Stretch) -> list[tuple[csr_array, FloatArray, FloatArray]]:
    """Return a row for each of `GLOBALS`, for the first bias and for the road's first point."""
    lay, model = stretch.layout, stretch.model
    spread = {
        lay.bias.start: (0.0, model.bias),
        lay.elevation.start: (0.0, model.start_m),
        lay.place("gain"): (model.gain, model.gain_sigma),
        lay.place("lean"): (model.lean_rad, model.lean_sigma_rad),
        lay.place("centre"): (model.centre, model.centre_sigma),
        lay.place("offset"): (0.0, model.offset_m),
        lay.place("log_hz"): (np.log(model.hz), model.hz_sigma),
        lay.place("log_damping"): (np.log(model.damping), model.damping_sigma),
    }
    means, sigmas = np.array(list(spread.values())).T
    shape = len(spread), lay.size
    rows = csr_array((np.ones(len(spread)), (np.arange(len(spread)), list(spread))), shape)
    return [(rows, means, sigmas)]


def _road(lay: Layout, model: SlopeModel) -> list[tuple[csr_array, FloatArray, FloatArray]]:
    """Return the rows of the road; the 1-σ of the slope's steps is that of the pass."""
    steps, spacing = _steps(lay.points), model.spacing_m
    along = -spacing * eye_array(lay.points - 1, lay.points, format="csr")
    points = eye_array(lay.points, format="csr")
    mean = model.slope * np.sqrt(model.slope_reach_m / spacing)
    rows = (
        (lay.rows((lay.elevation, steps), (lay.slope, along)), np.sqrt(model.road * spacing)),
        (lay.rows((lay.slope, points)), mean),
        (lay.rows((lay.slope, steps)), 1.0),
    )
    return [(m, np.zeros(m.shape[0]), np.full(m.shape[0], sigma)) for m, sigma in rows]


def _steps(count: int) -> csr_array:
    shape = count - 1, count
    return csr_array(eye_array(*shape, k=1, format="csr") - eye_array(*shape, format="csr"))


def _acceleration(stretch: Stretch, y: FloatArray) -> Rows:
    """Return the second difference of the height against the force on a tilted axis."""
    lay, model, seen = stretch.layout, stretch.model, stretch.readings
    at, g, h = stretch.middles, model.gravity, seen.interval_s
    tilt = y[lay.pitch] + y[lay.place("lean")]
    level = seen.along * tilt + 0.5 * g * tilt**2 - y[lay.bias]
    shares = triples(at, lay.nodes, SIXTHS)
    second = triples(at, lay.nodes, (1.0 / h**2, -2.0 / h**2, 1.0 / h**2))
    by_tilt = seen.along + g * tilt
    derivative = lay.rows(
        (lay.height, second),
        (lay.pitch, -(shares @ diags_array(by_tilt))),
        ("lean", -(shares @ by_tilt)),
        (lay.bias, shares),
    )
    missing = np.max([seen.missing[at + side] for side in (-1, 0, 1)], axis=0)
    squares = np.square([model.acceleration, model.missing_acceleration])
    noise = (squares[0] + missing * (squares[1] - squares[0])) / h
    sigma = np.sqrt(noise + np.square(model.force_share * seen.force[at]))
    misfit = seen.force[at] + shares @ level - second @ y[lay.height]
    return _over(derivative, misfit, sigma)


def _swing(stretch: Stretch, y: FloatArray) -> Rows:
    """Return what moves the body beside the road under it and the acceleration along it."""
    lay, model, seen = stretch.layout, stretch.model, stretch.readings
    at, pitch, gain = stretch.middles, y[lay.pitch], y[lay.place("gain")]
    z, logs = y[lay.elevation], (y[lay.place("log_hz")], y[lay.place("log_damping")])
    slope, rate = stretch.slope @ z, stretch.rate @ (stretch.slope @ z)
    climb = 1.0 + gain * model.gravity

    def excess(log_hz: float, log_damping: float) -> FloatArray:
        swing = Swing.of(log_hz, log_damping, seen.interval_s)
        u = climb * slope + swing.lag_s * rate + gain * seen.along
        return swing.excess(pitch, u, at)

    swing = Swing.of(*logs, seen.interval_s)
    free, driven = (triples(at, lay.nodes, each) for each in (swing.free, swing.driven))
    over_road = climb * stretch.slope + swing.lag_s * (stretch.rate @ stretch.slope)
    by_hz, by_damping = (
        (excess(*(np.add(logs, step))) - excess(*np.subtract(logs, step))) / (2.0 * SMALL)
        for step in SMALL * np.eye(2)
    )
    derivative = lay.rows(
        (lay.pitch, free),
        (lay.elevation, -(driven @ over_road)),
        ("gain", -(driven @ (seen.along + model.gravity * slope))),
        ("log_hz", -by_hz),
        ("log_damping", -by_damping),
    )
    density = model.swing + model.swing_speed * seen.speed[at]
    return _over(derivative, excess(*logs), density * seen.interval_s**1.5)


def _even(stretch: Stretch, y: FloatArray) -> Rows:
    """Return the height over the line through both axles, less that of a lever on springs."""
    lay, model, places = stretch.layout, stretch.model, stretch.places
    centre, z = y[lay.place("centre")], y[lay.elevation]
    lever = -places.lever_m - places.front_m + centre * places.wheelbase_m
    swung = y[lay.pitch] - stretch.slope @ z
    nodes = eye_array(lay.nodes, format="csr")
    derivative = lay.rows(
        (lay.height, nodes),
        (lay.pitch, -lever * nodes),
        (lay.elevation, lever * stretch.slope - stretch.line),
        ("centre", -places.wheelbase_m * swung),
        ("offset", -np.ones(lay.nodes)),
    )
    resting = stretch.line @ z + lever * swung + y[lay.place("offset")]
    sigma = model.even_m + model.even_speed * stretch.readings.speed
    scaled = sigma * np.sqrt(model.bounce_s / stretch.readings.interval_s)
    return _over(derivative, resting - y[lay.height], scaled)
