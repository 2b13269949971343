"""Wheel paths of two profiles that share no name, matched by their elevations."""

from dataclasses import replace

from floatref.errors import InputError
from floatref.measures.locating.placing import SURE, place
from floatref.values.profile import Profile


def match_names(reference: Profile, profile: Profile) -> tuple[Profile, tuple[str, ...]]:
    """Return ``profile`` with the names of ``reference``, and in one line each what was renamed.

    It is the same object if it has every name. The shorter of the two is looked for in the longer.
    Raises InputError for a wheel path that is missing: if they share a name, or if the road of one
    is not found in the other for every wheel path.
    """
    names = [track.name for track in reference.tracks]
    others = [track.name for track in profile.tracks]
    missing = [name for name in names if name not in others]
    if not missing:
        return profile, ()
    pairs = _pairs(reference, profile) if not set(names) & set(others) else {}
    if any(name not in pairs for name in names):
        raise InputError(
            f"track {', '.join(missing)} of the reference is missing in the profile, which holds "
            f"{', '.join(others)}; give both the same names"
        )
    mine = {pairs[name]: name for name in names}
    tracks = tuple(replace(t, name=mine.get(t.name, t.name)) for t in profile.tracks)
    notes = tuple(f"its wheel path {its} is {name} of the reference" for its, name in mine.items())
    return replace(profile, tracks=tracks), notes


def _pairs(reference: Profile, profile: Profile) -> dict[str, str]:
    """Return the wheel path of ``profile`` for each of ``reference`` that was found.

    Each by its own correlation: one that is left over need not be the one that is missing.
    """
    longer = profile.length_m >= reference.length_m
    placed = place(reference, profile) if longer else place(profile, reference)
    sure = placed.path_correlations
    found = {mine: its for mine, its in placed.tracks.items() if sure.get(mine, 0.0) >= SURE}
    return found if longer else {its: mine for mine, its in found.items()}
