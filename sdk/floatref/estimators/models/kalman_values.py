"""What the Kalman kernels take, write and leave, field by field; nothing compiled.

numba's cache of a kernel sees neither a constant nor the order of a NamedTuple's fields change
here: who changes one in a clone deletes `__pycache__/*.nb?` beside this file. An installation is
compiled anew.
"""

from typing import NamedTuple

import numpy as np

from floatref.values.arrays import FloatArray, IndexArray, Records

STATES = 10
HEIGHT, VELOCITY, PITCH, ROLL, BIAS, ROLL_BIAS, PITCH_BIAS, LEAN, DRIFT, OFFSET = range(STATES)
"""The states of (C.2): height, velocity, pitch, roll, the biases of acceleration, roll rate and
pitch rate. Then the lean of the vertical accelerometer's axis forward, the drift of the GNSS
height, and minus what the height is off by where a stop begins."""
KINDS = 4
"""The rows of H (C.8), numbered as the states of the same name: height, vertical velocity, pitch
inclination and roll inclination."""

RELATIVE, CAPTURE, TRUSTED, REFLECTED, RENEW, FORGET = 1, 2, 4, 8, 16, 32
"""Bits of a time of observation: the height is relative to the one captured; capture the
antenna's height; leave nothing out; the height is the reference point's, relative to where a stop
began, and has the offset; a stop begins; the lean is another from here on."""
GATE = 100.0
"""Square of the innovation over S beyond which a reading may be wrong."""
RUNNING_S = 1.0
"""Time constant of the running mean of the longitudinal specific force."""
BELIEVED_AT = 20
"""This number of heights left out in a row is a leap of the datum."""


class Model(NamedTuple):
    """What stays the same during a run.

    Attributes:
        step: between two samples, in s.
        sub_block: samples between two nodes without observations.
        gravity: in m/s².
        arm_x, arm_y, arm_z: from the reference point to the antenna, in m.
        white: square of the density of the acceleration's white noise, and so on: Q of (C.5).
        white_roll, white_pitch, white_yaw: of the rates.
        walk, walk_roll, walk_pitch: of the walks of the biases.
        datum: variance of a new datum of the GNSS height, in m².
        floors: innovations up to here are accepted, shape (KINDS,).
        lean: variance of a lean that begins anew, in rad².
    """

    step: float
    sub_block: int
    gravity: float
    arm_x: float
    arm_y: float
    arm_z: float
    white: float
    white_roll: float
    white_pitch: float
    white_yaw: float
    walk: float
    walk_roll: float
    walk_pitch: float
    datum: float
    floors: FloatArray
    lean: float


class Inputs(NamedTuple):
    """u of (6.47), the vertical component less 1 g, of samples from number ``first`` on."""

    first: int
    x: FloatArray
    y: FloatArray
    z: FloatArray
    roll_rate: FloatArray
    pitch_rate: FloatArray
    yaw_rate: FloatArray


class Observations(NamedTuple):
    """Times of observation in order.

    Attributes:
        at: samples, shape (m,).
        marks: bits as above, shape (m,).
        values: y of (6.48), NaN where there is no reading, shape (m, KINDS).
        variances: the diagonal of R, shape (m, KINDS).
        drifted: variance that the drift of the GNSS height gains, shape (m,).
    """

    at: IndexArray
    marks: IndexArray
    values: FloatArray
    variances: FloatArray
    drifted: FloatArray


TRANSITION = np.dtype(
    [
        (f"{of}_{by}", np.float64)
        for of in ("height", "velocity", "pitch", "roll")
        for by in ("pitch", "roll", "roll_bias", "pitch_bias")
    ]
    + [("height_lean", np.float64), ("velocity_lean", np.float64)],
    align=True,
)
"""Elements of A (C.3) multiplied up over steps: what becomes of a height by a pitch, and so on.
All others are those of a body that falls freely, and known from the time."""

MEMORY = np.dtype(
    [
        ("transition", TRANSITION),
        *((name, np.float64) for name in ("x", "y", "z", "roll_rate", "pitch_rate", "yaw_rate")),
        *((name, np.float64) for name in ("sin_pitch", "cos_pitch", "sin_roll", "cos_roll")),
        ("steps", np.float64),
        ("by_pitch", np.float64),
        ("by_roll", np.float64),
        ("captured", np.float64),
        ("origin", np.float64),
        ("in_a_row", np.float64),
        ("latest", np.int64),
        ("level", np.float64),
        ("running", np.float64),
        ("rejected", np.int64, (KINDS,)),
        ("rejected_at", np.int64, (KINDS,)),
    ],
    align=True,
)
"""What goes from sample to sample beside x and P: since the node before the transition, the
steps, and the sums of the acceleration's derivatives by pitch and roll; the latest sample, its
inputs, and sine and cosine of its pitch and roll; the height captured, the height where a stop
began, heights left out in a row; longitudinal specific force from which the lean counts, and its
running mean; how many readings of each kind were left out, and the sample of the first."""


class Filter(NamedTuple):
    """The filter between two samples, changed in place."""

    x: FloatArray
    """x̂, shape (STATES,)."""
    p: FloatArray
    """P, shape (STATES, STATES)."""
    memory: np.record
    """Of type MEMORY."""


NODE = np.dtype(
    [
        ("at", np.int64),
        ("updated", np.int64),
        ("rise", np.float64),
        ("climb", np.float64),
        ("renewed", np.int64),
        ("shift", np.float64),
        ("transition", TRANSITION),
        ("covariance", np.float64, (STATES * (STATES + 1) // 2,)),
    ],
    align=True,
)
"""Of a node: its sample, the end of its updates, how far these move height and velocity, the
state that is another from here on (0: no state), how much of a lean given up the bias of the
acceleration takes over, the transition since the node before, and the upper half of P."""
UPDATE = np.dtype(
    [
        ("row", np.float64, (STATES,)),
        ("gain", np.float64, (STATES,)),
        ("innovation", np.float64),
        ("information", np.float64),
    ],
    align=True,
)
"""Of a scalar update: row of H, gain K, innovation over its variance S, and 1/S."""


class Output(NamedTuple):
    """What the forward pass writes: heights of all samples, nodes and their updates in order."""

    height: FloatArray
    nodes: Records
    updates: Records
