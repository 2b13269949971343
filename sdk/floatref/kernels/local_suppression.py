"""The controller of local suppression (fig. 5.10)."""

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def hold_at_zero(
    disturbance: FloatArray,
    speed: FloatArray,
    y: FloatArray,
    memory: np.record,
    limit: float,
    proportional: float,
    integral: float,
) -> None:
    """Write to ``y`` the ``disturbance`` as a PI controller with set point 0 leaves it.

    It acts where ``speed`` is below ``limit``; ``integral`` is K_I dt. A missing (NaN)
    disturbance or speed is bridged by the one before it, by 0 at the start.
    """
    active, held, moving = memory.active, memory.held, memory.moving
    last, area, offset = memory.last, memory.area, memory.offset
    at_once = 1.0 / (1.0 + proportional)
    later = 1.0 / (1.0 + proportional + 0.5 * integral)
    for i in range(disturbance.size):
        before = held
        held = disturbance[i] if disturbance[i] == disturbance[i] else held
        moving = speed[i] if speed[i] == speed[i] else moving
        if moving < limit:
            if not active:
                active, area = True, 0.0
                value = (held + offset) * at_once
            else:
                area += 0.5 * integral * last
                value = (held + offset - area) * later
                area += 0.5 * integral * value
        else:
            if active:
                active, offset = False, last - before
            value = held + offset
        last = value
        y[i] = value
    memory.active, memory.held, memory.moving = active, held, moving
    memory.last, memory.area, memory.offset = last, area, offset
