"""The template of California Test 526 across the base of a bump, as a loop over the bump's points.

The base of a point lies between the lowest values on both sides of it, as far as the template
reaches; every place of the template beneath the point is tried.
"""

import numpy as np
from numpy.typing import NDArray

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray


@compiled
def heights_above_base(
    trace: FloatArray,
    points: NDArray[np.int64],
    limit: float,
    behind: FloatArray,
    heights: FloatArray,
) -> None:
    """Write to ``heights`` how far the ``points`` of ``trace`` lie above their base, if above.

    t_k − min over m of max(lowest of t_{k−m} … t_k, lowest of t_k … t_{k+span−m}), where that is
    above ``limit``; ``behind`` is scratch of span + 1 values. Values that count for nothing are
    infinite.
    """
    span = behind.size - 1
    for k in points:
        lowest = trace[k]
        for ahead in range(span + 1):
            if k + ahead < trace.size:
                lowest = min(lowest, trace[k + ahead])
            behind[ahead] = lowest
        lowest = trace[k]
        base = max(lowest, behind[span])
        for before in range(span + 1):
            if k - before >= 0:
                lowest = min(lowest, trace[k - before])
            base = min(base, max(lowest, behind[span - before]))
            # With a longer way before the point, what is left behind it only gets higher.
            if lowest <= behind[span - before]:
                break
        height = trace[k] - base
        if height > limit:
            heights[k] = height
