"""The rows of both sensors: misfits to what they read, and derivatives of what they would read."""

import numpy as np
from scipy.sparse import csr_array, eye_array

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.layout import Layout
from floatref.estimators.road_slope.readings import Readings
from floatref.estimators.road_slope.sparse.pattern import Pattern
from floatref.estimators.road_slope.springs import HalfCar
from floatref.values.arrays import FloatArray


class HeightRows:
    """The readings of the height sensor against the body over the road.

    Attributes:
        sigma: 1-σ of each row, in m.
    """

    def __init__(
        self,
        readings: Readings,
        places: Places,
        model: SlopeModel,
        layout: Layout,
        under_laser: csr_array,
    ) -> None:
        """Take ``under_laser``, the matrix of the road under the laser at all nodes."""
        self.layout, self.places, self.model = layout, places, model
        self.known = np.flatnonzero(~np.isnan(readings.height))
        self.under, self.height = under_laser[self.known], readings.height[self.known]
        self.row = np.repeat(np.arange(self.known.size), np.diff(self.under.indptr))
        nodes = eye_array(layout.nodes, format="csr")[self.known]
        body, road = (layout.height, layout.pitch), (layout.elevation, layout.slope)
        parts = *((where, nodes) for where in body), *((where, self.under) for where in road)
        self.pattern = Pattern(layout, *parts)
        between_m = np.minimum(readings.speed * readings.interval_s, model.spacing_m)
        self.sigma = np.sqrt(model.reading_m**2 + model.road * between_m[self.known] / 3.0)

    def misfit(self, y: FloatArray) -> FloatArray:
        """Return what was read less what would be at the unknowns ``y``, in m."""
        lay = self.layout
        body = y[lay.height][self.known] + self._lever(y) * y[lay.pitch][self.known]
        found: FloatArray = self.height - (body - self.under @ y[lay.elevation])
        return found

    def derivative(self, y: FloatArray) -> csr_array:
        """Return the derivatives of what would be read."""
        swayed = -self.model.sway_m * y[self.layout.pitch][self.known]
        road = -self.under.data, swayed[self.row] * self.under.data
        return self.pattern.fill(np.ones(self.known.size), self._lever(y), *road)

    def _lever(self, y: FloatArray) -> FloatArray:
        """Return by how much a reading grows with the pitch, in m."""
        lever: FloatArray = self.model.sway_m * (self.under @ y[self.layout.slope])
        return self.places.lever_m - lever


class ForceRows:
    """The second difference of the height against the force on a tilted axis, at the middles.

    Attributes:
        sigma: 1-σ of each row, in m/s².
    """

    def __init__(self, readings: Readings, model: SlopeModel, layout: Layout, car: HalfCar) -> None:
        """Take the means and differences of the ``car``."""
        self.layout, self.gravity, self.along = layout, model.gravity, readings.along
        self.mean, self.second = car.mean, car.second
        at = readings.middles
        self.force = readings.force[at]
        parts = (
            (layout.height, car.second),
            (layout.pitch, car.mean),
            "lean",
            (layout.bias, car.mean),
        )
        self.pattern = Pattern(layout, *parts)
        missing = np.max([readings.missing[at + side] for side in (-1, 0, 1)], axis=0)
        squares = np.square([model.acceleration, model.missing_acceleration])
        noise = (squares[0] + missing * (squares[1] - squares[0])) / readings.interval_s
        self.sigma = np.sqrt(noise + np.square(model.force_share * self.force))

    def misfit(self, y: FloatArray) -> FloatArray:
        """Return the acceleration by the force, less that of the height at ``y``, in m/s²."""
        lay, tilt = self.layout, self._tilt(y)
        level = self.along * tilt + 0.5 * self.gravity * tilt**2 - y[lay.bias]
        found: FloatArray = self.force + self.mean @ level - self.second @ y[lay.height]
        return found

    def derivative(self, y: FloatArray) -> csr_array:
        """Return the derivatives of the latter less the former."""
        by_tilt = self.along + self.gravity * self._tilt(y)
        by_pitch = -self.mean.data * by_tilt[self.mean.indices]
        return self.pattern.fill(self.second.data, by_pitch, -(self.mean @ by_tilt), self.mean.data)

    def _tilt(self, y: FloatArray) -> FloatArray:
        """Return θ + λ at all nodes."""
        tilt: FloatArray = y[self.layout.pitch] + y[self.layout.place("lean")]
        return tilt
