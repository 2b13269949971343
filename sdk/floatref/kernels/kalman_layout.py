"""How the Kalman kernels lay out states, nodes and updates in plain arrays."""

from floatref.values.arrays import FloatArray

Inputs = tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]
"""Specific force and angular rate along the body's axes."""
STATES = 10
"""Height, velocity, pitch, roll, the biases of acceleration, roll rate and pitch rate (C.2), then
the lean of the vertical accelerometer's axis forward, the drift of the GNSS height, and the offset
of the height that is reflected at a stop."""
LEAN, DRIFT, OFFSET = 7, 8, 9
KINDS = 4
"""Observations: height, vertical velocity, pitch inclination, roll inclination."""
TRANSITION = 18
"""Composed rows of height, velocity, pitch and roll by pitch, roll and the two gyro biases; then
height and velocity by the lean."""
COVARIANCE = STATES * (STATES + 1) // 2
"""Upper half of P."""
JUMP, RENEWED, SPREAD = TRANSITION, TRANSITION + 2, TRANSITION + 3
NODE = SPREAD + COVARIANCE
"""Of a node: transition, jump of height and velocity by its update, whether the offset is another
from here on, upper half of P."""
INNOVATION = 2 * STATES
UPDATE = INNOVATION + 2
"""Of a scalar update: row of H, gain, innovation over S, 1/S."""
OBSERVATION = 2 * KINDS + 1
"""Of an observation: values, variances, variance that the drift gains."""
RELATIVE, CAPTURE, TRUSTED, REFLECTED, RENEW = 1, 2, 4, 8, 16
"""Bits of a time of observation: the height is relative to the one captured; capture the
antenna's height; leave nothing out; the height is the reference point's, relative to where a stop
began, and has the offset; a stop begins."""
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
REJECTED = LATEST + 1
MEMORY = REJECTED + KINDS
"""Length of the memory: transition, last inputs (6), sine and cosine of pitch and roll, steps
since the node, sums of the sensitivity to pitch and roll, captured height, height where a stop
began, heights left out in a row, sample advanced to last, observations left out."""
GATE = 100.0
"""Square of the innovation over S beyond which a reading may be wrong."""
BELIEVED_AT = 20
"""So many heights left out in a row are a leap of the datum."""
