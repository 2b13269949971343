"""What the road-prior kernels take, write and leave, field by field; nothing compiled.

See `floatref.estimators.models.kalman_values` on caches of compiled kernels.
"""

from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray, Records

STATES = 7
HEIGHT, VELOCITY, BIAS, CLEARANCE, SLOPE, LEAN, TILT = range(STATES)
"""Height, velocity, bias of the acceleration, clearance above the road under the laser and slope of
the road's long waves, and what longitudinal acceleration, and that times the pitch response, add to
the acceleration. The road itself is no state: height and road are unknown by a metre, and known to
a tenth of a millimetre against each other, which rounding would take from their covariance."""


class Model(NamedTuple):
    """What sensors, vehicle and road are taken for.

    Attributes:
        step: between two samples, in s.
        sub_block: samples between two nodes.
        white, walk: squares of the densities of the acceleration, and of its bias' walk.
        walk_along: of what longitudinal acceleration adds to that.
        gap: of the acceleration where samples are missing.
        reading: variance of a reading of the height sensor, in m².
        road: q, in m.
        slope: g, in 1/m.
        reach: distance after which both are forgotten, in m.
        lean, tilt: expected where they begin anew.
        lean_prior, tilt_prior: their variances there.
        edge: square of how many deviations a reading at a standstill is off at an edge.
    """

    step: float
    sub_block: int
    white: float
    walk: float
    walk_along: float
    gap: float
    reading: float
    road: float
    slope: float
    reach: float
    lean: float
    tilt: float
    lean_prior: float
    tilt_prior: float
    edge: float


ENDS = np.dtype(
    [
        (name, np.float64)
        for name in ("leaning", "tilting", "along", "travel", "seen", "anew", "missing")
    ],
    align=True,
)
"""What is known at a node: both inputs in m/s² and (m/s²)², longitudinal acceleration in m/s²,
travel since the node before in m, the height sensor's reading in m (NaN: missing), whether lean
and tilt begin anew, and the share of samples missing since the node before."""

MEMORY = np.dtype(
    [
        (name, np.float64)
        for name in (
            *("height", "velocity", "acceleration", "steps"),
            *("leaning", "tilting", "along", "still"),
        )
    ],
    align=True,
)
"""Height and velocity integrated since the node, latest acceleration, steps since the node, inputs
and longitudinal acceleration there, and for how many seconds the vehicle has not moved."""


class Filter(NamedTuple):
    """The filter between two samples, changed in place."""

    x: FloatArray
    """x̂, shape (STATES,)."""
    p: FloatArray
    """P, shape (STATES, STATES)."""
    memory: np.record
    """Of type MEMORY."""


class Inputs(NamedTuple):
    """Accelerations in m/s² of samples from number ``first`` on, and ENDS at their nodes."""

    first: int
    acceleration: FloatArray
    ends: Records


NODE = np.dtype(
    [
        ("at", np.int64),
        ("updated", np.int64),
        ("rise", np.float64),
        ("climb", np.float64),
        ("renewed", np.float64),
        ("lean_once", np.float64),
        ("tilt_once", np.float64),
        ("lean_twice", np.float64),
        ("tilt_twice", np.float64),
        ("stays", np.float64),
        ("climbs", np.float64),
        ("covariance", np.float64, (STATES * (STATES + 1) // 2,)),
    ],
    align=True,
)
"""Of a node: its sample, the end of its updates, how far its update moves height and velocity,
whether lean and tilt begin anew, single and double integrals of both inputs since the node before,
share of the road that stays, what the slope adds to it in m, and the upper half of P."""
UPDATE = np.dtype(
    [
        ("gain", np.float64, (STATES,)),
        ("innovation", np.float64),
        ("information", np.float64),
    ],
    align=True,
)
"""Of an update: gain, innovation over its variance S, and 1/S; the row of H is the same for all."""


class Output(NamedTuple):
    """What the forward pass writes: heights of all samples, nodes and their updates in order."""

    height: FloatArray
    nodes: Records
    updates: Records
