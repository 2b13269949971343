"""Hints at what an unknown name was meant to be, for the line that refuses it."""

from collections.abc import Iterable
from difflib import get_close_matches

ALIKE = 0.6
"""Least likeness of two names, from 0 to 1, as `difflib` has it."""
LONGEST_NAME = 64
"""Characters of a name that are compared: the time that it takes grows with their square."""
SEPARATORS = "_", "-", ".", "/"
SHORTEST_BEGINNING = 3
MOST_LISTED = 24
"""Largest number of known names that a line lists."""


def nearest(name: object, known: Iterable[str], alike: float = ALIKE) -> str:
    """Return the one of ``known`` that ``name`` was meant to be, empty if no name is near.

    It is the same but for capital letters, or goes on behind ``name``, as speed_kmh behind speed,
    or is spelt about as it. ``alike`` is the least likeness, from 0 to 1.
    """
    names = {each.lower(): each for each in known}
    text = str(name)[:LONGEST_NAME].lower()
    if text in names:
        return names[text]
    parted = (each for each in names if each.startswith(tuple(text + s for s in SEPARATORS)))
    begun = (each for each in names if each.startswith(text))
    longer = next(parted, "") if text else ""
    spelt = get_close_matches(text, list(names), n=1, cutoff=alike)
    found = longer or next(iter(spelt), "")
    if not found and len(text) >= SHORTEST_BEGINNING:
        found = next(begun, "")
    return names.get(found, "")


def did_you_mean(name: object, known: Iterable[str], alike: float = ALIKE) -> str:
    """Return "did you mean …?" with the nearest of ``known``, empty if no name is near."""
    near = nearest(name, known, alike)
    return f"did you mean {near}?" if near else ""


def hint_at(name: object, known: Iterable[str]) -> str:
    """Return `did_you_mean` to follow a sentence, with a semicolon before it, or nothing."""
    hint = did_you_mean(name, known)
    return f"; {hint}" if hint else ""


def suggest(name: object, known: Iterable[str], lead: str = "there are") -> str:
    """Return `did_you_mean`, or where no name is near, a list of the known ones behind ``lead``."""
    names = list(known)
    return did_you_mean(name, names) or f"{lead} {list_names(names)}"


def list_names(names: list[str]) -> str:
    """Return the first `MOST_LISTED` of ``names``, with commas, and the number of the others."""
    others = len(names) - MOST_LISTED
    return ", ".join(names[:MOST_LISTED]) + (f" and {others} more" if others > 0 else "")
