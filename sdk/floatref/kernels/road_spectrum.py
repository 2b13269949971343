"""How rough the road has been: squares of its second differences over two distances."""

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray

SHORT, LONG, GONE, AGO, COUNT, MOVED, TURNED, RING = range(8)
"""Of the memory: both mean squares in m², travel in m and time in s since the latest point, how
many points there are behind one another, by how much readings have moved the height in m and turned
the velocity in m/s, and the points from the latest: elevation in m without what readings have
moved, seconds since the one before, and the velocity turned."""
SERIES = 3
STEADY = 0.02
"""Both halves of the longer distance take the same time but for this share: in a brake the tilt
that is not known yet looks like road."""

RUN, LATELY, LAST = 2, 3, 5
"""Of the memory of `texture`: both mean squares in m², how many nodes in a row count, and the
elevation in m at the latest ones."""


@compiled
def gather(
    elevation: FloatArray,
    travel: FloatArray,
    moved: FloatArray,
    turned: FloatArray,
    interval_s: float,
    spacing: float,
    lags: tuple[int, int],
    most_s: float,
    share: float,
    memory: FloatArray,
) -> None:
    """Take ``elevation`` in m at nodes ``travel`` in m behind one another, NaN where unknown.

    A reading there has ``moved`` the height in m and ``turned`` the velocity in m/s; the road has
    not, so that this is taken off. Points are ``spacing`` in m apart. Both mean squares, over
    ``lags`` of points, go to each new square by ``share`` if no more than ``most_s`` in s lie
    between its ends.
    """
    kept = 2 * lags[1] + 1
    for k in range(elevation.size):
        memory[GONE] += travel[k]
        memory[AGO] += interval_s
        memory[MOVED] += interval_s * memory[TURNED] + moved[k]
        memory[TURNED] += turned[k]
        if memory[GONE] < spacing or elevation[k] != elevation[k]:
            continue
        if memory[GONE] >= 2.0 * spacing:
            memory[COUNT] = 0.0
        for j in range(kept - 1, 0, -1):
            for series in range(SERIES):
                at = RING + series * kept + j
                memory[at] = memory[at - 1]
        memory[RING], memory[RING + kept] = elevation[k] - memory[MOVED], memory[AGO]
        memory[RING + 2 * kept] = memory[TURNED]
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
    later = earlier = 0.0
    for j in range(lag):
        later += memory[RING + kept + j]
        earlier += memory[RING + kept + lag + j]
    lasted, uneven = later + earlier, later - earlier
    if lasted > most_s or (which == LONG and abs(uneven) > STEADY * lasted):
        return
    bend = memory[RING] - 2.0 * memory[RING + lag] + memory[RING + 2 * lag]
    # What had been turned before the first of the three is no error of theirs.
    bend += uneven * memory[RING + 2 * kept + 2 * lag]
    memory[which] += share * (min(bend * bend, 9.0 * memory[which]) - memory[which])
