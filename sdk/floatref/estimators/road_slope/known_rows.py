"""Rows of what is known before the readings, that are linear with a 1-σ of their own."""

import numpy as np
from scipy.sparse import csr_array, eye_array, vstack

from floatref.estimators.road_slope.constants import SlopeModel
from floatref.estimators.road_slope.layout import GLOBALS, Layout
from floatref.estimators.road_slope.readings import Readings
from floatref.values.arrays import FloatArray

Known = list[tuple[csr_array, FloatArray, FloatArray]]
"""Rows with their targets and 1-σ."""


def known_rows(
    layout: Layout, model: SlopeModel, seen: Readings
) -> tuple[csr_array, FloatArray, FloatArray]:
    """Return all of them, with targets and 1-σ; the slope's steps last."""
    parts = [*_in_time(layout, model, seen), *_priors(layout, model), *_road(layout, model)]
    matrices, targets, sigmas = zip(*parts, strict=True)
    found: csr_array = vstack(matrices, format="csr")
    return found, np.concatenate(targets), np.concatenate(sigmas)


def steps(count: int) -> csr_array:
    """Return the matrix of the differences of ``count`` values to the ones before them."""
    shape = count - 1, count
    return csr_array(eye_array(*shape, k=1, format="csr") - eye_array(*shape, format="csr"))


def _in_time(lay: Layout, model: SlopeModel, seen: Readings) -> Known:
    """Return the rows of the bias, which walks, and of heave and nod, which are noise."""
    walked, nodes = np.sqrt(seen.pause_s[1:]), eye_array(lay.nodes, format="csr")
    found: Known = []
    found.append(
        (lay.rows((lay.bias, steps(lay.nodes))), np.zeros(lay.nodes - 1), model.walk * walked)
    )
    heave = model.heave_m + model.heave_speed * seen.speed
    nod = model.nod_rad + model.nod_speed * seen.speed
    for name, sigma in (("heave", heave), ("nod", nod)):
        found.append((lay.rows((lay.in_time(name), nodes)), np.zeros(lay.nodes), sigma))
    return found


def known_before(lay: Layout, model: SlopeModel) -> dict[int, tuple[float, float]]:
    """Return mean and 1-σ of `GLOBALS`, and of the first of each that walks, by their places."""
    return {
        lay.bias.start: (0.0, model.bias),
        lay.in_time("offset").start: (0.0, model.offset_m),
        lay.in_time("moment").start: (0.0, model.moment),
        lay.elevation.start: (0.0, model.start_m),
        **{lay.place(name): (model.means[name], model.sigmas[name]) for name in GLOBALS},
    }


def _priors(lay: Layout, model: SlopeModel) -> Known:
    """Return a row for each of `known_before`."""
    spread = known_before(lay, model)
    means, sigmas = np.array(list(spread.values())).T
    shape = len(spread), lay.size
    rows = csr_array((np.ones(len(spread)), (np.arange(len(spread)), list(spread))), shape)
    return [(rows, means, sigmas)]


def _road(lay: Layout, model: SlopeModel) -> Known:
    """Return the rows of the road; the 1-σ of the slope's steps is that of the pass."""
    rises, spacing = steps(lay.points), model.spacing_m
    along = -spacing * eye_array(lay.points - 1, lay.points, format="csr")
    points = eye_array(lay.points, format="csr")
    mean = model.slope * np.sqrt(model.slope_reach_m / spacing)
    rows = (
        (lay.rows((lay.elevation, rises), (lay.slope, along)), np.sqrt(model.road * spacing)),
        (lay.rows((lay.slope, points)), mean),
        (lay.rows((lay.slope, rises)), 1.0),
    )
    return [(m, np.zeros(m.shape[0]), np.full(m.shape[0], sigma)) for m, sigma in rows]
