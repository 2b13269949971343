"""Where a distance goes back farther than a vehicle rolls, and whether that is its sign."""

from collections.abc import Iterator

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray, IndexArray
from floatref.values.recording import Channel
from floatref.values.scanning import chunks

ROLLS_BACK_M = 1.0
"""Largest roll-back of a vehicle that stops, in m; a reversed encoder exceeds it."""
MOST = 0.5
"""Share of the samples that may lie behind, as of those that may be missing."""


def check_direction(channel: Channel, most: float = MOST) -> None:
    """Raise InputError for a distance with more than ``most`` of its samples in `stretches_behind`.

    Fewer are a fault of their stretches, not a wrong sign.
    """
    behind = stretches_behind(channel)
    if np.diff(behind).sum() <= most * channel.values.size:
        return
    first, end = behind[0]
    stretch = np.asarray(channel.values[first:end])
    at = int(first) + int(np.argmax(~np.isnan(stretch)))
    by_m = float(np.nanmax(channel.values[:at])) - float(channel.values[at])
    raise InputError(
        f"channel {channel.id}: sample {at} goes back by {by_m:.4g} m to "
        f"{channel.values[at]:.10g} m; invert the sign of a reversed encoder, "
        "or cut the run where the vehicle rolled back"
    )


def stretches_behind(channel: Channel) -> IndexArray:
    """Return first index and the one behind of each stretch behind the farthest, shape (k, 2).

    Only those that lie behind by more than `ROLLS_BACK_M`, and no single samples that jump and
    return at once. Missing (NaN) samples beside them belong to them.
    """
    values = channel.values
    if _only_grows(channel) or not _goes_back(values):
        return np.empty((0, 2), np.int64)
    spans: list[list[int]] = []
    depths: list[float] = []
    reached = -np.inf
    for first, chunk in _without_spikes(values):
        farthest = np.fmax.accumulate(np.append(reached, chunk))
        reached = float(farthest[-1])
        depth = np.nan_to_num(farthest[:-1] - chunk, nan=0.0, neginf=0.0)
        behind = ~(chunk >= farthest[:-1])
        edges = np.flatnonzero(np.diff(behind.astype(np.int8), prepend=0, append=0))
        for low, high in edges.reshape(-1, 2).tolist():
            deep = float(depth[low:high].max())
            if spans and spans[-1][1] == first + low:
                spans[-1][1], depths[-1] = first + high, max(depths[-1], deep)
            else:
                spans.append([first + low, first + high])
                depths.append(deep)
    found = np.array(spans, np.int64).reshape(-1, 2)
    return found[np.array(depths) > ROLLS_BACK_M]


def forward_chunks(channel: Channel) -> Iterator[tuple[int, FloatArray]]:
    """Yield `chunks` in which `stretches_behind` and single samples that jump are NaN."""
    behind = stretches_behind(channel)
    for first, chunk in _without_spikes(channel.values):
        forward = np.array(chunk)
        for low, high in np.clip(behind - first, 0, chunk.size).tolist():
            forward[low:high] = np.nan
        yield first, forward


def _only_grows(channel: Channel) -> bool:
    """Return whether every sample is there and not below the one before: then no reading is due."""
    return not (channel.scan.missing.any() or channel.scan.fall.any())


def _goes_back(values: FloatArray) -> bool:
    """Return whether a sample lies more than `ROLLS_BACK_M` behind the farthest before it."""
    reached = -np.inf
    for _, chunk in chunks(values):
        if chunk[0] >= reached and (chunk[1:] >= chunk[:-1]).all():
            reached = float(chunk[-1])
            continue
        farthest = np.fmax.accumulate(np.append(reached, chunk))
        if (farthest[:-1] - chunk > ROLLS_BACK_M).any():
            return True
        reached = float(farthest[-1])
    return False


def _without_spikes(values: FloatArray) -> Iterator[tuple[int, FloatArray]]:
    """Yield stretches of ``values``; a single sample that jumps and returns at once becomes NaN."""
    before = np.nan
    for first, chunk in chunks(values):
        after = values[first + chunk.size : first + chunk.size + 1]
        wide = np.concatenate(([before], chunk, after if after.size else [np.nan]))
        up, down = wide[1:-1] - wide[:-2], wide[1:-1] - wide[2:]
        spike = np.minimum(np.abs(up), np.abs(down)) > ROLLS_BACK_M
        before = float(chunk[-1])
        yield first, np.where(spike & ((up > 0) == (down > 0)), np.nan, chunk)
