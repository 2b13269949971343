"""How rough the road has been: squares of its second differences over two distances."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

SHORT, LONG, GONE, AGO, COUNT, RING = range(6)
"""Of the memory: both mean squares in m², travel in m and time in s since the latest point, how
many points there are behind one another, and the points: elevation in m and seconds since the one
before, from the latest."""

RUN, LATELY, LAST = 2, 3, 5
"""Of the memory of `texture`: both mean squares in m², how many nodes in a row count, and the
elevation in m at the latest ones."""


@compiled
def gather(
    elevation: FloatArray,
    travel: FloatArray,
    interval_s: float,
    spacing: float,
    lags: tuple[int, int],
    most_s: float,
    share: float,
    memory: FloatArray,
) -> None:
    """Take ``elevation`` in m at nodes ``travel`` in m behind one another, NaN where unknown.

    Points are ``spacing`` in m apart. Both mean squares, over ``lags`` of points, go to each new
    square by ``share`` if no more than ``most_s`` in s lie between its ends.
    """
    kept = 2 * lags[1] + 1
    for k in range(elevation.size):
        memory[GONE] += travel[k]
        memory[AGO] += interval_s
        if memory[GONE] < spacing or elevation[k] != elevation[k]:
            continue
        if memory[GONE] >= 2.0 * spacing:
            memory[COUNT] = 0.0
        for j in range(kept - 1, 0, -1):
            memory[RING + j] = memory[RING + j - 1]
            memory[RING + kept + j] = memory[RING + kept + j - 1]
        memory[RING], memory[RING + kept] = elevation[k], memory[AGO]
        memory[COUNT] = min(memory[COUNT] + 1.0, float(kept))
        memory[GONE] %= spacing
        memory[AGO] = 0.0
        for which in range(2):
            _square(which, lags[which], kept, most_s, share, memory)


@compiled
def texture(
    elevation: FloatArray,
    travel: FloatArray,
    least_m: float,
    most_m: float,
    per_m: float,
    memory: FloatArray,
) -> None:
    """Take second differences over one and over two nodes, where these are some way apart.

    Both mean squares go to each new one by ``per_m`` of the travel; nodes count that are
    ``least_m`` to ``most_m`` apart, in m, five in a row.
    """
    for k in range(elevation.size):
        for j in range(LAST - 1, 0, -1):
            memory[LATELY + j] = memory[LATELY + j - 1]
        memory[LATELY] = elevation[k]
        good = elevation[k] == elevation[k] and least_m <= travel[k] <= most_m
        memory[RUN] = memory[RUN] + 1.0 if good else 0.0
        if memory[RUN] < LAST:
            continue
        share = min(per_m * travel[k], 1.0)
        for which in range(2):
            lag = which + 1
            bend = memory[LATELY] - 2.0 * memory[LATELY + lag] + memory[LATELY + 2 * lag]
            mean = memory[which]
            memory[which] += share * (min(bend * bend, 9.0 * mean) - mean)


@compiled
def _square(
    which: int, lag: int, kept: int, most_s: float, share: float, memory: FloatArray
) -> None:
    """Take the second difference over ``lag`` points; one far out counts as three deviations."""
    if memory[COUNT] < 2 * lag + 1:
        return
    lasted = 0.0
    for j in range(2 * lag):
        lasted += memory[RING + kept + j]
    if lasted > most_s:
        return
    bend = memory[RING] - 2.0 * memory[RING + lag] + memory[RING + 2 * lag]
    memory[which] += share * (min(bend * bend, 9.0 * memory[which]) - memory[which])
