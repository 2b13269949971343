"""How two passes over one road differ, and how far beyond the road under their two lines."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from floatref.measures import iri_trace, on_common_grid
from floatref.values.profile import Profile
from floatref_conformance.checks.evidence import Pair
from floatref_conformance.checks.scoring import (
    Compared,
    correlation,
    refuse_flat,
    roughness_percent,
)
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.checks.verdict import Measurement
from floatref_conformance.classes import DeviceClass, Limits

BETWEEN = "correlation loss between passes"
DIFFERENCE = "IRI difference between passes"
LOSS_LIMITS: Limits = {
    DeviceClass.NOMINAL: 0.08,
    DeviceClass.ADEQUATE: 0.05,
    DeviceClass.REFERENCE: 0.02,
}
DIFFERENCE_LIMITS: Limits = {
    DeviceClass.NOMINAL: 5.0,
    DeviceClass.ADEQUATE: 3.0,
    DeviceClass.REFERENCE: 2.0,
}
START_M, END_M = 220.0, 380.9
"""Start and end of the compared stretch, in m."""


def _pair_of(first: Profile, second: Profile, track: str) -> Pair:
    """Return both passes over the compared stretch, the first in the place of the truth."""
    one, other = on_common_grid(first, second)
    stretch(one, track, START_M, END_M)
    before, after = one.track(track).elevation, other.track(track)
    compared = Compared(track, one.distance_m, before, after.elevation, after.valid, one.interval_m)
    return compared.whole(START_M, END_M)


def _roughness(pair: Pair) -> tuple[float, float]:
    """Return the IRI of both passes in m/km."""
    one, other = (
        float(np.abs(iri_trace(z, pair.interval_m)[pair.counted]).mean())
        for z in (pair.truth, pair.result)
    )
    return one, other


def compare_passes(first: Profile, second: Profile, track: str) -> list[Measurement]:
    """Return correlation loss, and difference in IRI in percent of the rougher pass's.

    Two flat profiles have no difference.
    """
    pair = _pair_of(first, second, track)
    measured = [replace(correlation(pair, track, LOSS_LIMITS), quantity=BETWEEN)]
    rough = _roughness(pair)
    if max(rough) > 0:
        if rough[0] < rough[1]:
            pair = replace(pair, truth=pair.result, result=pair.truth)
        difference = roughness_percent(pair, track, DIFFERENCE_LIMITS)
        measured.append(replace(difference, quantity=DIFFERENCE))
    return measured


def compare_beyond(
    profiles: Sequence[Profile], truths: Sequence[Profile], track: str
) -> list[Measurement]:
    """Return loss and difference of two passes beyond those of the true roads under their lines.

    The IRI of each pass is taken as a share of its own line's; the difference is that of the
    shares, in percent of the larger. Raises InputError for a line without roughness.
    """
    found, true = (_pair_of(first, second, track) for first, second in (profiles, truths))
    losses = [correlation(pair, track, LOSS_LIMITS).value for pair in (found, true)]
    shares = [q / refuse_flat(t) for q, t in zip(_roughness(found), _roughness(true), strict=True)]
    measured = [Measurement(BETWEEN, track, max(losses[0] - losses[1], 0.0), "", LOSS_LIMITS)]
    if max(shares) > 0:
        percent = 100.0 * abs(shares[0] - shares[1]) / max(shares)
        measured.append(Measurement(DIFFERENCE, track, percent, "%", DIFFERENCE_LIMITS))
    return measured
