"""From values at the nodes of a smoother to every sample."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, IndexArray


@compiled
def interpolate(
    node_at: IndexArray,
    corrections: FloatArray,
    first: int,
    start: FloatArray,
    step: float,
    height: FloatArray,
) -> None:
    """Add the corrections to the filtered ``height`` of samples ``first`` on.

    ``start`` holds sample number, height and velocity correction of the node before.
    """
    begin, r_0, v_0, behind = int(start[0]), start[1], start[2], first + height.size
    for k in range(node_at.shape[0]):
        end = node_at[k, 0]
        span = (end - begin) * step
        r_1, slope_0, slope_1 = corrections[k, 0], span * v_0, span * corrections[k, 1]
        rise = r_1 - r_0
        square, cube = 3.0 * rise - 2.0 * slope_0 - slope_1, slope_0 + slope_1 - 2.0 * rise
        scale = 1.0 / max(end - begin, 1)
        for i in range(max(begin, first), min(end, behind)):
            t = (i - begin) * scale
            height[i - first] += r_0 + t * (slope_0 + t * (square + t * cube))
        begin, r_0, v_0 = end, corrections[k, 2], corrections[k, 3]
    if first <= begin < behind:
        height[begin - first] += r_0


@compiled
def ramp(at: IndexArray, values: FloatArray, first: int, line: FloatArray) -> None:
    """Write the line through ``values`` at the samples ``at``, in order, from sample ``first``.

    Before the first of them, and behind the last, it stays level.
    """
    i, size = 0, line.size
    for k in range(at.size - 1):
        begin, end = at[k] - first, min(at[k + 1] - first, size)
        while i < min(begin, end):
            line[i] = values[k]
            i += 1
        slope = (values[k + 1] - values[k]) / (at[k + 1] - at[k])
        for j in range(i, end):
            line[j] = values[k] + (j - begin) * slope
        i = max(i, end)
    for j in range(i, size):
        line[j] = values[at.size - 1]
