"""How much the slope of a road changes: one intensity per 10 m, as its own bends suggest."""

import numpy as np

from floatref.estimators.road_slope.constants import SlopeModel
from floatref.values.arrays import FloatArray


def first_bends(points: int, model: SlopeModel) -> FloatArray:
    """Return g of every step of the slope before the first pass, in 1/m, shape (points - 1,)."""
    return np.full(points - 1, model.first_bend * model.bends)


def renew_bends(slope: FloatArray, model: SlopeModel) -> FloatArray:
    """Return g of every step of the ``slope``, in 1/m, shape (n - 1,).

    The mean of g_0, with the weight ν, and the squared steps of a segment over their length.
    """
    steps = np.diff(slope)
    segment = np.arange(steps.size) // max(1, round(model.segment_m / model.spacing_m))
    total = np.bincount(segment, np.square(steps) / model.spacing_m)
    found = (model.bend_weight * model.bends + total) / (model.bend_weight + 1.0)
    kept: FloatArray = np.clip(found, model.bends, model.most_bend * model.bends)[segment]
    return kept
