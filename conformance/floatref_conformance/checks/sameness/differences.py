"""Compare two results of one road: their differences, and the rise of the error."""

from dataclasses import dataclass, replace

import numpy as np

from floatref.measures import iri_trace
from floatref.values.arrays import FloatArray
from floatref_conformance.checks.evidence import CorrelationLoss, Pair, Reference, RoughnessError
from floatref_conformance.checks.scoring import Compared, correlation, refuse_flat, roughness_within
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits, same_limit

NOMINAL, ADEQUATE, REFERENCE = DeviceClass
LOSS_LIMITS: Limits = {NOMINAL: 0.008, ADEQUATE: 0.005, REFERENCE: 0.002}
ROUGHNESS_LIMITS: Limits = {NOMINAL: 0.5, ADEQUATE: 0.3, REFERENCE: 0.2}
"""In percent. Both are a tenth of each class's limit at constant speed."""
PLACE_LIMITS: Limits = same_limit(0.02, 0.01)
"""In m: samples at 2 kHz and 97 km/h are 13.5 mm apart, readings of the laser 8.3 mm."""
RISE_PERCENT = 10.0
"""Allowed rise of the IRI's error, in percent of it."""
RISE_LIMITS: Limits = {NOMINAL: 0.10, ADEQUATE: 0.06, REFERENCE: 0.04}
"""Additional rise in m/km: 5, 3 and 2 % of an IRI of 2 m/km, because of new noise."""


@dataclass(frozen=True, eq=False)
class RoughnessDifference:
    """Two results, each with the truth, for the difference of their IRI in percent of its IRI."""

    before: Pair
    after: Pair

    def value(self, reference: Reference) -> float:
        """Return the magnitude of the difference."""
        true, one = (_mean(trace) for trace in self.before.traces(reference))
        other = _mean(self.after.traces(reference)[1])
        return 100.0 * abs(other - one) / true


@dataclass(frozen=True, eq=False)
class ErrorRise:
    """Two results, each with its truth, for the rise of the IRI's error."""

    before: Pair
    after: Pair

    def value(self, reference: Reference) -> float:
        """Return the rise of the error's magnitude, in m/km; 0 without a rise."""
        errors = [RoughnessError(p, False).value(reference) for p in (self.before, self.after)]
        return max(errors[1] - errors[0], 0.0)


def measure_differences(
    before: Compared, after: Compared, start_m: float, end_m: float
) -> tuple[Measurement, ...]:
    """Return the differences of two results from ``start_m`` to ``end_m``: shape, IRI, place.

    Both are on the same truth's points. Raises DeviceError for a point without elevation there.
    """
    first, second = (compared.whole(start_m, end_m) for compared in (before, after))
    pair = Pair(first.result, second.result, first.interval_m, first.counted)
    loss = correlation(pair, before.track, LOSS_LIMITS)
    return (
        replace(loss, quantity="correlation loss between both"),
        _roughness_difference(first, second, before.track),
        Measurement(
            "displacement between both", before.track, _lag_m(loss, pair), "m", PLACE_LIMITS
        ),
    )


def measure_rise(before: Pair, after: Pair, track: str) -> Measurement:
    """Return the rise of the IRI's error from ``before`` to ``after``, in m/km."""
    errors = [roughness_within(pair, track, "", {}).value for pair in (before, after)]
    share = RISE_PERCENT / 100.0 * errors[0]
    limits = {c: share + more for c, more in RISE_LIMITS.items()}
    return Measurement(
        "rise of the IRI error",
        track,
        max(errors[1] - errors[0], 0.0),
        "m/km",
        limits,
        ErrorRise(before, after),
    )


def _roughness_difference(first: Pair, second: Pair, track: str) -> Measurement:
    true, one, other = (
        _mean(iri_trace(z, first.interval_m)[first.counted])
        for z in (first.truth, first.result, second.result)
    )
    value = 100.0 * abs(other - one) / refuse_flat(true)
    evidence = RoughnessDifference(first, second)
    return Measurement("IRI difference of both", track, value, "%", ROUGHNESS_LIMITS, evidence)


def _mean(trace: FloatArray) -> float:
    return float(np.abs(trace).mean())


def _lag_m(loss: Measurement, pair: Pair) -> float:
    evidence = loss.evidence
    return abs(evidence.lag) * pair.interval_m if isinstance(evidence, CorrelationLoss) else np.nan
