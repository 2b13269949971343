"""How a run lies against the reference: put right accordingly, and described in sentences."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from floatref.measures.locating.candidates import LARGEST_SCALE
from floatref.measures.locating.finding import Find
from floatref.measures.locating.profile_units import (
    DISTANCE_UNITS,
    METRE,
    reference_unit,
)
from floatref.values.arrays import FloatArray
from floatref.values.profile import Profile, ProfileTrack


@dataclass(frozen=True)
class Placement:
    """How a run lies against the reference, and what has to be done to it.

    Attributes:
        found: whether the reference's road was found in the run at all.
        correlation: of slope in the waveband of 1.6 to 8 m, at the best place that was found.
        notes: all of it in sentences; empty for a run that lies right.
        tracks: wheel path of the reference → that of the run; without missing ones.
        reversed: whether the run's axis points against the reference's.
        inverted: whether its heights are upside down; they stay so, for that is a fault.
        distance_unit, distance_factor: of its axis, and m per unit.
        height_unit, height_factor: of its elevation, and m per unit.
        height_gain: by how much higher it takes the road after that, at a first glance.
        offset_m: by how much it lay farther along, after mirroring, in m.
        distance_scale: how many times as long its encoder takes the road.
        moves: whether anything has to be done to the run.
        alternatives: places at which it would fit as well.
        path_correlations: by wheel path of the reference, where the run was looked for.
    """

    found: bool
    correlation: float
    notes: tuple[str, ...] = ()
    tracks: Mapping[str, str] = field(default_factory=dict)
    reversed: bool = False
    inverted: bool = False
    distance_unit: str = METRE
    distance_factor: float = 1.0
    height_unit: str = METRE
    height_factor: float = 1.0
    height_gain: float = 1.0
    offset_m: float = 0.0
    distance_scale: float = 1.0
    alternatives: int = 0
    path_correlations: Mapping[str, float] = field(default_factory=dict)

    @property
    def moves(self) -> bool:
        """Whether the run has to be changed before it can be compared."""
        same_names = all(mine == its for mine, its in self.tracks.items())
        scales = self.distance_factor, self.height_factor
        turned = self.reversed or not same_names
        return self.found and (turned or scales != (1.0, 1.0) or self.offset_m != 0.0)


def apply_placement(run: Profile, placement: Placement) -> Profile:
    """Return ``run`` placed by ``placement``: the same object if it lies right or was not found.

    Wheel paths that are not the reference's are dropped where another takes their name.
    """
    if not placement.moves:
        return run
    factor = placement.distance_factor
    mine = {its: name for name, its in placement.tracks.items()}
    others = [t for t in run.tracks if t.name not in mine and t.name not in placement.tracks]
    renamed = [_track(run.track(its), name, placement) for its, name in mine.items()]
    kept = [_track(t, t.name, placement) for t in others]
    return replace(
        run,
        tracks=(*renamed, *kept),
        interval_m=run.interval_m * factor,
        start_m=run.start_m * factor - placement.offset_m,
    )


def _track(track: ProfileTrack, name: str, placement: Placement) -> ProfileTrack:
    """Return ``track`` in m and forward, under ``name``."""
    order = slice(None, None, -1 if placement.reversed else 1)
    factor = placement.height_factor
    sigma = None if track.sigma is None else _scale(track.sigma[order], factor)
    elevation = _scale(track.elevation[order], factor)
    return ProfileTrack.of(name, elevation, track.valid[order], sigma)


def _scale(values: FloatArray, factor: float) -> FloatArray:
    """Return ``values`` times ``factor``, the same where it is one."""
    return np.ascontiguousarray(values) if factor == 1.0 else values * factor


COVERED_M = 0.5
"""A run that ends this much before the section's end still covers it."""


def add_sentences(reference: Profile, run: Profile, placement: Placement) -> Placement:
    """Return ``placement`` with its sentences."""
    return replace(placement, notes=tuple(_sentences(reference, run, placement)))


def not_found(best: Find | None, shaped: bool) -> tuple[str, ...]:
    """Return what was tried, and how near it came."""
    if not shaped:
        return ("the reference is flat: there is nothing by which a run could be recognised",)
    if best is None:
        return ("the run has no shape, or is too short or too coarse, to be recognised",)
    units = ", ".join(DISTANCE_UNITS)
    return (
        "not on this road: tried forward and reversed, upright and inverted, wheel paths in every "
        f"order, distance in {units} with errors of up to {100.0 * LARGEST_SCALE:.0f} %; the best "
        f"correlation is {abs(best.candidate.score):.2f}, and it takes "
        f"{best.candidate.needed:.2f} to exceed chance",
    )


def _sentences(reference: Profile, run: Profile, placement: Placement) -> Iterator[str]:
    """Yield what was done, then what to mind."""
    if placement.distance_unit != METRE:
        yield f"distance is in {placement.distance_unit}, not in m: converted"
    if placement.reversed:
        yield "the run goes against the reference: its distance is reversed"
    yield from _names(reference, run, placement)
    yield from _heights(placement)
    if placement.offset_m:
        way = "farther along" if placement.offset_m > 0 else "earlier"
        yield f"the run lies {abs(placement.offset_m):.2f} m {way}: moved back on the section"
    if placement.alternatives:
        yield (
            f"the road repeats itself: {placement.alternatives} other places fit as well; the one "
            "with the least offset was taken"
        )
    yield from _coverage(reference, apply_placement(run, placement))


def _names(reference: Profile, run: Profile, placement: Placement) -> Iterator[str]:
    """Yield what became of the wheel paths."""
    renamed = {mine: its for mine, its in placement.tracks.items() if mine != its}
    exchanged = {m: i for m, i in renamed.items() if renamed.get(i) == m}
    if exchanged:
        yield f"wheel paths {' and '.join(sorted(exchanged))} are exchanged: put right"
    for mine, its in renamed.items():
        if mine not in exchanged:
            yield f"wheel path {its} of the run is {mine} of the reference"
    for track in reference.tracks:
        if track.name not in placement.tracks:
            yield f"wheel path {track.name} of the reference is missing in the run"


def _heights(placement: Placement) -> Iterator[str]:
    """Yield what became of the elevation."""
    if placement.height_unit != METRE:
        yield f"elevation is in {placement.height_unit}, not in m: converted"
    if placement.inverted:
        yield "heights are upside down: compared as they are"
    unit = reference_unit(placement.height_gain)
    if unit is not None:
        yield (
            f"the reference seems to be in {unit}: the run takes the road "
            f"{placement.height_gain:.3g} times as high; convert the reference"
        )


def _coverage(reference: Profile, run: Profile) -> Iterator[str]:
    """Yield which part of the section is missing."""
    start, end = reference.start_m, reference.start_m + reference.length_m
    first, last = max(run.start_m, start), min(run.start_m + run.length_m, end)
    if first > start + COVERED_M or last < end - COVERED_M:
        yield (
            f"the run covers {max(last - first, 0.0):.1f} m of the section's {end - start:.1f} m, "
            f"from {first:.1f} to {last:.1f} m"
        )
