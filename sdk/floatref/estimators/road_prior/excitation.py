"""Longitudinal acceleration from the encoder, without phase, and the pitch response to it."""

from dataclasses import dataclass, field
from math import cos, exp, pi, sin, sqrt

import numpy as np

from floatref.kernels.compiling import compiled
from floatref.values.arrays import FloatArray, new_record

RESPONSE = np.dtype([(name, np.float64) for name in ("value", "rate", "latest")], align=True)
"""Response in m/s², its rate per second, and the latest acceleration."""


@compiled
def curvature(values: FloatArray, weights: FloatArray, found: FloatArray) -> None:
    """Write the sums of ``values`` k to k + n - 1 by the n ``weights`` into ``found[k]``."""
    for k in range(found.size):
        total = 0.0
        for j in range(weights.size):
            total += weights[j] * values[k + j]
        found[k] = total


@compiled
def respond(
    a: FloatArray, by: FloatArray, fade: float, memory: np.record, found: FloatArray
) -> None:
    """Write the response of an oscillator to ``a``; NaN there are made the latest, times ``fade``.

    ``memory`` is of `RESPONSE`; ``by``, shape (2, 4), holds what the next response and rate are
    made of: those three and the next of ``a``.
    """
    value, rate, latest = memory.value, memory.rate, memory.latest
    for k in range(a.size):
        if a[k] != a[k]:
            a[k] = fade * latest
        new = by[0, 0] * value + by[0, 1] * rate + by[0, 2] * latest + by[0, 3] * a[k]
        rate = by[1, 0] * value + by[1, 1] * rate + by[1, 2] * latest + by[1, 3] * a[k]
        value, latest = new, a[k]
        found[k] = value
    memory.value, memory.rate, memory.latest = value, rate, latest


SPREAD_S = 0.03
"""Standard deviation of the Gaussian that smooths the distance: half of the amplitude at 6 Hz."""
REACH = 4.0
"""Standard deviations to either side beyond which the Gaussian is nothing."""

FADE_S = 1.0
"""A brake is forgotten after so long without the encoder."""


def curvature_weights(interval_s: float) -> FloatArray:
    """Return weights whose sum over distances at ``interval_s`` is their second derivative.

    They are those of a Gaussian, exact for parabolas.
    """
    half = max(1, round(REACH * SPREAD_S / interval_s))
    place = np.arange(-half, half + 1) * interval_s
    bell = np.exp(-0.5 * (place / SPREAD_S) ** 2)
    weights: FloatArray = bell * (place**2 - (bell @ place**2) / bell.sum())
    return weights * (2.0 / (weights @ place**2))


def response_weights(hz: float, damping: float, interval_s: float) -> FloatArray:
    """Return what an oscillator's value and rate are made of, shape (2, 4).

    The columns are its value and rate ``interval_s`` before, the acceleration then, and the one
    now; in between that is linear, and the static gain is 1.
    """
    omega = 2.0 * pi * hz
    swing, decay = omega * sqrt(1.0 - damping**2), exp(-damping * omega * interval_s)
    cosine, sine = cos(swing * interval_s), sin(swing * interval_s) / swing
    free = decay * np.array(
        [
            [cosine + damping * omega * sine, sine],
            [-(omega**2) * sine, cosine - damping * omega * sine],
        ]
    )
    lag, slope = 2.0 * damping / omega, 1.0 / interval_s
    # What is left of the response to a line, (a_0 - lag slope, slope), decays freely.
    before = np.array([[1.0 + lag * slope, -lag * slope], [-slope, slope]])
    after = np.array([[lag * slope, 1.0 - lag * slope], [-slope, slope]])
    return np.hstack((free, after - free @ before))


@dataclass(eq=False)
class Excitation:
    """Acceleration and pitch response at nodes, as soon as the nodes behind are known.

    Their product, times the pitch angle per acceleration, is the leading error of (1.5).

    Attributes:
        weights: `curvature_weights`.
        by: `response_weights`.
        distances: at the nodes from the first that the next acceleration needs, in m.
        begun: whether the distances have been continued before the first.
        fade: where the encoder gives no travel, a brake goes on, less by this from node to node.
        memory: of `RESPONSE`.
    """

    weights: FloatArray
    by: FloatArray
    fade: float
    distances: FloatArray = field(default_factory=lambda: np.empty(0))
    begun: bool = False
    memory: np.record = field(default_factory=lambda: new_record(RESPONSE))

    @classmethod
    def of(cls, interval_s: float, hz: float, damping: float) -> "Excitation":
        """Return the one of nodes ``interval_s`` apart."""
        weights = curvature_weights(interval_s), response_weights(hz, damping, interval_s)
        return cls(*weights, exp(-interval_s / FADE_S))

    @property
    def reach(self) -> int:
        """Nodes to either side that an acceleration needs."""
        return self.weights.size // 2

    def add(self, distances: FloatArray) -> None:
        """Take the distances of the next nodes, in m."""
        self.distances = np.concatenate((self.distances, distances))
        if not self.begun and self.distances.size > self.reach:
            self._begin(self.reach)

    def end(self) -> None:
        """Continue the distances behind the last node."""
        if not self.begun and self.distances.size:
            self._begin(self.distances.size - 1)
        turned = _reflect(self.distances[::-1], min(self.reach, self.distances.size - 1))
        missing = np.full(self.reach - turned.size, turned[-1] if turned.size else np.nan)
        self.distances = np.concatenate((self.distances, turned, missing))

    def take(self) -> tuple[FloatArray, FloatArray]:
        """Return acceleration and response in m/s² at the next nodes, all that are known."""
        count = max(0, self.distances.size - 2 * self.reach) if self.begun else 0
        a, response = np.empty((2, count))
        curvature(self.distances, self.weights, a)
        respond(a, self.by, self.fade, self.memory, response)
        self.distances = self.distances[count:]
        return a, response

    def _begin(self, known: int) -> None:
        turned = _reflect(self.distances, known)[::-1]
        missing = np.full(self.reach - known, turned[0] if known else self.distances[0])
        self.distances = np.concatenate((missing, turned, self.distances))
        self.begun = True


def _reflect(distances: FloatArray, count: int) -> FloatArray:
    """Return ``count`` distances beyond the first, turned about it: as far the other way."""
    found: FloatArray = 2.0 * distances[0] - distances[1 : count + 1]
    return found
