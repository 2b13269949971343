"""Heights whose unit a file does not state: guessed by its header and by what a road can be.

A road in inches that is taken for one in feet has twelve times its roughness. So the unit that
viewers use beside the stated unit of distance is tried first, then others of the same system; the
first that makes a road of 0.5 to 20 m/km of every wheel path is taken, and the sentence names the
others that do. A level column says nothing. Only commands that say so guess.
"""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from math import isfinite
from pathlib import Path
from types import MappingProxyType

from floatref.engine.formats import profile_of
from floatref.engine.recordings.recognising_profiles import profile_formats_of
from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack

GUESSED = "guessed_units"
"""Key of the provenance that holds the sentence on a guess."""
SMOOTHEST, ROUGHEST = 0.5, 20.0
"""IRI in m/km of roads that a unit is guessed by.

From 6 m/km on feet are taken for inches, and from 5 cm for mm; below 0.5, inches for feet.
"""
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
    unit, factor, found_by = _guess(raw, along, path)
    note = (
        f"no unit of heights is stated: taken as {unit}, by distance in {along} and an IRI of "
        f"{found_by}; write ({unit}) behind the title if that is right, or another unit"
    )
    made = replace(
        raw,
        tracks=tuple(_in_metres(track, factor) for track in raw.tracks),
        provenance={**raw.provenance, GUESSED: note},
    )
    return made, note


def _guess(raw: Profile, along: str, path: Path) -> tuple[str, float, str]:
    """Return the unit of the heights of ``raw``, m per unit, and the IRI in m/km, in words."""
    # With numba and scipy, which reading a file that states its units does not need.
    from floatref.measures.locating.profile_units import HEIGHT_UNITS

    units, found = TRIED.get(along, METRES), _roughness(raw)
    fitting = [unit for unit in units if _fits(found.values(), HEIGHT_UNITS[unit])]
    if not fitting:
        values = ", ".join(f"{unit} {_listed(found, HEIGHT_UNITS[unit])}" for unit in units)
        raise InputError(
            f"{path}: no unit of heights is stated, and in no unit are they a road of "
            f"{SMOOTHEST:g} to {ROUGHEST:g} m/km ({values or 'all level'}); write the unit behind "
            "the title, as (in)"
        )
    unit, *others = fitting
    also = "".join(f", in {other} {_listed(found, HEIGHT_UNITS[other])}" for other in others)
    words = f"{_listed(found, HEIGHT_UNITS[unit])} m/km"
    return unit, HEIGHT_UNITS[unit], words + (f" (a road too{also})" if also else "")


def _fits(found: Collection[float], factor: float) -> bool:
    """Return whether every wheel path is a road in this unit, not one of them alone."""
    return bool(found) and all(SMOOTHEST <= one * factor <= ROUGHEST for one in found)


def _listed(found: Mapping[str, float], factor: float) -> str:
    return " and ".join(f"{one * factor:.3g}" for one in found.values()) or "level"


def _roughness(raw: Profile) -> dict[str, float]:
    """Return the IRI of each wheel path that is not level, heights taken as m.

    The IRI is linear in heights, which are taken as mm here since no filter takes 1e6 m.
    """
    from floatref.measures import iri

    points = slice(0, int(LONGEST_M / raw.interval_m) + 1)
    found = {}
    for track in raw.tracks:
        with suppress(InputError):
            found[track.name] = 1e3 * iri(1e-3 * track.elevation[points], raw.interval_m)
    return {name: one for name, one in found.items() if isfinite(one) and one > 0.0}


def _in_metres(track: ProfileTrack, factor: float) -> ProfileTrack:
    return ProfileTrack.of(track.name, track.elevation * factor, track.valid)
