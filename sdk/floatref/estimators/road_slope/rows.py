"""The rows of a stretch: misfits and their derivatives, all over their 1-σ."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array, diags_array, eye_array, vstack

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.layout import GLOBALS, Layout, between_points
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.springs import HalfCar
from floatref.values.arrays import FloatArray

Fixed = list[tuple[csr_array, FloatArray, FloatArray]]
"""Rows with their targets and 1-σ."""


class Rows(NamedTuple):
    """Derivatives of the predictions, shape (m, unknowns), and misfits, both over their 1-σ."""

    derivative: csr_array
    misfit: FloatArray


class Weights(NamedTuple):
    """What is held while a pass finds the unknowns.

    Attributes:
        bends: intensity of every step of the slope, in 1/m, shape (points - 1,).
        sagged: steps of the offset from node to node in m, shape (nodes - 1,).
        turned: change of the slope under the wheels from node to node, shape (nodes - 1,).
        loose: factor of the 1-σ of bounce and pitch.
    """

    bends: FloatArray
    sagged: FloatArray
    turned: FloatArray
    loose: float = 1.0


class Stretch:
    """Operators of one stretch that do not change from pass to pass."""

    def __init__(self, readings: Readings, places: Places, model: SlopeModel) -> None:
        """Lay the road's points under the laser and both axles."""
        self.readings, self.places, self.model = readings, places, model
        ends = 0.0, places.front_m, places.rear_m
        under = np.concatenate([readings.place + end for end in ends])
        self.first_m = float(under.min()) - 1.0
        points = int(np.ceil((under.max() + 1.0 - self.first_m) / model.spacing_m)) + 2
        self.layout = Layout(points, readings.place.size)
        self.under_laser, front, rear = (self._passed_over(end) for end in ends)
        self.car = HalfCar(readings, places, self.layout, (front, rear))
        self.slope = self.car.slope
        self.rested = readings.rested(model.rest_s)
        self.fixed, self.target, self.fixed_sigma = _fixed_rows(self)

    def start(self) -> FloatArray:
        """Return the unknowns before the first pass."""
        found = np.zeros(self.layout.size)
        for name, mean in self.model.means.items():
            found[self.layout.place(name)] = mean
        return found

    def rows(self, y: FloatArray, held: Weights) -> Rows:
        """Return all rows at the unknowns ``y``, with what the pass has ``held``."""
        sigma = self.fixed_sigma.copy()
        sigma[-held.bends.size :] = np.sqrt(held.bends * self.model.spacing_m)
        fixed = _over(self.fixed, self.target - self.fixed @ y, sigma)
        parts = (
            fixed,
            _height(self, y),
            _offset(self, y, held.sagged),
            _moment(self, y, held.turned),
            _acceleration(self, y),
            _bounce(self, y, held.loose),
            _pitch(self, y, held.loose),
        )
        derivative = vstack([part.derivative for part in parts], format="csr")
        return Rows(derivative, np.concatenate([part.misfit for part in parts]))

    def misfit(self, y: FloatArray, held: Weights) -> float:
        """Return the sum of the squared misfits."""
        misfit = self.rows(y, held).misfit
        return float(misfit @ misfit)

    def weights(self, y: FloatArray, bends: FloatArray, loose: float = 1.0) -> Weights:
        """Return what a pass holds that begins at the unknowns ``y``."""
        lay = self.layout
        sagged, turned = np.diff(y[lay.in_time("offset")]), np.diff(self.slope @ y[lay.elevation])
        return Weights(bends, sagged, turned, loose)

    def _passed_over(self, ahead_m: float) -> csr_array:
        """Return the matrix of the road's mean over what passes ``ahead_m`` of the laser."""
        at, reach = self.readings.place + ahead_m, self.readings.speed * self.readings.interval_s
        grid = self.first_m, self.model.spacing_m, self.layout.points
        parts = [between_points(at + part * reach / 3.0, *grid) for part in (-1.0, 0.0, 1.0)]
        return csr_array(sum(parts[1:], parts[0]) / 3.0)


def _over(derivative: csr_array, misfit: FloatArray, sigma: FloatArray) -> Rows:
    return Rows(diags_array(1.0 / sigma) @ derivative, misfit / sigma)


def _fixed_rows(stretch: Stretch) -> tuple[csr_array, FloatArray, FloatArray]:
    """Return the rows that are linear with a 1-σ of their own; the slope's steps last."""
    parts = [*_in_time(stretch), *_priors(stretch), *_road(stretch.layout, stretch.model)]
    matrices, targets, sigmas = zip(*parts, strict=True)
    found: csr_array = vstack(matrices, format="csr")
    return found, np.concatenate(targets), np.concatenate(sigmas)


def _in_time(stretch: Stretch) -> Fixed:
    """Return the rows of the bias, which walks, and of heave and nod, which are noise."""
    lay, model, seen = stretch.layout, stretch.model, stretch.readings
    walked, nodes = np.sqrt(seen.pause_s[1:]), eye_array(lay.nodes, format="csr")
    found: Fixed = []
    found.append(
        (lay.rows((lay.bias, _steps(lay.nodes))), np.zeros(lay.nodes - 1), model.walk * walked)
    )
    heave = model.heave_m + model.heave_speed * seen.speed
    nod = model.nod_rad + model.nod_speed * seen.speed
    for name, sigma in (("heave", heave), ("nod", nod)):
        found.append((lay.rows((lay.in_time(name), nodes)), np.zeros(lay.nodes), sigma))
    return found


def _priors(stretch: Stretch) -> Fixed:
    """Return a row for each of `GLOBALS`, and for the first of each that walks."""
    lay, model = stretch.layout, stretch.model
    spread = {
        lay.bias.start: (0.0, model.bias),
        lay.in_time("offset").start: (0.0, model.offset_m),
        lay.in_time("moment").start: (0.0, model.moment),
        lay.elevation.start: (0.0, model.start_m),
        **{lay.place(name): (model.means[name], model.sigmas[name]) for name in GLOBALS},
    }
    means, sigmas = np.array(list(spread.values())).T
    shape = len(spread), lay.size
    rows = csr_array((np.ones(len(spread)), (np.arange(len(spread)), list(spread))), shape)
    return [(rows, means, sigmas)]


def _road(lay: Layout, model: SlopeModel) -> Fixed:
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


def _height(stretch: Stretch, y: FloatArray) -> Rows:
    """Return the readings of the height sensor against the body over the road."""
    lay, model, seen = stretch.layout, stretch.model, stretch.readings
    known, nodes = ~np.isnan(seen.height), eye_array(lay.nodes, format="csr")
    pitch, slope = y[lay.pitch], stretch.under_laser @ y[lay.slope]
    lever = stretch.places.lever_m - model.sway_m * slope
    swayed = diags_array(-model.sway_m * pitch) @ stretch.under_laser
    derivative = lay.rows(
        (lay.height, nodes),
        (lay.pitch, csr_array(diags_array(lever))),
        (lay.elevation, -stretch.under_laser),
        (lay.slope, swayed),
    )
    predicted = y[lay.height] + lever * pitch - stretch.under_laser @ y[lay.elevation]
    between_m = np.minimum(seen.speed * seen.interval_s, model.spacing_m)
    sigma = np.sqrt(model.reading_m**2 + model.road * between_m / 3.0)
    return _over(derivative[known], (seen.height - predicted)[known], sigma[known])


def _offset(stretch: Stretch, y: FloatArray, sagged: FloatArray) -> Rows:
    """Return the steps of the offset: a body that stands may sag, as where somebody boards."""
    lay, model = stretch.layout, stretch.model
    variance = model.offset_walk**2 * stretch.readings.pause_s[1:]
    heavy = np.where(stretch.rested, 0.5 * (variance + np.square(sagged)), variance)
    steps = _steps(lay.nodes)
    misfit = -(steps @ y[lay.in_time("offset")])
    return _over(lay.rows((lay.in_time("offset"), steps)), misfit, np.sqrt(heavy))


def _moment(stretch: Stretch, y: FloatArray, turned: FloatArray) -> Rows:
    """Return the steps of the moment: where the slope under the wheels has ``turned``, it may."""
    lay, model, seen = stretch.layout, stretch.model, stretch.readings
    sigma = np.hypot(
        model.moment_walk * np.sqrt(seen.pause_s[1:]), model.moment_share * model.gravity * turned
    )
    steps = _steps(lay.nodes)
    return _over(
        lay.rows((lay.in_time("moment"), steps)), -(steps @ y[lay.in_time("moment")]), sigma
    )


def _acceleration(stretch: Stretch, y: FloatArray) -> Rows:
    """Return the second difference of the height against the force on a tilted axis."""
    lay, model, seen, car = stretch.layout, stretch.model, stretch.readings, stretch.car
    at, g, lean = seen.middles, model.gravity, y[lay.place("lean")]
    tilt = y[lay.pitch] + lean
    level = seen.along * tilt + 0.5 * g * tilt**2 - y[lay.bias]
    by_tilt = seen.along + g * tilt
    derivative = lay.rows(
        (lay.height, car.second),
        (lay.pitch, -(car.mean @ diags_array(by_tilt))),
        ("lean", -(car.mean @ by_tilt)),
        (lay.bias, car.mean),
    )
    missing = np.max([seen.missing[at + side] for side in (-1, 0, 1)], axis=0)
    squares = np.square([model.acceleration, model.missing_acceleration])
    noise = (squares[0] + missing * (squares[1] - squares[0])) / seen.interval_s
    sigma = np.sqrt(noise + np.square(model.force_share * seen.force[at]))
    misfit = seen.force[at] + car.mean @ level - car.second @ y[lay.height]
    return _over(derivative, misfit, sigma)


def _bounce(stretch: Stretch, y: FloatArray, loose: float) -> Rows:
    """Return the height of the body against that of a half car on its springs."""
    model, seen = stretch.model, stretch.readings
    derivative, value = stretch.car.bounce(y)
    density = model.bounce + model.bounce_speed * seen.speed[seen.middles]
    sigma = np.hypot(density / np.sqrt(seen.interval_s), model.jolt_bounce * stretch.car.jolts)
    return _over(derivative, -value, loose * sigma)


def _pitch(stretch: Stretch, y: FloatArray, loose: float) -> Rows:
    """Return its pitch against that of the same half car."""
    model, seen = stretch.model, stretch.readings
    derivative, value = stretch.car.pitch(y, model.gravity)
    density = model.swing + model.swing_speed * seen.speed[seen.middles]
    sigma = np.hypot(density / np.sqrt(seen.interval_s), model.jolt_pitch * stretch.car.jolts)
    return _over(derivative, -value, loose * sigma)
