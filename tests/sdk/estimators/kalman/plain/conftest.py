"""A filter and smoother of ten plain states, which extends (6.47) and (6.48) step by step.

The lean l adds l (u_ax - a_0) to the acceleration, a_0 being a running mean of that force where
the lean was last another; the drift adds to the height that GNSS reads; and at a stop, height
sensor and reference point have risen by the same since it began.
"""

from dataclasses import dataclass, field

import numpy as np
import pytest

from floatref.estimators.kalman import KalmanSmoother, Noise, Plan
from floatref_reference.appendix_c.measurement_model import matrix_h
from floatref_reference.appendix_c.process_model import matrix_a, matrix_w
from floatref_reference.chapter_6.section_6_3_6_system import f, h

BIAS, LEAN, DRIFT, OFFSET = 4, 7, 8, 9
START = (1.0, 1.0, 0.1, 0.1, 0.1, 0.01, 0.01)
DATUM_M = 100.0
PATIENCE_S = 0.5
EYE = np.eye(10)


@dataclass
class Ten:
    """The filter and the smoother of ten states, each step written out."""

    drive: object
    noise: Noise
    plan: Plan
    stored: list = field(default_factory=list)

    def __post_init__(self):
        d, n = self.drive, self.noise
        self.x = np.zeros(10)
        self.x[0] = d.height[0]
        self.P = np.diag(np.square([*START, n.lean_rad, 0.0, 0.0]))
        white = np.array([n.acceleration, n.roll_rate, n.pitch_rate, n.yaw_rate])
        walk = np.array([n.acceleration_walk, n.roll_rate_walk, n.pitch_rate_walk])
        self.Q = np.diag(np.concatenate((white**2 / d.dt, walk**2 * d.dt)))
        self.sub_block = max(1, round(0.01 / d.dt))
        self.standing = (d.speed < 0.16 / 3.6) & self.plan.reflects
        self.mean = np.vstack([(d.u[:-1] + d.u[1:]) / 2, d.u[-1:]])
        fixed = (d.quality == 4.0) & self.plan.gnss
        interval_s = np.minimum(np.diff(d.times_s[fixed], prepend=-1.0), 1.0)
        readings = zip(d.y[fixed], interval_s, strict=True)
        self.readings = dict(zip(d.at[fixed].tolist(), readings, strict=True))
        self.datum = d.y[fixed][:1, 0] - d.lever[2] - d.height[0]
        self.heard = self.latest = self.node = 0
        self.level = self.running = 0.0
        self.origin = self.captured = self.held = None

    def step(self, k):
        """Go from sample k - 1 to k; return the transition."""
        dt, x, u = self.drive.dt, self.x, self.mean[k - 1]
        A, W = EYE.copy(), np.zeros((10, 7))
        A[:7, :7], W[:7] = matrix_a(x[:7], u, dt), matrix_w(x[:7], dt)
        surge = (u[0] - self.level) * np.array([dt**2 / 2, dt])
        A[:2, LEAN] = surge
        self.x = np.concatenate((f(x[:7], u, dt), x[7:]))
        self.x[:2] += x[LEAN] * surge
        self.P = A @ self.P @ A.T + W @ self.Q @ W.T
        return A

    def begin(self, k):
        """Let states begin anew, and the drift walk until a reading; return what that does."""
        J = EYE.copy()
        if k in self.readings or k % self.sub_block == 0:
            self.follow(k)
        if self.standing[k] and self.origin is None and k % self.sub_block == 0:
            self.origin = self.drive.height[k] - self.x[0]
            J[OFFSET] = -EYE[0]
        elif self.steady(k) and not self.standing[k]:
            J[LEAN], J[BIAS, LEAN] = 0.0, self.running - self.level
            self.level = self.running
        self.P = J @ self.P @ J.T
        self.x = self.x + (J - EYE) @ (EYE[LEAN] * self.x[LEAN])
        if J[OFFSET, OFFSET] == 0.0:
            self.x[OFFSET] = 0.0
        if J[LEAN, LEAN] == 0.0:
            self.P[LEAN, LEAN] = self.noise.lean_rad**2
        self.origin = self.origin if self.standing[k] else None
        if k in self.readings and not self.standing[k]:
            walk = self.noise.gnss_height_walk**2 * (k - self.heard) * self.drive.dt
            self.P[DRIFT, DRIFT] += walk if self.captured is None else DATUM_M**2
            self.heard, self.captured = k, None
        return J

    def follow(self, k):
        """Let the running mean of a second follow the longitudinal force up to sample k."""
        if k > self.node:
            share = min(1.0, (k - self.node) * self.drive.dt)
            self.running += share * (self.mean[self.node : k, 0].mean() - self.running)
        self.node = k

    def steady(self, k):
        """Tell whether four seconds at a constant speed end at sample k, every fourth second."""
        second = self.drive.rate
        if k == 0 or k % (4 * second):
            return False
        speeds = np.diff(self.drive.distance[k - 4 * second : k + 1 : second])
        return speeds.min() > 5.0 and np.ptp(speeds) < 0.4

    def observed(self, k):
        """Return rows of H, what is read, what is expected, and variances at sample k."""
        rows = [*self.gnss(k), *self.constants(k)]
        if self.standing[k]:
            rows = [row for row in rows if row[0] > 0]
            if k % self.sub_block == 0:
                variance = self.noise.reflection**2 / (self.sub_block * self.drive.dt)
                H = EYE[0] + EYE[OFFSET]
                rows.append((0, H, self.drive.height[k] - self.origin, H @ self.x, variance))
        if k in self.readings:
            self.latest, self.held = k, None
        return rows

    def gnss(self, k):
        if k not in self.readings:
            return
        reading, interval_s = self.readings[k]
        y = reading - [self.datum[0], 0, 0, 0]
        variance = self.noise.readings()
        if not self.plan.attitude:
            y[2:], variance[2:] = 0.0, self.noise.constants(0.05)[2:]
        variance = variance * (1.0 if interval_s >= 0.045 else 0.05 / interval_s)
        H, expected = self.model(k)
        H[0, DRIFT], expected[0] = 1.0, expected[0] + self.x[DRIFT]
        for kind in np.flatnonzero(~np.isnan(y)):
            yield kind, H[kind], y[kind], expected[kind], variance[kind]

    def constants(self, k):
        heard = self.plan.gnss and k - self.latest < round(PATIENCE_S / self.drive.dt)
        if heard or k in self.readings or k % self.sub_block:
            return
        self.captured = self.model(k)[1][0] if self.captured is None else self.captured
        self.held = k
        yield from self.weighed(k, self.sub_block if k else (self.sub_block + 1) / 2)

    def weighed(self, k, steps):
        H, expected = self.model(k)
        variance = self.noise.constants(steps * self.drive.dt)
        for kind, y in enumerate([self.captured, 0.0, 0.0, 0.0]):
            yield kind, H[kind], y, expected[kind], variance[kind]

    def finish(self):
        """Let the constants held last count up to the last sample, and no further."""
        k = len(self.drive.u) - 1
        if self.held is None or k - self.held >= self.sub_block:
            return
        steps = k - self.held + (1 - self.sub_block) / 2
        rows = list(self.weighed(k, steps or 1e-9))[int(self.standing[self.held]) :]
        self.update(*(np.array(part) for part in zip(*rows, strict=True)))

    def model(self, k):
        d = self.drive
        H = np.hstack((matrix_h(self.x[:7], d.u[k], d.lever), np.zeros((4, 3))))
        return H, h(self.x[:7], d.u[k], d.lever)

    def filter(self):
        """Return the filtered heights."""
        for k in range(len(self.drive.u)):
            A = self.step(k) if k else EYE
            A = self.begin(k) @ A
            prior = self.x.copy(), self.P.copy()
            rows = self.observed(k)
            if rows:
                self.update(*(np.array(part) for part in zip(*rows, strict=True)))
            self.stored.append((A, *prior, self.x, self.P))
        return np.array([entry[3][0] for entry in self.stored])

    def update(self, _, H, y, expected, variance):
        K = self.P @ H.T @ np.linalg.inv(H @ self.P @ H.T + np.diag(variance))
        self.x = self.x + K @ (y - expected)
        left = EYE - K @ H
        self.P = left @ self.P @ left.T + K @ np.diag(variance) @ K.T

    def smooth(self):
        """Return the smoothed heights, by (6.17)."""
        self.finish()
        x_s = self.x
        found = [x_s[0]]
        for k in range(len(self.stored) - 2, -1, -1):
            A, x_next, P_next, _, _ = self.stored[k + 1]
            x, P = self.stored[k][3:]
            x_s = x + P @ A.T @ solved(P_next, x_s - x_next)
            found.append(x_s[0])
        return np.array(found[::-1])


def solved(P, b):
    """Return a solution of P a = b: by the states that are unknown, and by the rise in a stop."""
    T = EYE + np.outer(EYE[0], EYE[OFFSET])
    P, b = T @ P @ T.T, T @ b
    there = np.diag(P) > 1e-13 * P[OFFSET, OFFSET]
    scale = np.sqrt(np.diag(P)[there])
    found = np.zeros(10)
    scaled = P[np.ix_(there, there)] / np.outer(scale, scale)
    found[there] = np.linalg.solve(scaled, b[there] / scale) / scale
    return T.T @ found


@pytest.fixture(scope="session")
def assert_same(forward_of, height_of):
    """Return what compares the stage with the plain filter and smoother."""

    def compare(drive, noise, plan, within=1e-8):
        ten = Ten(drive, noise, plan)
        expected = ten.filter()
        ours = forward_of(KalmanSmoother(plan, noise), drive)
        np.testing.assert_allclose(ours, expected, rtol=0, atol=within)
        ours = height_of(KalmanSmoother(plan, noise, tolerance_m=0.0), drive)
        np.testing.assert_allclose(ours, ten.smooth(), rtol=0, atol=within)

    return compare
