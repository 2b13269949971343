"""Compare two results of one recording, without and with a fault, with the truth."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from floatref.measures import high_pass, iri_trace
from floatref.values.arrays import BoolArray, FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.evidence import Pair, Reference
from floatref_conformance.checks.faults.injection import Faulty
from floatref_conformance.checks.flags import EVENT_LIMITS
from floatref_conformance.checks.scoring import Compared, bridge, compare, roughness_within
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits

NOMINAL, ADEQUATE, REFERENCE = DeviceClass
ROUGHNESS: Mapping[DeviceClass, tuple[float, float]] = MappingProxyType(
    {NOMINAL: (5.0, 0.10), ADEQUATE: (3.0, 0.06), REFERENCE: (2.0, 0.04)}
)
"""Largest error of the IRI of the valid points: percent of it, or m/km."""
BASE_M = 7.62
"""Base length of the short-interval roughness in m: 25 ft."""
WHOLE_M = 160.9
LOCAL_LIMITS: Limits = {c: least * WHOLE_M / BASE_M for c, (_, least) in ROUGHNESS.items()}
"""An error of the IRI over 160.9 m if it lies only within `BASE_M`, in m/km."""
FLAGGED_LIMITS: Mapping[str, Limits] = MappingProxyType(
    {
        "laser": {NOMINAL: 10.0, ADEQUATE: 10.0, REFERENCE: 5.0},
        "accelerometer": {NOMINAL: 250.0, ADEQUATE: 106.0, REFERENCE: 53.0},
        "gap": {NOMINAL: 250.0, ADEQUATE: 106.0, REFERENCE: 53.0},
        "encoder": EVENT_LIMITS,
        "gnss": {NOMINAL: 250.0, ADEQUATE: 106.0, REFERENCE: 53.0},
        "imu": {NOMINAL: 250.0, ADEQUATE: 106.0, REFERENCE: 53.0},
        "response": {NOMINAL: 250.0, ADEQUATE: 106.0, REFERENCE: 53.0},
    }
)
"""Largest flagged length beyond the fault itself, in m, by the faulty part."""


@dataclass(frozen=True, eq=False)
class LocalDifference:
    """Two results whose roughness is compared where both are valid."""

    pair: Pair

    def value(self, reference: Reference) -> float:
        """Return the largest mean difference of the IRI filter's outputs over `BASE_M`."""
        outputs = [
            np.asarray(reference.iri_trace(z, self.pair.interval_m), dtype=np.float64)
            for z in (self.pair.truth, self.pair.result)
        ]
        return _largest_mean(outputs[1] - outputs[0], self.pair)


def compare_everywhere(
    truth: Profile, profile: Profile, faulty: Faulty | None = None
) -> tuple[Compared, ...]:
    """Return every wheel path on all of the truth's points, without the encoder's error.

    Points that the device did not deliver or the encoder did not count have no elevation.
    """
    early = _everywhere(truth, profile)
    if faulty is None or faulty.shift_m == 0.0:
        return early
    moved = replace(profile, start_m=profile.start_m - faulty.shift_m)
    late = _everywhere(truth, moved)
    behind_m = faulty.at_m + max(-faulty.shift_m, 0.0)
    return tuple(_join(*both, faulty.at_m, behind_m) for both in zip(early, late, strict=True))


def measure_fault(
    before: Compared, after: Compared, faulty: Faulty, part: str
) -> tuple[Measurement, ...]:
    """Return the effect of a fault of ``part``: unflagged errors and the flagged length.

    ``before`` is the result without the fault. If no point is valid, only the length is measured.
    """
    lost = before.valid & ~after.valid
    flagged_m = before.interval_m * float(np.sum(lost)) - faulty.extent_m
    length = Measurement(
        f"flagged beyond a fault: {part}",
        before.track,
        max(flagged_m, 0.0),
        "m",
        FLAGGED_LIMITS[part],
        is_flagged_length=True,
    )
    unflagged = after.unflagged()
    if unflagged is None:
        return (length,)
    error = roughness_within(unflagged, after.track, "IRI error, unflagged", ROUGHNESS)
    return (error, _local(before, after), length)


def _local(before: Compared, after: Compared) -> Measurement:
    pair = Pair(
        _fill_flagged(before),
        _fill_flagged(after),
        before.interval_m,
        _both(before.valid) & _both(after.valid),
    )
    one, other = (iri_trace(z, pair.interval_m) for z in (pair.truth, pair.result))
    value = _largest_mean(other - one, pair)
    evidence = LocalDifference(pair)
    return Measurement(
        "local error, unflagged", before.track, value, "m/km", LOCAL_LIMITS, evidence
    )


def _fill_flagged(compared: Compared) -> FloatArray:
    """Return the elevations, with the truth's shape at flagged points."""
    return bridge(np.where(compared.valid, compared.result, np.nan), compared.truth)


def _both(valid: BoolArray) -> BoolArray:
    return np.logical_and(valid[:-1], valid[1:])


def _largest_mean(difference: FloatArray, pair: Pair) -> float:
    """Return the largest mean magnitude over `BASE_M`; uncounted points have no difference."""
    count = max(1, round(BASE_M / pair.interval_m))
    sums = np.cumsum(np.where(pair.counted, np.abs(difference), 0.0))
    return float(np.max(sums[count:] - sums[:-count])) / count


def _everywhere(truth: Profile, profile: Profile) -> tuple[Compared, ...]:
    """Return every wheel path on all points of ``truth``."""
    size, made = truth.distance_m.size, []
    for compared in compare(truth, profile):
        first = round((compared.distance_m[0] - truth.start_m) / truth.interval_m)
        inside = slice(first, first + compared.result.size)
        result, valid = np.full(size, np.nan), np.zeros(size, dtype=np.bool_)
        result[inside], valid[inside] = compared.result, compared.valid
        true = high_pass(truth.track(compared.track).elevation, truth.interval_m)
        made.append(
            replace(compared, distance_m=truth.distance_m, truth=true, result=result, valid=valid)
        )
    return tuple(made)


def _join(early: Compared, late: Compared, at_m: float, behind_m: float) -> Compared:
    x = early.distance_m
    result = np.where(x <= at_m, early.result, np.where(x > behind_m, late.result, np.nan))
    valid = np.where(x <= at_m, early.valid, (x > behind_m) & late.valid)
    return replace(early, result=result, valid=valid)
