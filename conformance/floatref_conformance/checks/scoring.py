"""Compare a profile with the truth: on the same points, with the same filter."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from floatref.errors import InputError
from floatref.measures import cross_correlation, high_pass, iri_trace, on_common_grid
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.evidence import CorrelationLoss, Pair, RoughnessError
from floatref_conformance.checks.stretches import points, stretch
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits

LEAD_M = 120.0
"""Distance in m from the start of the IRI's car to the scored stretch."""
MAX_OFFSET_M = 1.0
"""Largest lag of a correlation, in m."""


@dataclass(frozen=True, eq=False)
class Compared:
    """One wheel path of a result and of the truth, on the truth's points; all of shape (n,).

    Attributes:
        track: its name.
        distance_m: of the points.
        truth: elevation along the laser's path in m, high-pass filtered (-3 dB at 91.44 m).
        result: delivered elevation in m; NaN where it is missing.
        valid: which points the device marks valid.
        interval_m: between points.
    """

    track: str
    distance_m: FloatArray
    truth: FloatArray
    result: FloatArray
    valid: BoolArray
    interval_m: float

    def whole(self, start_m: float, end_m: float) -> Pair:
        """Return both up to ``end_m``, with a lead before ``start_m``; all points between count.

        Raises DeviceError for a point without elevation there.
        """
        delivered = Profile(
            self.interval_m,
            (ProfileTrack.of(self.track, self.result),),
            float(self.distance_m[0]),
        )
        stretch(delivered, self.track, start_m, end_m)
        inside = points(delivered, start_m - LEAD_M, end_m)
        counted = self.distance_m[inside][:-1] >= start_m - self.interval_m / 1e6
        return self._pair(inside, counted)

    def without(self, left_out: BoolArray) -> "Compared":
        """Return this with the truth's shape, and so no error, at the points ``left_out``.

        What is left out has shape (n,). Other points without elevation stay without.
        """
        missing = np.where(left_out, np.nan, self.result)
        filled = np.where(left_out, bridge(missing, self.truth), self.result)
        return replace(self, result=filled)

    def unflagged(self) -> Pair | None:
        """Return both, counted where points are valid; None if no two adjacent ones are."""
        counted = self.valid[:-1] & self.valid[1:]
        return self._pair(slice(None), counted) if counted.any() else None

    def _pair(self, inside: slice, counted: BoolArray) -> Pair:
        truth = self.truth[inside]
        return Pair(truth, bridge(self.result[inside], truth), self.interval_m, counted)


def compare(truth: Profile, profile: Profile) -> tuple[Compared, ...]:
    """Return every wheel path of the unfiltered ``truth`` with that of ``profile``."""
    true, found = on_common_grid(filter_truth(truth), profile)
    return tuple(
        Compared(
            t.name,
            true.distance_m,
            t.elevation,
            found.track(t.name).elevation,
            found.track(t.name).valid,
            true.interval_m,
        )
        for t in true.tracks
    )


def filter_truth(truth: Profile) -> Profile:
    """Return ``truth`` after the high-pass of a profile (-3 dB at 91.44 m)."""
    tracks = tuple(
        ProfileTrack.of(t.name, high_pass(t.elevation, truth.interval_m)) for t in truth.tracks
    )
    return replace(truth, tracks=tracks)


def bridge(result: FloatArray, truth: FloatArray) -> FloatArray:
    """Return ``result`` with the shape of ``truth`` where it has no elevation.

    The car of the IRI also drives over points that were not measured. With this shape they add no
    error of the device.
    """
    missing = np.isnan(result)
    if not missing.any() or missing.all():
        return truth.copy() if missing.any() else result
    index = np.arange(result.size)
    error = np.interp(index, index[~missing], (result - truth)[~missing])
    return np.where(missing, truth + error, result)


def correlation(pair: Pair, track: str, limits: Limits) -> Measurement:
    """Return one minus (2.16) of the IRI filter's outputs within lags of `MAX_OFFSET_M`."""
    true, found = _traces(pair)
    agreed = cross_correlation(true, found, pair.interval_m, MAX_OFFSET_M)
    lag = round(agreed.offset_m / pair.interval_m)
    loss, evidence = 1.0 - agreed.cross_correlation, CorrelationLoss(pair, lag)
    return Measurement("correlation loss", track, loss, "", limits, evidence)


def roughness_percent(pair: Pair, track: str, limits: Limits) -> Measurement:
    """Return the magnitude of the IRI's error in percent of the truth's."""
    true, found = _roughness(pair)
    error = 100.0 * abs(found - true) / true
    return Measurement("IRI error", track, error, "%", limits, RoughnessError(pair, True))


def roughness_within(
    pair: Pair, track: str, quantity: str, either: Mapping[DeviceClass, tuple[float, float]]
) -> Measurement:
    """Return the magnitude of the IRI's error in m/km.

    ``either`` holds, per class that limits it, percent of the truth's IRI and m/km: the larger
    of the two is the limit.
    """
    true, found = _roughness(pair)
    limits = {c: max(percent * true / 100.0, least) for c, (percent, least) in either.items()}
    error = abs(found - true)
    return Measurement(quantity, track, error, "m/km", limits, RoughnessError(pair, False))


def better(first: Measurement, second: Measurement, device_class: DeviceClass) -> Measurement:
    """Return the one that is farther within its limit of ``device_class``, with that limit."""
    chosen = min((first, second), key=lambda m: m.ratio(device_class))
    return replace(chosen, limits={device_class: chosen.limits[device_class]})


def _roughness(pair: Pair) -> tuple[float, float]:
    true, found = (float(np.abs(trace).mean()) for trace in _traces(pair))
    return refuse_flat(true), found


def refuse_flat(true_m_per_km: float) -> float:
    """Return the IRI of a true road; InputError for 0, where a relative error is undefined."""
    if true_m_per_km == 0:
        raise InputError("the road that is judged is flat; give one with an IRI above 0")
    return true_m_per_km


def _traces(pair: Pair) -> tuple[FloatArray, FloatArray]:
    true, found = (iri_trace(z, pair.interval_m) for z in (pair.truth, pair.result))
    return true[pair.counted], found[pair.counted]
