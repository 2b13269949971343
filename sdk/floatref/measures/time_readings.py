"""Readings of GNSS time in a recording: when each was new, with weeks and days unrolled."""

from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.values.arrays import FloatArray
from floatref.values.scanning import chunks

DAY_S, WEEK_S = 86400.0, 604800.0
ASTRAY_S = 1.0
"""A reading that is so far from what most tell is none, beside what drift explains."""
DRIFT = 1e-3


class ReadingEdges(NamedTuple):
    """New readings of GNSS time.

    Args:
        base_s: base time of the first sample of each, shape (n,), in s.
        gnss_s: what it read, shape (n,), in s, going on over midnight and the end of a week.
        update_s: the usual time between two, with that between two samples, in s.
        dropped: readings that do not go on as time does.
    """

    base_s: FloatArray
    gnss_s: FloatArray
    update_s: float
    dropped: int


def reading_edges(base_s: FloatArray, gnss_s: FloatArray) -> ReadingEdges:
    """Return when the readings ``gnss_s``, shape (n,), at ``base_s`` were new, a piece at a time.

    Raises InputError for different shapes or fewer than two readings.
    """
    if base_s.shape != gnss_s.shape or base_s.ndim != 1:
        raise InputError(
            f"{gnss_s.size} readings of GNSS time at {base_s.size} times; give one each"
        )
    at, read, sample_s = _changes(base_s, gnss_s)
    if at.size < 2:
        raise InputError(
            f"GNSS time takes {at.size} new value(s) in {base_s.size} samples; two or more are "
            "needed, so check the channel"
        )
    read = _unrolled(at, read)
    shift = read - at
    usual = float(np.median(shift))
    sound = np.abs(shift - usual) <= ASTRAY_S + DRIFT * float(np.ptp(at))
    sound[sound] = np.diff(read[sound], prepend=-np.inf) > 0
    update = float(np.median(np.diff(read[sound]))) if sound.sum() > 1 else 0.0
    return ReadingEdges(at[sound], read[sound], update + sample_s, int((~sound).sum()))


def _changes(base_s: FloatArray, gnss_s: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return base time and value of every new reading, and the usual step between samples.

    The first reading is left out: when it was new is not known.
    """
    times, values, steps, last = [], [], [], np.nan
    for first, chunk in chunks(gnss_s):
        at = np.asarray(base_s[first : first + chunk.size])
        known = np.flatnonzero(np.isfinite(chunk) & np.isfinite(at))
        if not known.size:
            continue
        shown = chunk[known]
        new = np.diff(shown, prepend=last) != 0
        times.append(at[known[new]])
        values.append(shown[new].copy())
        last = float(shown[-1])
        steps.append(float(np.median(np.diff(at))) if at.size > 1 else 0.0)
    if not times:
        return np.empty(0), np.empty(0), 0.0
    return np.concatenate(times)[1:], np.concatenate(values)[1:], float(np.median(steps))


def _unrolled(at: FloatArray, read: FloatArray) -> FloatArray:
    """Return the readings with a day or a week added wherever they roll over."""
    steps = np.diff(read) - np.diff(at)
    near = ASTRAY_S + DRIFT * np.abs(np.diff(at))
    week, day = np.abs(steps + WEEK_S) <= near, np.abs(steps + DAY_S) <= near
    rolled = np.where(week, WEEK_S, np.where(day, DAY_S, 0.0))
    return np.asarray(read + np.concatenate([[0.0], np.cumsum(rolled)]))
