"""How late a height is in one short window in which the body alone moves.

There height and twice integrated acceleration are one signal, except for the constants of
integration: h(t) = g·z(t − τ) + parabola. By least squares τ is the slope of the phase of their
cross spectrum against frequency, every frequency weighted by how fast the body moves at it. A taper
weighs the middle of the window most: the jolt at which a stop begins moves more than the body.
Acceleration and height must not be tapered before the integration, or a swing that decays shifts.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from floatref.measures.clocks.skew_series import BEYOND, RATE_HZ, STEP_S
from floatref.values.arrays import FloatArray

LARGEST = 10
"""Largest skew in steps of the grid either way: 50 ms."""
ROUNDS, SETTLED_S = 6, 1e-8
"""Most rounds, and the step of the skew in s behind which another one changes nothing."""
LEAST_ALIKE = 0.8
"""Least correlation at the best whole step; half a step lowers it by 0.05 at 20 Hz."""


@dataclass(frozen=True)
class SkewWindow:
    """The result of one window.

    Attributes:
        first: its first point on the grid.
        skew_s: by how much the height is later, in s.
        gain: of the height against the twice integrated acceleration.
        rest: share of the height's motion that is not explained, as a ratio of amplitudes.
        motion_m: root mean square of the height's motion, tapered, in m.
        omega: root mean square frequency of the motion, in rad/s.
    """

    first: int
    skew_s: float
    gain: float
    rest: float
    motion_m: float
    omega: float

    def sigma_s(self, gain: float = 1.0) -> float:
        """Return the standard deviation of the skew, in s, if ``gain`` is the sensors' own.

        The unexplained motion may be a quarter of a period off as well as in phase, and a road or a
        tilt under the swing repeats with it: averaging is not taken to reduce it.
        """
        return float(np.hypot(self.gain - gain, self.rest)) / self.omega


def skew_window(force: FloatArray, height: FloatArray, first: int, count: int) -> SkewWindow | None:
    """Return the result of ``count`` points from ``first`` on.

    None if samples are missing or beyond all numbers that a sensor gives, and where the two do not
    correlate at any skew.

    ``force`` in m/s² and ``height`` in m, on one grid of `RATE_HZ`.
    """
    begin, end = first - LARGEST - 1, first + count + LARGEST + 1
    if begin < 0 or end > force.size:
        return None
    acceleration, seen = force[begin:end], height[first : first + count]
    # NaN is not less either.
    if not max(np.abs(acceleration).max(), np.abs(seen).max()) < BEYOND:
        return None
    body = _Body(acceleration, count)
    y = body.bare(seen)
    skew_s, alike = body.roughly(y)
    if alike < LEAST_ALIKE:
        return None
    for _ in range(ROUNDS):
        (gain, late), z, v = body.fit(y, skew_s)
        if not gain > 0:
            return None
        skew_s = min(max(skew_s + late / gain, -LARGEST * STEP_S), LARGEST * STEP_S)
        if abs(late) < SETTLED_S * gain:
            break
    if abs(skew_s) >= LARGEST * STEP_S:
        return None
    rest = y - gain * z + late * v
    size = float(np.linalg.norm(y))
    return SkewWindow(
        first,
        skew_s,
        gain,
        float(np.linalg.norm(rest)) / size,
        size / count**0.5,
        float(np.linalg.norm(v) / np.linalg.norm(z)),
    )


@lru_cache(maxsize=16)
def _frame(count: int) -> tuple[FloatArray, FloatArray]:
    """Return an orthonormal basis of parabolas over ``count`` points, and the taper."""
    basis, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, count), 3))
    return basis, np.sin(np.pi * (np.arange(count) + 0.5) / count)


class _Body:
    """Velocity and place of the body by integration, over a window and its surroundings."""

    def __init__(self, acceleration: FloatArray, count: int) -> None:
        self.count = count
        self.velocity = _integral(acceleration - acceleration.mean())
        self.velocity -= self.velocity.mean()
        self.place = _integral(self.velocity)
        self.open, self.taper = _frame(count)

    def bare(self, series: FloatArray) -> FloatArray:
        """Return ``series`` tapered, without the parabola of the constants of integration."""
        return np.asarray(self.taper * (series - self.open @ (self.open.T @ series)))

    def roughly(self, y: FloatArray) -> tuple[float, float]:
        """Return the skew in whole steps that explains most of ``y``, in s, and the correlation."""
        shifted = np.lib.stride_tricks.sliding_window_view(self.place[1:-1], self.count)
        z = self.taper * (shifted - (shifted @ self.open) @ self.open.T)
        sizes = np.maximum(np.linalg.norm(z, axis=1) * float(np.linalg.norm(y)), 1e-300)
        alike = z @ y / sizes
        best = int(np.argmax(alike))
        # The first of them begins earliest: the place that comes latest.
        return STEP_S * (LARGEST - best), float(alike[best])

    def fit(
        self, y: FloatArray, skew_s: float
    ) -> tuple[tuple[float, float], FloatArray, FloatArray]:
        """Return gain and gain·(further skew in s) of ``y``, with place and velocity by then."""
        whole, s = divmod(LARGEST + 1 - skew_s * RATE_HZ, 1.0)
        here = slice(int(whole), int(whole) + self.count)
        there = slice(here.start + 1, here.stop + 1)
        # Cubic between points, by place and velocity at both.
        v0, v1 = self.velocity[here], self.velocity[there]
        z = (1 + 2 * s) * (1 - s) ** 2 * self.place[here]
        z += s**2 * (3 - 2 * s) * self.place[there]
        z += s * (1 - s) * STEP_S * ((1 - s) * v0 - s * v1)
        z, v = self.bare(z), self.bare(v0 * (1 - s) + v1 * s)
        return _solve(z, v, y), z, v


def _solve(z: FloatArray, v: FloatArray, y: FloatArray) -> tuple[float, float]:
    """Return a and b of a z − b v that is nearest to ``y``; zeros where both are one signal."""
    zz, zv, vv, zy, vy = (float(p @ q) for p, q in ((z, z), (z, v), (v, v), (z, y), (v, y)))
    size = zz * vv - zv * zv
    if not size > 1e-12 * zz * vv:
        return 0.0, 0.0
    return (zy * vv - vy * zv) / size, (zy * zv - vy * zz) / size


def _integral(series: FloatArray) -> FloatArray:
    """Return the integral of the cubic through the points, 0 at the first of them."""
    # Beyond either end the series goes on along the line of its last two points.
    before = np.append(2.0 * series[0] - series[1], series[:-2])
    behind = np.append(series[2:], 2.0 * series[-1] - series[-2])
    steps = 13.0 * (series[1:] + series[:-1]) - before - behind
    return np.concatenate([[0.0], np.cumsum(steps) * (STEP_S / 24.0)])
