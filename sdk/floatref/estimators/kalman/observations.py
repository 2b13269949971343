"""Observations of the Kalman filter in the order of time, as its kernel takes them."""

from collections.abc import Sequence

import numpy as np

from floatref.estimators.models.kalman_values import KINDS, Observations
from floatref.values.arrays import FloatArray, IndexArray

UNSEEN = np.full(KINDS, np.nan)


def observations_of(
    at: IndexArray,
    mark: int,
    values: FloatArray,
    variances: FloatArray,
    drifted: FloatArray | float = 0.0,
) -> Observations:
    """Return ``values`` observed at the samples ``at``, all with the same ``mark``."""
    y, r = np.empty((2, at.size, KINDS))
    y[:], r[:] = values, variances
    return Observations(at, np.full(at.size, mark), y, r, np.full(at.size, drifted, np.float64))


def merge(one: Observations, other: Observations) -> Observations:
    """Return both in the order of time; what comes at one sample becomes one observation."""
    at = np.union1d(one.at, other.at)
    found = observations_of(at, 0, UNSEEN, UNSEEN)
    for part in (one, other):
        place = np.searchsorted(at, part.at)
        found.marks[place] |= part.marks
        for rows, own in ((found.values, part.values), (found.variances, part.variances)):
            rows[place] = np.where(np.isnan(own), rows[place], own)
        found.drifted[place] = part.drifted
    return found


def mark_sample(observations: Observations, sample: int, mark: int) -> Observations:
    """Return ``observations`` with ``mark`` at ``sample``, where there need not be one."""
    at = observations.at
    place = int(np.searchsorted(at, sample))
    if place < at.size and at[place] == sample:
        observations.marks[place] |= mark
        return observations
    alone = observations_of(np.array([sample]), mark, UNSEEN, UNSEEN)
    head, tail = part(observations, slice(place)), part(observations, slice(place, None))
    return join_observations([head, alone, tail])


def part(observations: Observations, where: slice | IndexArray) -> Observations:
    """Return the observations ``where``."""
    at, marks, values, variances, drifted = observations
    return Observations(at[where], marks[where], values[where], variances[where], drifted[where])


def join_observations(parts: Sequence[Observations]) -> Observations:
    """Return ``parts``, each behind the one before, as one."""
    if not parts:
        return observations_of(np.empty(0, np.int64), 0, UNSEEN, UNSEEN)
    return Observations(*(np.concatenate(values) for values in zip(*parts, strict=True)))
