"""The pitch of all fits over a run: what the smoother gets, bin by bin."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from floatref.estimators.laser_place.bins import in_parts
from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.elevation_sigma import elevation_sigma
from floatref.estimators.road_slope.gauss_newton import Fit, fit
from floatref.estimators.road_slope.readings import Drive, Readings
from floatref.estimators.road_slope.rows import Stretch
from floatref.estimators.road_slope.stretches import find_active, find_stretches
from floatref.values.arrays import BoolArray, FloatArray

UNSETTLED_RAD = 3e-3
"""Change of a pitch by the last pass with which nothing is known of a stretch."""
UNLIKELY = 33.0
"""Sum of the squares by which twelve constants are off what is known before, over their 1-σ: one
vehicle in a thousand has that. Above it something else went into them."""
LOST_REACH_M = 40.0
"""Without the encoder somewhere in a stretch its brake is not known; what is then off by the road
under the wheels is off about where the vehicle is slowest, for two lengths of a crown."""
UNKNOWN_M = 0.05
"""1-σ of the elevation where nothing is known, so that it is flagged."""
RAMP_S = 1.0
"""Time in which the correction comes and goes at the ends of a stretch."""
MARKS_M = 8.0
"""Distance between places at which the 1-σ is found."""


@dataclass(eq=False)
class Levelled:
    """What was found of a run, each of shape (n,) for its bins.

    Attributes:
        share: 1 where the pitch is known, 0 where it is not.
        pitch: θ in rad, nose up, where ``share`` is not 0.
        lean: λ in rad there.
        grade: the mean slope of the road there, which a high-pass removes.
        sigma_m: 1-σ of the high-passed elevation that comes from both.
        gains: of all stretches, see `known_gains`. A fit itself, of 4 MB, is let go.
    """

    share: FloatArray
    pitch: FloatArray
    lean: FloatArray
    grade: FloatArray
    sigma_m: FloatArray
    gains: list[tuple[FloatArray, FloatArray]]
    unknown_reach_m: ClassVar[float] = np.inf
    """How far about the place of the least speed a stretch is unsure whose fit is not believed."""

    @classmethod
    def of(cls, drive: Drive, places: Places, model: SlopeModel, wavelength_m: float) -> "Levelled":
        """Fit every stretch of ``drive`` and blend those that share their ends."""
        stretches = find_stretches(drive)
        # Each an array of its own, of which only what is written takes memory: most of a run lies
        # between stretches, and those that are done with are let go.
        share, pitch, lean, grade, sigma, fitted = (np.zeros(drive.force.size) for _ in range(6))
        found = cls(share, pitch, lean, grade, sigma, [])
        for pieces in stretches:
            inside = slice(pieces[0].start, pieces[-1].stop)
            weight = _ramp(inside.stop - inside.start, drive.step)
            fitted[inside] += weight
            if drive.lost[inside].any():
                near = _about_the_slowest(drive, inside, LOST_REACH_M)
                found.sigma_m[inside] += weight * UNKNOWN_M * near
                continue
            result = fit(Stretch(Readings.of(drive, pieces, model.interval_s), places, model))
            sigma_m = found._take(result, drive, inside, weight, wavelength_m)
            sigma_m *= weight
            found.sigma_m[inside] += sigma_m
        found._blend(fitted)
        return found

    def _take(
        self, result: Fit, drive: Drive, inside: slice, weight: FloatArray, wavelength_m: float
    ) -> FloatArray:
        """Add one fit with its ``weight`` if it is believed, and return its 1-σ in m."""
        self.gains += known_gains([result])
        sigma_m = _sigma(result, drive.distance[inside], wavelength_m)
        if not is_believed(result):
            return sigma_m * _about_the_slowest(drive, inside, self.unknown_reach_m)
        for part in in_parts(inside.start, inside.stop):
            own = slice(part.start - inside.start, part.stop - inside.start)
            self._add(result, part, weight[own])
        return sigma_m

    def _blend(self, fitted: FloatArray) -> None:
        """Make means of the weighted sums; ``fitted`` is the weight of all fits, shape (n,)."""
        for part in in_parts(0, fitted.size):
            if fitted[part].any():
                known = np.maximum(self.share[part], np.finfo(np.float64).tiny)
                for each in (self.pitch, self.lean, self.grade):
                    each[part] /= known
                self.sigma_m[part] /= np.maximum(fitted[part], 1.0)
                self.share[part] = np.minimum(self.share[part], 1.0)

    def _add(self, result: Fit, inside: slice, weight: FloatArray) -> None:
        """Add one fit with its ``weight`` in the bins ``inside``."""
        bins, nodes = np.arange(inside.start, inside.stop), result.stretch.readings.bins
        pitch = result.unknowns[result.stretch.layout.pitch]
        self.pitch[inside] += weight * np.interp(bins, nodes, pitch)
        self.lean[inside] += weight * result.of("lean")
        self.grade[inside] += weight * result.grade
        self.share[inside] += weight

    def hold(self, values: FloatArray, outside: FloatArray) -> FloatArray:
        """Return ``values`` where they are known, and ``outside`` bent to meet them elsewhere."""
        known = self.share > 0.0
        if not known.any():
            return outside
        held, before = np.empty(values.size), np.empty(0, np.int64)
        for part in in_parts(0, values.size):
            here = part.start + np.flatnonzero(known[part])
            rest = known[part.stop :]
            behind = [part.stop + int(rest.argmax())] if rest.any() else []
            knots = np.concatenate([before, here, behind]).astype(np.int64)
            off = np.interp(np.arange(part.start, part.stop), knots, values[knots] - outside[knots])
            held[part] = outside[part] + off
            before = here[-1:] if here.size else before
        return held


def _about_the_slowest(drive: Drive, inside: slice, reach_m: float) -> BoolArray:
    """Return which bins are within ``reach_m`` of where a brake is slowest, shape (n,).

    Beside the brake the speed may be as low for long, and the place of its least value is anywhere.
    """
    place, speed, braked = drive.distance[inside], drive.speed[inside], find_active(drive)[inside]
    if braked.any():
        speed = np.where(braked, speed, np.inf)
    return np.asarray(np.abs(place - place[np.argmin(speed)]) <= reach_m)


def is_believed(result: Fit) -> bool:
    """Return whether a fit has settled on a vehicle that there may be."""
    return result.changed_rad < UNSETTLED_RAD and result.prior_misfit < UNLIKELY


def _sigma(result: Fit, distance: FloatArray, wavelength_m: float) -> FloatArray:
    """Return 1-σ of the high-passed elevation at every ``distance``, shape (n,), in m."""
    if not is_believed(result):
        return np.full(distance.size, UNKNOWN_M)
    begin, end = float(distance[0]), float(distance[-1])
    marks = np.linspace(begin, end, max(2, round((end - begin) / MARKS_M) + 1))
    try:
        return np.interp(distance, marks, elevation_sigma(result, marks, wavelength_m))
    except np.linalg.LinAlgError:
        return np.full(distance.size, UNKNOWN_M)


def _ramp(size: int, step: float) -> FloatArray:
    """Return weights that rise to 1 at the begin and fall from it at the end, shape (size,)."""
    width = max(1, round(RAMP_S / step))
    end = min(width, (size + 1) // 2)
    weights, rise = np.ones(size), np.arange(1.0, end + 1.0) / width
    weights[:end], weights[size - end :] = rise, rise[::-1]
    return weights


def known_gains(fits: Sequence[Fit]) -> list[tuple[FloatArray, FloatArray]]:
    """Return -λ and -κ, shape (2,), of every fit that is believed, and their covariance, (2, 2).

    A fit whose covariance is lost in rounding is left out.
    """
    found = []
    for each in fits:
        if is_believed(each):
            size, place = each.stretch.layout.size, each.stretch.layout.place
            weights = np.zeros((2, size))
            weights[0, place("lean")] = weights[1, place("gain")] = -1.0
            estimate = np.array([-each.of("lean"), -each.of("gain")])
            with suppress(np.linalg.LinAlgError):
                found.append((estimate, each.covariance(weights)))
    return found
