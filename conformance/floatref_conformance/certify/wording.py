"""What was found out about the place of a run, in sentences."""

from collections.abc import Iterator
from dataclasses import replace

from floatref.values.profile import Profile
from floatref_conformance.certify.candidates import LARGEST_SCALE
from floatref_conformance.certify.finding import Find
from floatref_conformance.certify.placement import Placement, placed
from floatref_conformance.certify.units import DISTANCE_UNITS, METRE, reference_unit

COVERED_M = 0.5
"""A run that ends so much before the section covers it."""


def worded(reference: Profile, run: Profile, placement: Placement) -> Placement:
    """Return ``placement`` with all that was found out about it said."""
    return replace(placement, said=tuple(_sentences(reference, run, placement)))


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
    yield from _coverage(reference, placed(run, placement))


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
