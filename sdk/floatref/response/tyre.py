"""From the force of a tyre to the road under it: F = k·u + c·u'."""

from collections.abc import Sequence
from math import exp, expm1, inf, isfinite

import numpy as np

from floatref.errors import InputError
from floatref.response.model import Tyre
from floatref.values.arrays import BoolArray, FloatArray


class TyreRoad:
    """The road in m from forces in N, sample by sample, for p tyres.

    u' = (F - k·u)/c is integrated exactly for forces that change linearly between samples;
    without damping u = F/k. The first u is F/k as well: what that is wrong fades within some c/k,
    a few milliseconds. Calls with parts of a drive give the same as one with all of it.
    """

    def __init__(self, tyres: Sequence[Tyre], step_s: float) -> None:
        """Begin with samples ``step_s`` apart; InputError unless that is above zero, in s."""
        if not (isfinite(step_s) and step_s > 0):
            raise InputError(f"tyres: a time step of {step_s:g} s; give a number above zero")
        self._tyres = [_Tyre(tyre, step_s) for tyre in tyres]

    def advance(self, force: FloatArray, sigma: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the road and its standard deviation, both in m, shape (samples, p).

        ``force`` and its standard deviation ``sigma``, in N, have that shape. The standard
        deviation is the largest that errors of whatever correlation in time can leave. A force
        that is no number gives no road, and counts as the one before it for what follows.
        """
        if force.shape != sigma.shape or force.ndim != 2 or force.shape[1] != len(self._tyres):
            raise InputError(
                f"tyres: forces of shape {force.shape} with standard deviations of {sigma.shape}; "
                f"both must be (samples, {len(self._tyres)})"
            )
        road, spread = np.empty(force.shape), np.empty(force.shape)
        for at, tyre in enumerate(self._tyres):
            known = np.isfinite(force[:, at]) & np.isfinite(sigma[:, at])
            road[:, at] = tyre.road.advance(force[:, at], known)
            spread[:, at] = tyre.sigma.advance(sigma[:, at], known)
        return road, spread


class _Tyre:
    """The lags of one tyre; all their weights are positive, so that they bound a sigma, too."""

    def __init__(self, tyre: Tyre, step_s: float) -> None:
        steps = step_s * tyre.stiffness / tyre.damping if tyre.damping else inf
        mean = -expm1(-steps) / steps
        before, after = (mean - exp(-steps)) / tyre.stiffness, (1.0 - mean) / tyre.stiffness
        weights = exp(-steps), before, after
        self.road = _Lag(*weights, stiffness=tyre.stiffness)
        self.sigma = _Lag(*weights, stiffness=tyre.stiffness)


class _Lag:
    """u⁺ = stays·u + before·F + after·F⁺."""

    def __init__(self, stays: float, before: float, after: float, stiffness: float) -> None:
        self._stays, self._before, self._after = stays, before, after
        self._stiffness = stiffness
        self._force, self._road = np.nan, np.nan

    def advance(self, values: FloatArray, known: BoolArray) -> FloatArray:
        """Return u for every F in ``values``, NaN where it is not ``known``."""
        from scipy.signal import lfilter

        if np.isnan(self._force) and known.any():
            self._force = float(values[np.argmax(known)])
            self._road = self._force / self._stiffness
        force = _bridged(self._force, values, known)
        driven = self._before * force[:-1] + self._after * force[1:]
        road, _ = lfilter([1.0], [1.0, -self._stays], driven, zi=[self._stays * self._road])
        if road.size:
            self._force, self._road = float(force[-1]), float(road[-1])
        return np.where(known, road, np.nan)


def _bridged(first: float, values: FloatArray, known: BoolArray) -> FloatArray:
    """Return ``first`` and ``values`` after it, each that is not ``known`` as the one before."""
    series = np.concatenate([[first], values])
    at = np.where(np.concatenate([[True], known]), np.arange(series.size), 0)
    return np.asarray(series[np.maximum.accumulate(at)])
