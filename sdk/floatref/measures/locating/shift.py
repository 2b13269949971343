"""By how much a profile lies farther along than a reference of the same road, if that is sure."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from floatref.errors import InputError
from floatref.measures.locating.placement import Placement
from floatref.measures.locating.placing import SURE, place
from floatref.measures.locating.profile_units import METRE
from floatref.measures.roughness.path_signals import path_agreement
from floatref.values.profile import Profile


@dataclass(frozen=True)
class Shift:
    """Where a profile lies on the axis of a reference.

    Attributes:
        placement_m: by how much it lies farther along, in m: 0 within ±1 m of its place, which is
            left to the search for the offset; NaN where the place is not sure.
        note: why it is not sure, or what else to mind, in one sentence; empty without either.
    """

    placement_m: float
    note: str = ""

    @property
    def is_sure(self) -> bool:
        """Whether the place is known."""
        return not math.isnan(self.placement_m)


def find_shift(reference: Profile, profile: Profile) -> Shift:
    """Return by how much ``profile`` lies farther along than ``reference``, by `place`.

    Wheel paths are those of ``reference`` by name; InputError where ``profile`` lacks one. The
    shorter of the two is looked for in the longer one, by its valid points.
    """
    named = replace(profile, tracks=tuple(profile.track(t.name) for t in reference.tracks))
    is_longer = named.length_m >= reference.length_m
    placement = place(reference, named) if is_longer else place(named, reference)
    doubt = _doubt(placement)
    if doubt:
        return Shift(math.nan, doubt)
    sign = -1.0 if placement.inverted else 1.0
    note = "its heights are upside down" if placement.inverted else ""
    if placement.offset_m == 0.0:
        return Shift(0.0, note)
    shift_m = placement.offset_m if is_longer else -placement.offset_m
    best = _refine(reference, named, shift_m, sign)
    if not best.correlation >= SURE:
        return Shift(math.nan, _reason_not_found(best.correlation))
    return Shift(shift_m if _drifts(placement, reference, named) else best.shift_m, note)


def _drifts(placement: Placement, reference: Profile, profile: Profile) -> bool:
    """Return whether an error of distance moves ``profile`` by more than half a sample.

    Then no shift fits all of the road, and the lag at the beginning counts, as in `place`.
    """
    common_m = min(reference.length_m, profile.length_m)
    return abs(placement.distance_scale - 1.0) * common_m > 0.5 * reference.interval_m


def move(profile: Profile, shift: Shift) -> Profile:
    """Return ``profile`` on the axis of the reference; the same object where it stays."""
    if not shift.is_sure or shift.placement_m == 0.0:
        return profile
    return replace(profile, start_m=profile.start_m - shift.placement_m)


def _doubt(placement: Placement) -> str:
    """Return why ``placement`` is no shift along the road; empty if it is one."""
    if not placement.found:
        return _reason_not_found(placement.correlation)
    if placement.distance_unit != METRE:
        return f"its distance fits in {placement.distance_unit}, not in m; convert it"
    if placement.reversed:
        return "it goes against the reference; reverse one of them"
    if any(mine != its for mine, its in placement.tracks.items()):
        return "its wheel paths fit in another order; check their names"
    if placement.alternatives and placement.offset_m:
        return f"the road repeats itself, {placement.alternatives} other places fit as well"
    return ""


def _reason_not_found(correlation: float) -> str:
    if math.isnan(correlation):
        return "one of them is flat, too short or too coarse to be recognised"
    return f"the best correlation of slope is {correlation:.2f}, which chance may reach"


class _Best(NamedTuple):
    """A shift in m, and the best wheel path's correlation of slope in waves of 1.6 to 8 m there."""

    shift_m: float
    correlation: float


def _refine(reference: Profile, profile: Profile, shift_m: float, sign: float) -> _Best:
    """Return the shift within ±1 m of ``shift_m`` at which valid points agree best, to a sample.

    ``sign`` is -1 for heights upside down. The correlation is NaN if too little is in common.
    """
    moved = replace(profile, start_m=profile.start_m - shift_m)
    offsets, correlations = [], []
    try:
        for name in reference:
            rough, slope = (
                path_agreement(reference, moved, name, band, of_valid=True, sign=sign)
                for band in ("iri", "medium")
            )
            offsets.append(rough.offset_m)
            correlations.append(slope.correlation)
    except InputError:
        return _Best(shift_m, math.nan)
    return _Best(round(shift_m + float(np.median(offsets)), 3), max(correlations))
