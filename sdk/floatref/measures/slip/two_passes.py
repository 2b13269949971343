"""The slip of a vehicle's wheel from two passes over one road, one of them with a brake."""

from dataclasses import dataclass

import numpy as np

from floatref.errors import InputError
from floatref.measures.roughness.agreement import cross_correlation
from floatref.measures.roughness.roughness_index import iri_trace
from floatref.measures.slip.second_source import FAST_MPS
from floatref.values.arrays import FloatArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile

WINDOW_M, EVERY_M = 15.0, 5.0
"""Length of the stretches that are found in the other pass, and distance between them."""
FARTHEST_M = 3.0
"""Largest offset that is looked for; a slip of 12 % per g loses 2.5 m in a stop from 72 km/h."""
LEAST_CORRELATION = 0.7
FEWEST = 5
CERTAIN_M = 0.1
"""Least change of v²/2g between both passes, in m: below it there is no brake to learn from."""
LARGEST = 0.5
"""No wheel slips by more, per g."""


@dataclass(frozen=True)
class LearnedSlip:
    """Slip relative per g, its standard deviation, and the number of stretches behind it."""

    slip_per_g: float
    sigma_per_g: float
    stretches: int


def slip_of_passes(brake: Profile, other: Profile) -> LearnedSlip:
    """Return the slip that explains the offsets between two profiles along one road.

    Stretches of the ``brake`` are found in the ``other`` by cross correlation after the IRI filter.
    An offset is a constant, a share of the distance by which both encoders' scales differ, s v²/2g
    and what a radius adds that grows by v², of the other less that of the brake; speeds are those
    in the profiles' records. Raises InputError, which names what is missing, for profiles without a
    record of speed, that were corrected already, of different intervals, without a common wheel
    path or without a brake, and where too few stretches agree.
    """
    if not np.isclose(brake.interval_m, other.interval_m, rtol=1e-6):
        raise InputError(
            f"interval_m is {brake.interval_m:g} of one profile, {other.interval_m:g} of the "
            "other; process both alike"
        )
    causes = [_causes_of(profile) for profile in (brake, other)]
    places, offsets = _offsets(brake, other)
    if places.size < FEWEST:
        raise InputError(
            f"{places.size} stretches of {WINDOW_M:g} m agree in both passes; give two of one road"
        )
    at = places, places + offsets
    here, there = (
        np.stack([np.interp(x, own[0], row) for row in own[1:]])
        for x, own in zip(at, causes, strict=True)
    )
    if np.ptp(there[0] - here[0]) < CERTAIN_M:
        raise InputError("neither pass has a brake; give one that brakes and one at speed")
    return _fit(np.stack([*(there - here), places - places.mean(), np.ones(places.size)]), offsets)


def _fit(columns: FloatArray, offsets: FloatArray) -> LearnedSlip:
    """Fit ``columns``, the slip's first, without the stretches farthest from it."""
    used = np.ones(offsets.size, np.bool_)
    for _ in range(3):
        inverse = np.linalg.pinv(columns[:, used] @ columns[:, used].T)
        found = inverse @ (columns[:, used] @ offsets[used])
        rest = offsets - found @ columns
        limit = 3.0 * np.median(np.abs(rest[used])) * 1.4826 + 1e-3
        used = np.abs(rest) <= limit
    freedom = max(int(used.sum()) * EVERY_M / WINDOW_M - columns.shape[0], 1.0)
    sigma = float(np.sqrt(rest[used] @ rest[used] / freedom * inverse[0, 0]))
    slip = float(found[0])
    if not abs(slip) <= LARGEST:
        raise InputError(f"the passes differ by {slip:.3g} per g, which is no slip; give one road")
    return LearnedSlip(slip, sigma, int(used.sum()))


def _causes_of(profile: Profile) -> FloatArray:
    """Return places along the encoder, v²/2g there, and ∫ ((v/20)² - 1) dx, all in m: (3, n)."""
    record = profile.provenance.get("distance")
    record = record if isinstance(record, dict) else {}
    if record.get("source") != "encoder":
        raise InputError(
            "a profile has no record of an encoder's distance; process its run again, "
            "with slip_per_g 0 and without a second source of distance"
            if not record
            else f"a profile's distance is corrected already, by {record.get('source')}"
        )
    along, speed = (np.array(record.get(k, ()), np.float64) for k in ("along_m", "speed_mps"))
    if along.size < 2 or along.size != speed.size:
        raise InputError("a profile has no record of its speed; process its run again")
    places = np.arange(along[0], along[-1] + EVERY_M, 1.0)
    squared = np.interp(places, along, speed**2)
    grown = squared / FAST_MPS**2 - 1.0
    rolled = np.cumsum(grown) - 0.5 * (grown + grown[0])
    return np.stack([places, squared / (2.0 * STANDARD_GRAVITY), rolled])


def _offsets(brake: Profile, other: Profile) -> tuple[FloatArray, FloatArray]:
    """Return where stretches of ``brake`` lie, and how much farther they are in ``other``."""
    names = [t.name for t in brake.tracks if any(t.name == o.name for o in other.tracks)]
    if not names:
        raise InputError("the profiles have no wheel path in common")
    step, found = brake.interval_m, []
    size, reach = round(WINDOW_M / step), round(FARTHEST_M / step)
    begin = round((other.start_m - brake.start_m) / step)
    for name in names:
        one, two = (iri_trace(np.nan_to_num(p.track(name).elevation), step) for p in (brake, other))
        for first in range(reach, one.size - size - reach, max(1, round(EVERY_M / step))):
            at = first - begin
            if at - reach < 0 or at + size + reach > two.size:
                continue
            part = slice(at, at + size)
            agreed = cross_correlation(two[part], one[first : first + size], step, FARTHEST_M)
            if agreed.cross_correlation >= LEAST_CORRELATION:
                middle = brake.start_m + (first + size / 2) * step
                found.append((middle, -agreed.offset_m))
    return np.array([m for m, _ in found]), np.array([o for _, o in found])
