"""Bias of an accelerometer that changes, against the others of the body.

Over some seconds all vertical accelerometers of a rigid body have one mean, but for lever times the
change of its angular velocity over that time. What is left is their bias, which temperature changes
in minutes.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from floatref.screening.second_sensor.doubts import Doubt, names
from floatref.screening.second_sensor.fast_series import STEP_S, FastGrid
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.channels import ChannelId

SPAN_S = 4.0
"""Length of a mean in s. A pitch rate that changes by 0.1 rad/s, as on a hump, moves the means of
places 4 m apart by 0.1 m/s²."""
CHANGED = 0.3
"""Change of the bias in m/s² that no body and no temperature makes within a run."""
WHEELS, ON_WHEEL = ("unsprung_specific_force", "rear_unsprung_specific_force"), 1.0
"""Sensors on wheel carriers, which turn in a brake and take impacts, and their limit in m/s²."""
FEWEST = 3
"""Fewest means of an accelerometer, and accelerometers by which the changed one is known."""


def bias_doubts(forces: Mapping[ChannelId, FloatArray], grid: FastGrid) -> Iterator[Doubt]:
    """Yield the accelerometers, of shape (n,) in m/s² on ``grid``, whose bias changes."""
    means = {name: _means(series) for name, series in forces.items()}
    means = {name: each for name, each in means.items() if np.isfinite(each).sum() >= FEWEST}
    if len(means) < 2:
        return
    rows = np.stack(list(means.values()))
    own = rows - np.nanmedian(rows, axis=1, keepdims=True)
    if len(means) < FEWEST:
        off = np.abs(own[0] - own[1]) > CHANGED
        if off.any():
            yield _doubt(tuple(means), off, grid)
        return
    apart, known = np.full(own.shape, np.nan), np.isfinite(own).any(axis=0)
    apart[:, known] = own[:, known] - np.nanmedian(own[:, known], axis=0)
    for name, row in zip(means, apart, strict=True):
        off = np.abs(row) > (ON_WHEEL if name.name in WHEELS else CHANGED)
        if off.any():
            yield _doubt((name,), off, grid)


def _means(series: FloatArray) -> FloatArray:
    """Return means over `SPAN_S`, shape (m,); NaN with a missing value."""
    size = round(SPAN_S / STEP_S)
    count = series.size // size
    return np.asarray(series[: count * size].reshape(count, size).mean(axis=1))


def _doubt(suspects: tuple[ChannelId, ...], off: BoolArray, grid: FastGrid) -> Doubt:
    edges = np.flatnonzero(np.diff(off.astype(np.int8), prepend=0, append=0)).reshape(-1, 2)
    times = grid.begin_s + SPAN_S * (edges + np.array([-1.0, 1.0]))
    spans = tuple((begin, end) for begin, end in times.tolist())
    what = "channel" if len(suspects) == 1 else "channels"
    return Doubt(
        suspects,
        f"{what} {names(suspects)}: mean changes by more than {CHANGED:g} m/s² against the other "
        f"accelerometers of the body in {len(spans)} places, first from {spans[0][0]:.6g} s; "
        "drift, a step or a loose mount; flagged",
        spans=spans,
        replaced=len(suspects) == 1,
    )
