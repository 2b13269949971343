"""Every stage of the golden vectors in single precision, to measure what that costs.

The stages are written so that nothing cancels, as firmware should write them; distance and time,
and the constants made of the settings, stay in double precision before they are rounded once.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref_reference.chapter_2.section_2_1_1_golden_car import state_transition

F = np.float32
Single = NDArray[np.float32]
Given = Mapping[str, Any]
SIXTH = (math.sqrt(2.0) - 1.0) ** (1 / 6)
ONE, TWO, THREE = F(1), F(2), F(3)


def tangents(cutoff: Any, step: float, count: int) -> Single:
    """Return c of (A.11) at every sample."""
    return np.broadcast_to(np.tan(np.pi * np.asarray(cutoff) * step).astype(F), count)


def low_1(x: Single, c: Single) -> Single:
    """Return LPF_B3S1, started by (A.12)."""
    y, s = [], x[0]
    for value, k in zip(x, c, strict=True):
        high = (value - s) / (ONE + k)
        s = s + TWO * k * high
        y.append(value - high)
    return np.array(y)


def low_2(x: Single, c: Single) -> Single:
    """Return LPF_B3S2, started by (A.13)."""
    y, s1, s2 = [], F(0), x[0]
    for value, k in zip(x, c, strict=True):
        high = (value - s2 - (ONE + k) * s1) / (ONE + k + k * k)
        band = s1 + k * high
        y.append(s2 + k * band)
        s1, s2 = s1 + TWO * k * high, s2 + TWO * k * band
    return np.array(y)


def high_1(x: Single, c: Single) -> Single:
    """Return HPF_B3S1, started by (A.14), as x less what has been removed."""
    y, removed, before = [], c[0] * x[0], c[0]
    for value, k in zip(x, c, strict=True):
        removed = removed + (before + k) * y[-1] if y else removed
        y.append((value - removed) / (ONE + k))
        before = k
    return np.array(y)


def high_2(x: Single, c: Single) -> Single:
    """Return HPF_B3S2, started by (A.15), as x less what has been removed."""
    k = c[0]
    a = k + k * k
    y = [x[0] * (ONE + k - THREE * k * k) / (ONE + a)]
    removed, step, last = x[0] * (THREE * k * k - k), -a * y[0], y[0]
    for value, k in zip(x[1:], c[1:], strict=True):
        b = a + k * k
        step = step + (k * k - k) * last
        removed = removed + step + TWO * b * y[-1]
        step, last = step + (b + k * k) * y[-1], y[-1]
        a = k + k * k
        y.append((value - removed) / (ONE + a))
    return np.array(y)


def state_1(x: Single, c: Single) -> Single:
    """Return HPF_B3S1 with the cut-off inside its integral."""
    y, s = [], c[0] * x[0]
    for value, k in zip(x, c, strict=True):
        y.append((value - s) / (ONE + k))
        s = s + TWO * k * y[-1]
    return np.array(y)


def state_2(x: Single, c: Single) -> Single:
    """Return HPF_B3S2 with the cut-off inside its integrals."""
    k = c[0]
    y = [x[0] * (ONE + k - THREE * k * k) / (ONE + k + k * k)]
    s1, s2 = (TWO * k - ONE) * y[0], x[0] + (k * k - TWO * k) * y[0]
    for value, k in zip(x[1:], c[1:], strict=True):
        y.append((value - s2 - (ONE + k) * s1) / (ONE + k + k * k))
        band = s1 + k * y[-1]
        s1, s2 = s1 + TWO * k * y[-1], s2 + TWO * k * band
    return np.array(y)


def integral(x: Single, steps: Any, start: float = 0.0) -> Single:
    """Return the trapezoidal integral of ``x``; ``steps`` are one or as many as samples."""
    step = np.broadcast_to(np.asarray(steps, F), x.size)
    added = (step * F(0.5))[1:] * (x[1:] + x[:-1])
    return np.array(list(accumulate(added, initial=F(start))), F)


def section(kernel: Callable[[Single, Single], Single], backward: bool) -> Callable[..., Any]:
    """Return the stage that runs ``kernel``, from the last sample to the first if ``backward``."""

    def apply(s: Given, i: Given) -> dict[str, Single]:
        x = i["x"].astype(F)
        c = tangents(i.get("cutoff", s.get("cutoff")), s["step"], x.size)
        return {"y": kernel(x[::-1], c[::-1])[::-1] if backward else kernel(x, c)}

    return apply


def frequency(speed: Any) -> Single:
    """Return (5.3) in Hz."""
    v = np.asarray(speed, F)
    high, rise = v / F(105.91), np.exp(F(2.5) * (v - F(2.778)))
    return high + (F(0.45) - high) / (ONE + rise)


def wave_number(speed: Any, interval_m: float) -> Single:
    """Return (5.3) in cycles/m, at least four intervals long."""
    v, largest = np.asarray(speed, F), F(0.25 / interval_m)
    f = frequency(v)
    return np.where(f >= largest * v, largest, f / np.maximum(v, F(1e-9)))


def travel_speed(distance: NDArray[np.float64], rate_hz: float) -> NDArray[np.float64]:
    """Return the speed; distance stays in double precision."""
    n = max(1, round(0.05 * rate_hz))
    past = np.concatenate((np.full(n, distance[0]), distance))[: distance.size]
    return (distance - past) * rate_hz / n


def captured(x: Single, points: Sequence[tuple[int, Any]]) -> Single:
    """Return ``x`` at the points; which sample a point takes is found in double precision."""
    before = (x[max(i - 1, 0)] + F(part) * (x[i] - x[max(i - 1, 0)]) for i, part in points)
    return np.array([x[i] if p == 1 else z for (i, p), z in zip(points, before, strict=True)])


def adjusted(time_step: Any, interval_m: float) -> Single:
    """Return dt_adj of (5.8) without a power of a large number."""
    ratio, beta = np.asarray(time_step, F) / F(interval_m / 3.576), F(25)
    short, long = np.minimum(ratio, ONE), np.maximum(ratio, ONE)
    below = short - np.expm1(np.log1p(short**beta) / beta)
    above = ONE - long * np.expm1(np.log1p((ONE / long) ** beta) / beta)
    return F(interval_m / 3.576) * np.where(ratio > 1, above, below)


def reflected(v: Single, adj: Single, dt: Single, h: Single) -> Single:
    """Return (5.9)."""
    ratio = np.divide(adj, dt, out=np.ones_like(dt), where=dt > 0)[1:]
    mirror = (ONE - ratio * ratio) * np.diff(h)
    added = F(0.5) * adj[1:] * (v[1:] + v[:-1]) + mirror
    return np.array(list(accumulate(added, initial=F(0))), F)


def controlled(x: Single, speed: Single, s: Given) -> Single:
    """Return the velocity that the PI controller of section 5.6 leaves."""
    half, p, gain = F(0.5 / s["rate_hz"]), F(s["proportional"]), F(s["integral_per_s"])
    y, o, area, active = [], F(0), F(0), False
    for k, (d, low) in enumerate(zip(x, speed < F(s["below_mps"]), strict=True)):
        if not low:
            o = y[-1] - x[k - 1] if active else o
            y.append(d + o)
        elif not active:
            area = F(0)
            y.append((d + o) / (ONE + p))
        else:
            area = area + half * y[-1]
            y.append((d + o - gain * area) / (ONE + p + gain * half))
            area = area + half * y[-1]
        active = bool(low)
    return np.array(y)


def observed(a: Single, h: Single, c: Single, dt: float) -> Single:
    """Return e = r - h of the observer, trapezoidal with the cut-off inside its integrals."""
    half, per, square = F(dt / 2), F(2 / dt), F(4 / dt**2)
    v = b = e = F(0)
    r, out = h[0], [F(0)]
    for k in range(1, a.size):
        past, now = c[k - 1], c[k]
        known_b = b - square * past**3 * e
        known_v = v + half * (a[k] + known_b + a[k - 1] + b) - TWO * per * past**2 * e
        known_r = r + half * (known_v + v) - TWO * past * e
        e = (known_r - h[k]) / (ONE + TWO * now + TWO * now**2 + now**3)
        b = known_b - square * now**3 * e
        v = known_v - per * (now**3 + TWO * now**2) * e
        r = known_r - (now**3 + TWO * now**2 + TWO * now) * e
        out.append(e)
    return np.array(out)


def trace(z: Single, interval_m: float) -> Single:
    """Return steps 1 to 3 of the IRI in m/km."""
    slope, n = np.diff(z) / F(interval_m), round(0.25 / interval_m)
    smooth = [np.mean(slope[k : k + n], dtype=F) for k in range(slope.size)]
    start = round(11.0 / interval_m)
    S, P = (m.astype(F) for m in state_transition(interval_m * 3.6 / 80.0))
    first = (z[start] - z[0]) / F(start * interval_m)
    X, out = np.array([first, 0, first, 0], F), []
    for y in smooth:
        X = S @ X + P * y
        out.append(F(1000) * (X[0] - X[2]))
    return np.array(out)


def agreement(p: Single, q: Single, interval_m: float) -> tuple[Any, ...]:
    """Return score, correlation, amplitude factor and offset."""
    largest, best = int(1.0 / interval_m + 1e-9), (F(-2), F(0), 0)
    for lag in range(-largest, largest + 1):
        x = p[max(0, -lag) : min(p.size, q.size - lag)]
        y = q[max(0, lag) : min(q.size, p.size + lag)]
        x, y = x - x.mean(), y - y.mean()
        sx, sy = np.sqrt(np.mean(x * x)), np.sqrt(np.mean(y * y))
        found = np.mean(x * y) / (sx * sy), min(sx, sy) / max(sx, sy), lag
        best = max(best, found, key=lambda each: each[0])
    rho, gamma, lag = best
    return rho * gamma, rho, gamma, lag * interval_m
