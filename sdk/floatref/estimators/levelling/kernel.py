"""Attitude from rates, gravity and the encoder: bins of samples, local lines, and back."""

from math import asin, cos, nan, sin, tan

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, Records

LEAST = 1e-9
"""Spread in squared places below which it counts as zero."""
STEEP = 0.5
"""Sine of an angle that no road has."""
SIDE = 4.0
"""Squared ratio of offset and spread of what is known, beyond which no line is fitted."""


@compiled
def average(rows: FloatArray, every: int, memory: Records, filled: int, found: FloatArray) -> int:
    """Average the c ``rows``, NaN if missing, over bins of ``every`` samples.

    ``memory``, shape (c,), is that of a bin of which ``filled`` samples have been seen. Means of
    complete bins are written to ``found``, NaN where less than half is there. Returns how many
    samples of the next bin have been seen.
    """
    for c in range(rows.shape[0]):
        total, count, seen, k = memory[c].total, memory[c].count, filled, 0
        for i in range(rows.shape[1]):
            value = rows[c, i]
            if value == value:
                total += value
                count += 1.0
            seen += 1
            if seen == every:
                found[c, k] = total / count if 2.0 * count >= every else nan
                total, count, seen = 0.0, 0.0, 0
                k += 1
        memory[c].total, memory[c].count = total, count
    return (filled + int(rows.shape[1])) % every


@compiled
def fit(
    rows: FloatArray, silent: FloatArray, weights: FloatArray, patience: int, found: FloatArray
) -> None:
    """Write into ``found[:, b]`` a line's value in the middle of places b to b + 2 R of ``rows``.

    ``weights``, shape (R + 1,), are those of places to either side; NaN is unknown, and nothing
    counts beyond ``patience`` places of ``silent`` above zero in a row.
    """
    reach = weights.size - 1
    for c in range(rows.shape[0]):
        for b in range(found.shape[1]):
            s_0, s_1, s_2, t_0, t_1 = 0.0, 0.0, 0.0, 0.0, 0.0
            for way in (1, -1):
                run = 0
                for j in range(reach + 1):
                    place = b + reach + way * j
                    run = run + 1 if silent[place] > 0.0 else 0
                    if run >= patience:
                        break
                    y = rows[c, place]
                    if y != y or (j == 0 and way < 0):
                        continue
                    w, x = weights[j], float(way * j)
                    s_0 += w
                    s_1 += w * x
                    s_2 += w * x * x
                    t_0 += w * y
                    t_1 += w * x * y
            found[c, b] = _line(s_0, s_1, s_2, t_0, t_1)


@compiled
def _line(s_0: float, s_1: float, s_2: float, t_0: float, t_1: float) -> float:
    """Return the value at 0 of the line with these moments, NaN without any."""
    if s_0 == 0.0:
        return nan
    centre, mean = s_1 / s_0, t_0 / s_0
    spread = s_2 / s_0 - centre * centre
    if centre * centre > SIDE * spread or spread < LEAST:
        return mean
    return mean - (t_1 / s_0 - centre * mean) / spread * centre


@compiled
def slow(sines: FloatArray, smooth: FloatArray, found: FloatArray) -> None:
    """Write pitch and roll, and both by gravity bin by bin, shape (4, n).

    ``sines``, shape (2, n), are the sine of pitch, and that of roll times the cosine of pitch;
    ``smooth`` the lines through them.
    """
    for b in range(sines.shape[1]):
        p, q = smooth[0, b], smooth[1, b]
        theta = asin(min(STEEP, max(-STEEP, p if p == p else 0.0)))
        c_theta = cos(theta)
        phi = asin(min(STEEP, max(-STEEP, (q if q == q else 0.0) / c_theta)))
        found[0, b], found[1, b] = theta, phi
        found[2, b] = theta + (sines[0, b] - p) / c_theta
        found[3, b] = phi + (sines[1, b] - q) / (cos(phi) * c_theta)


@compiled
def turn(
    rates: FloatArray,
    angles: FloatArray,
    first: int,
    every: int,
    half_step: float,
    memory: np.record,
    found: FloatArray,
) -> None:
    """Integrate (6.27) and (6.28) by trapezoids from ``memory``, with slow ``angles``.

    ``rates``, shape (3, n), begin ``first`` samples behind the start of the bin of the first of
    ``angles``; a NaN is that of the sample before.
    """
    pitch, roll, pitching, rolling = memory.pitch, memory.roll, memory.pitching, memory.rolling
    bound, s_phi, c_phi, tangent = -1, 0.0, 1.0, 0.0
    for k in range(rates.shape[1]):
        b = (first + k) // every
        if b != bound:
            bound, theta, phi = b, angles[0, b], angles[1, b]
            s_phi, c_phi, tangent = sin(phi), cos(phi), tan(theta)
        x, y, z = rates[0, k], rates[1, k], rates[2, k]
        begun = pitching == pitching
        new_p, new_r = (pitching, rolling) if begun else (0.0, 0.0)
        if x + y + z == x + y + z:
            new_p = c_phi * y - s_phi * z
            new_r = x + tangent * (s_phi * y + c_phi * z)
        if begun:
            pitch += half_step * (pitching + new_p)
            roll += half_step * (rolling + new_r)
        pitching, rolling = new_p, new_r
        found[0, k], found[1, k] = pitch, roll
    memory.pitch, memory.roll, memory.pitching, memory.rolling = pitch, roll, pitching, rolling


@compiled
def level(
    force: FloatArray,
    turned: FloatArray,
    more: FloatArray,
    first: int,
    every: int,
    gravity: float,
    found: FloatArray,
) -> None:
    """Write the vertical acceleration (2.20) of the specific ``force``, shape (3, n).

    The angles are ``turned`` and what the lines ``more`` at the centres of bins add; sample 0 lies
    ``first`` samples behind the start of the first of these.
    """
    last, whole = more.shape[1] - 1, 2 * every
    for k in range(found.size):
        # In whole numbers, so that the share is the same wherever the lines begin.
        halves = 2 * (first + k) - every + 1
        b = halves // whole
        share = (halves - whole * b) / whole
        b, after = min(max(b, 0), last), min(max(b + 1, 0), last)
        theta = turned[0, k] + more[0, b] + share * (more[0, after] - more[0, b])
        phi = turned[1, k] + more[1, b] + share * (more[1, after] - more[1, b])
        s_t, c_t, s_p, c_p = sin(theta), cos(theta), sin(phi), cos(phi)
        x, y = force[0, k], force[1, k]
        if x != x:
            x = -gravity * s_t
        if y != y:
            y = gravity * c_t * s_p
        found[k] = -x * s_t + y * c_t * s_p + force[2, k] * c_t * c_p - gravity


@compiled
def between_bins(bins: FloatArray, first: int, every: int, found: FloatArray) -> None:
    """Write the lines through ``bins``, at their centres, at samples ``first`` on; flat outside."""
    last, whole = bins.size - 1, 2 * every
    for k in range(found.size):
        # In whole numbers, so that the share is the same however the samples are split.
        halves = 2 * (first + k) - every + 1
        b = halves // whole
        share = (halves - whole * b) / whole
        low, high = min(max(b, 0), last), min(max(b + 1, 0), last)
        found[k] = bins[low] + share * (bins[high] - bins[low])
