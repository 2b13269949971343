"""What the kernels remember from block to block, as records with named fields.

Stages make them with `new_record` before any kernel is compiled; so nothing here loads numba.
"""

import numpy as np

STATE_VARIABLE = np.dtype(
    [("started", np.bool_), *((name, np.float64) for name in ("held", "s1", "s2"))], align=True
)
"""Of a stage of `state_variable`: whether it has begun, the last input, and the states, of which a
first-order stage has one."""

VARYING = np.dtype(
    [
        *((name, np.bool_) for name in ("has_x", "has_c")),
        *((name, np.float64) for name in ("x", "c", "r", "t", "g", "y1", "y2", "a")),
    ],
    align=True,
)
"""Of a stage of `varying`: whether an input and a c have occurred, the last of each, the states,
and the last outputs."""

VARYING_STATES = np.dtype(
    [("started", np.bool_), *((name, np.float64) for name in ("held", "c", "s1", "s2"))],
    align=True,
)
"""Of a stage of `varying_states`: whether it has begun, the last input and c, and the states."""

OBSERVER = np.dtype(
    [
        ("started", np.bool_),
        *((name, np.float64) for name in ("pushed", "held", "c")),
        *((name, np.float64) for name in ("e", "v", "b", "r")),
    ],
    align=True,
)
"""Of `matched_high_pass`: whether it has begun, the last a (in m), h and c, and the states."""

CONTROLLER = np.dtype(
    [
        ("active", np.bool_),
        *((name, np.float64) for name in ("held", "moving", "last", "area", "offset")),
    ],
    align=True,
)
"""Of `local_suppression`: whether it acts, the last d, speed and v, the integral, the offset."""

INTEGRATOR = np.dtype(
    [("started", np.bool_), *((name, np.float64) for name in ("last", "total", "height"))],
    align=True,
)
"""Of an integrator of `motion`: whether it has begun, the last input, the integral and, where it
reflects the height, the last height."""

SUM = np.dtype([("total", np.float64), ("rest", np.float64), ("count", np.int64)], align=True)
"""A compensated sum, which is ``total`` and ``rest`` together, and of how many samples it is."""
