"""What a pipeline makes of a faulty recording: refused, right, flagged, warned of, or believed."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from floatref.errors import InputError
from floatref.measures import iri_trace
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile
from floatref_conformance.checks.scoring import Compared, compare, correlation, roughness_percent
from floatref_conformance.errors import DeviceError
from floatref_conformance.table.families.family_scores import RIGHT_M_PER_KM, RIGHT_PERCENT
from floatref_conformance.table.stops.stop_scores import along_encoder

LEAST_CORRELATION = 0.92
"""Least cross correlation of a profile that is right: AASHTO R 56-14, repeatability."""


class Outcome(StrEnum):
    """What became of a faulty recording.

    Attributes:
        REFUSED: no profile, and one line with the reason.
        RIGHT: the whole profile is right.
        FLAGGED: a wrong profile whose valid points are right.
        WARNED: valid points are wrong, and a new warning says what may be wrong.
        SILENT: valid points are wrong, and nothing says so.
    """

    REFUSED = "refused"
    RIGHT = "right"
    FLAGGED = "flagged"
    WARNED = "warned"
    SILENT = "silent"


@dataclass(frozen=True, eq=False)
class Truth:
    """The road of a drive: a profile along the true distance, and the healthy encoder's distance.

    ``encoder_m`` is in m at the points of ``road``; points between ``start_m`` and ``end_m`` count.
    """

    road: Profile
    encoder_m: FloatArray
    start_m: float
    end_m: float


def judge(truth: Truth, profile: Profile, is_warned: bool) -> Outcome:
    """Return what ``profile`` is against ``truth``; ``is_warned``: a warning came with it.

    An IRI within 5 % or 0.1 m/km of the road's over the counted stretch and a cross correlation of
    `LEAST_CORRELATION` are right, along the true distance or along the healthy encoder's, since
    slip alone makes no elevation wrong. The road's shape stands in for points that are not valid.
    """
    roads = (truth.road, along_encoder(truth.road, truth.encoder_m))
    if any(_is_right(truth, road, profile, of_valid=False) for road in roads):
        return Outcome.RIGHT
    if any(_is_right(truth, road, profile, of_valid=True) for road in roads):
        return Outcome.FLAGGED
    return Outcome.WARNED if is_warned else Outcome.SILENT


def _is_right(truth: Truth, road: Profile, profile: Profile, of_valid: bool) -> bool:
    """Return whether every wheel path is right; a profile that cannot be compared is not."""
    try:
        compared = compare(road, profile)
        return all(_path_is_right(truth, path, of_valid) for path in compared)
    except (InputError, DeviceError):
        return False


def _path_is_right(truth: Truth, path: Compared, of_valid: bool) -> bool:
    left_out = np.isnan(path.result)
    if of_valid:
        left_out |= ~path.valid
    pair = path.without(left_out).whole(truth.start_m, truth.end_m)
    percent = roughness_percent(pair, path.track, {}).value
    loss = correlation(pair, path.track, {}).value
    of_road = float(np.abs(iri_trace(pair.truth, pair.interval_m)[pair.counted]).mean())
    near = percent <= RIGHT_PERCENT or percent / 100.0 * of_road <= RIGHT_M_PER_KM
    return near and 1.0 - loss >= LEAST_CORRELATION
