"""Heights whose unit a file does not state: guessed by its header and by what a road can be.

A road in inches that is taken for one in feet has twelve times its roughness. So the unit that
viewers use beside the stated unit of distance is tried first, then others of the same system; the
first that makes a road of 0.5 to 20 m/km is taken. Only commands that say so guess.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path
from statistics import median
from types import MappingProxyType

from floatref.engine.formats import profile_of
from floatref.engine.recordings.recognising_profiles import profile_formats_of
from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack

GUESSED = "guessed_units"
"""Key of the provenance that holds the sentence on a guess."""
SMOOTHEST, ROUGHEST = 0.5, 20.0
"""IRI in m/km of roads: between them lies at most one of inches and feet that is likely."""
LONGEST_M = 1000.0
"""Length of road by which a unit is guessed."""
FEET, METRES = ("in", "ft", "mil"), ("m", "mm", "cm")
TRIED: Mapping[str, Sequence[str]] = MappingProxyType({"ft": FEET, "mi": FEET, "in": FEET})
"""By the unit of distance, the units of height in the order in which they are tried."""


def read_guessing(path: Path) -> tuple[Profile, str]:
    """Return the profile at ``path`` in m, and in one line which unit of heights was guessed.

    The line is empty if the file states its units, and so is read as by `profile_of`. Raises
    InputError as that does, and where no unit makes a road of the heights.
    """
    found = profile_formats_of(path)
    unstated = getattr(found[0], "read_unstated", None) if len(found) == 1 else None
    given = unstated(path) if unstated is not None else None
    if given is None:
        profile = profile_of(path)
        return profile, str(profile.provenance.get(GUESSED, ""))
    raw, along = given
    unit, factor, roughness = _guess(raw, along, path)
    note = (
        f"no unit of heights is stated: taken as {unit}, by distance in {along} and an IRI of "
        f"{roughness:.2f} m/km; write ({unit}) behind the title if that is right, or another unit"
    )
    made = replace(
        raw,
        tracks=tuple(_in_metres(track, factor) for track in raw.tracks),
        provenance={**raw.provenance, GUESSED: note},
    )
    return made, note


def _guess(raw: Profile, along: str, path: Path) -> tuple[str, float, float]:
    """Return the unit of the heights of ``raw``, m per unit, and the IRI in m/km that it makes."""
    # With numba and scipy, which reading a file that states its units does not need.
    from floatref.measures.locating.profile_units import HEIGHT_UNITS

    units = TRIED.get(along, METRES)
    found = _roughness(raw)
    for unit in units:
        roughness = found * HEIGHT_UNITS[unit]
        if SMOOTHEST <= roughness <= ROUGHEST:
            return unit, HEIGHT_UNITS[unit], roughness
    values = ", ".join(f"{unit} {found * HEIGHT_UNITS[unit]:.3g}" for unit in units)
    raise InputError(
        f"{path}: no unit of heights is stated, and in no unit are they a road of {SMOOTHEST:g} to "
        f"{ROUGHEST:g} m/km ({values}); write the unit behind the title, as (in)"
    )


def _roughness(raw: Profile) -> float:
    """Return the median IRI of the wheel paths, heights taken as m; NaN without one.

    The IRI is linear in heights, which are taken as mm here since no filter takes 1e6 m.
    """
    from floatref.measures import iri

    points = slice(0, int(LONGEST_M / raw.interval_m) + 1)
    found = []
    for track in raw.tracks:
        try:
            found.append(1e3 * iri(1e-3 * track.elevation[points], raw.interval_m))
        except InputError:
            continue
    known = [value for value in found if isfinite(value)]
    return median(known) if known else float("nan")


def _in_metres(track: ProfileTrack, factor: float) -> ProfileTrack:
    return ProfileTrack.of(track.name, track.elevation * factor, track.valid)
