"""The rows of a stretch: misfits and their derivatives, all over their 1-σ."""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array, vstack

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.known_rows import known_rows, steps
from floatref.estimators.road_slope.layout import Layout, between_points
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.sensor_rows import ForceRows, HeightRows
from floatref.estimators.road_slope.sparse.elimination import Elimination
from floatref.estimators.road_slope.sparse.order import elimination_order
from floatref.estimators.road_slope.springs import HalfCar
from floatref.values.arrays import FloatArray


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
        self.height = HeightRows(readings, places, model, self.layout, self.under_laser)
        self.force = ForceRows(readings, model, self.layout, self.car)
        self.spring_sigma = _spring_sigma(self)
        self.fixed, self.target, self.fixed_sigma = known_rows(self.layout, model, readings)
        self.steps = steps(self.layout.nodes)
        walks = (self.layout.in_time(name) for name in ("offset", "moment"))
        self.walks = [self.layout.rows((where, self.steps)) for where in walks]
        # The places of all values stay, so that they are looked up once.
        self.places_of = vstack(self._derivatives(self.start()), format="csr")
        self.row_of = np.repeat(np.arange(self.places_of.shape[0]), np.diff(self.places_of.indptr))
        self.order = elimination_order(self.layout, self.under_laser, self.car.wheels)
        self.elimination = Elimination.of(self.places_of, self.order)

    def start(self) -> FloatArray:
        """Return the unknowns before the first pass."""
        found = np.zeros(self.layout.size)
        for name, mean in self.model.means.items():
            found[self.layout.place(name)] = mean
        return found

    def rows(self, y: FloatArray, held: Weights) -> Rows:
        """Return all rows at the unknowns ``y``, with what the pass has ``held``.

        The places of their values, zeros among them, are those of any other ``y``.
        """
        sure = 1.0 / self._sigma(held)
        values = np.concatenate([part.data for part in self._derivatives(y)]) * sure[self.row_of]
        where = self.places_of
        derivative = csr_array((values, where.indices, where.indptr), where.shape)
        return Rows(derivative, self._misfit(y) * sure)

    def misfit(self, y: FloatArray, held: Weights) -> float:
        """Return the sum of the squared misfits; it takes a fifth of the time of all rows."""
        return float(np.sum(np.square(self._misfit(y) / self._sigma(held))))

    def weights(self, y: FloatArray, bends: FloatArray, loose: float = 1.0) -> Weights:
        """Return what a pass holds that begins at the unknowns ``y``."""
        lay = self.layout
        sagged, turned = np.diff(y[lay.in_time("offset")]), np.diff(self.slope @ y[lay.elevation])
        return Weights(bends, sagged, turned, loose)

    def _derivatives(self, y: FloatArray) -> list[csr_array]:
        """Return those of all groups of rows, before they are over their 1-σ."""
        springs = self.car.bounce(y)[0], self.car.pitch(y, self.model.gravity)[0]
        sensors = self.height.derivative(y), self.force.derivative(y)
        return [self.fixed, sensors[0], *self.walks, sensors[1], *springs]

    def _misfit(self, y: FloatArray) -> FloatArray:
        """Return the misfits of the same groups."""
        lay, springs = self.layout, self.car.values(y, self.model.gravity)
        walked = (-(self.steps @ y[lay.in_time(name)]) for name in ("offset", "moment"))
        sensors = self.height.misfit(y), self.force.misfit(y)
        fixed = self.target - self.fixed @ y
        return np.concatenate([fixed, sensors[0], *walked, sensors[1], -springs[0], -springs[1]])

    def _sigma(self, held: Weights) -> FloatArray:
        """Return their 1-σ."""
        fixed, springs = self.fixed_sigma.copy(), self.spring_sigma
        fixed[-held.bends.size :] = np.sqrt(held.bends * self.model.spacing_m)
        walked = _offset_sigma(self, held.sagged), _moment_sigma(self, held.turned)
        sensors = self.height.sigma, self.force.sigma
        return np.concatenate([fixed, sensors[0], *walked, sensors[1], held.loose * springs])

    def _passed_over(self, ahead_m: float) -> csr_array:
        """Return the matrix of the road's mean over what passes ``ahead_m`` of the laser."""
        at, reach = self.readings.place + ahead_m, self.readings.speed * self.readings.interval_s
        grid = self.first_m, self.model.spacing_m, self.layout.points
        parts = [between_points(at + part * reach / 3.0, *grid) for part in (-1.0, 0.0, 1.0)]
        return csr_array(sum(parts[1:], parts[0]) / 3.0)


def _spring_sigma(stretch: Stretch) -> FloatArray:
    """Return 1-σ of bounce, in m/s², and of pitch, in rad/s²: of all middles, one after another."""
    model, seen, jolts = stretch.model, stretch.readings, stretch.car.jolts
    speed, root = seen.speed[seen.middles], np.sqrt(seen.interval_s)
    bounce = (model.bounce + model.bounce_speed * speed) / root
    pitch = (model.swing + model.swing_speed * speed) / root
    sigmas = np.hypot(bounce, model.jolt_bounce * jolts), np.hypot(pitch, model.jolt_pitch * jolts)
    return np.concatenate(sigmas)


def _offset_sigma(stretch: Stretch, sagged: FloatArray) -> FloatArray:
    """Return that of the offset: a body that stands may sag, as where somebody boards."""
    variance = stretch.model.offset_walk**2 * stretch.readings.pause_s[1:]
    heavy = np.where(stretch.rested, 0.5 * (variance + np.square(sagged)), variance)
    return np.asarray(np.sqrt(heavy))


def _moment_sigma(stretch: Stretch, turned: FloatArray) -> FloatArray:
    """Return that of the moment: where the slope under the wheels has ``turned``, it may."""
    model, pause_s = stretch.model, stretch.readings.pause_s[1:]
    share = model.moment_share * model.gravity
    return np.hypot(model.moment_walk * np.sqrt(pause_s), share * turned)
