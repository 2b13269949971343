"""How the Kalman kernels lay out states, nodes and updates in plain arrays.

Compiled kernels hold these numbers, and numba's cache does not see a change here: who makes one
in a clone deletes `__pycache__/kalman*.nb?` beside this file. An installation is compiled anew.
"""

from floatref.values.arrays import FloatArray

Inputs = tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]
"""Specific force and angular rate along the body's axes."""
STATES = 10
"""Height, velocity, pitch, roll, the biases of acceleration, roll rate and pitch rate (C.2), then
the lean of the vertical accelerometer's axis forward, the drift of the GNSS height, and minus
what the height is off by where a stop begins."""
BIAS, LEAN, DRIFT, OFFSET = 4, 7, 8, 9
KINDS = 4
"""Observations: height, vertical velocity, pitch inclination, roll inclination."""
TRANSITION = 18
"""Composed rows of height, velocity, pitch and roll by pitch, roll and the two gyro biases; then
height and velocity by the lean."""
COVARIANCE = STATES * (STATES + 1) // 2
"""Upper half of P."""
JUMP, RENEWED, SHIFT, SPREAD = TRANSITION, TRANSITION + 2, TRANSITION + 3, TRANSITION + 4
NODE = SPREAD + COVARIANCE
"""Of a node: transition, jump of height and velocity by its update, the state that is another
from here on (0: none), how much of a lean given up the acceleration bias takes over, upper half
of P."""
INNOVATION = 2 * STATES
UPDATE = INNOVATION + 2
"""Of a scalar update: row of H, gain, innovation over S, 1/S."""
OBSERVATION = 2 * KINDS + 1
"""Of an observation: values, variances, variance that the drift gains."""
RELATIVE, CAPTURE, TRUSTED, REFLECTED, RENEW, FORGET = 1, 2, 4, 8, 16, 32
"""Bits of a time of observation: the height is relative to the one captured; capture the
antenna's height; leave nothing out; the height is the reference point's, relative to where a stop
began, and has the offset; a stop begins; the lean is another from here on."""
INPUTS, TURNED, STEPS, SENSITIVITY, CAPTURED, ORIGIN, IN_A_ROW, LATEST = (
    18,
    24,
    28,
    29,
    31,
    32,
    33,
    34,
)
LEVEL, RUNNING = LATEST + 1, LATEST + 2
REJECTED = LATEST + 3
REJECTED_AT = REJECTED + KINDS
MEMORY = REJECTED_AT + KINDS
"""Length of the memory: transition, last inputs (6), sine and cosine of pitch and roll, steps
since the node, sums of the sensitivity to pitch and roll, captured height, height where a stop
began, heights left out in a row, sample advanced to last, longitudinal specific force from
which the lean counts and its running mean, readings left out by kind, and the sample of the first
of each."""
GATE = 100.0
"""Square of the innovation over S beyond which a reading may be wrong."""
RUNNING_S = 1.0
"""Time constant of the running mean of the longitudinal specific force."""
BELIEVED_AT = 20
"""So many heights left out in a row are a leap of the datum."""
