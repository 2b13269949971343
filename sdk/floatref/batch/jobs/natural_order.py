"""The order of names in which people count: run-9 before run-10."""

import re
from pathlib import Path

NUMBER = re.compile(r"([0-9]+)")

NaturalKey = tuple[tuple[tuple[int, int, str], ...], str]
"""What names are compared by: their parts, and last the name itself, so that no two are equal."""


def natural_key(name: str) -> NaturalKey:
    """Return what ``name`` is sorted by: numbers in it by value, all else by its letters.

    A number comes before any other part; of names that differ in leading zeros alone the order is
    that of their letters.
    """
    parts = (part for part in NUMBER.split(name) if part)
    return tuple(_part(part) for part in parts), name


def natural_path_key(path: Path) -> tuple[NaturalKey, ...]:
    """Return what ``path`` is sorted by: folder after folder, then its own name."""
    return tuple(natural_key(part) for part in path.parts)


def _part(text: str) -> tuple[int, int, str]:
    if not NUMBER.fullmatch(text):
        return 1, 0, text
    # Python does not read thousands of digits as a number: their count goes first.
    digits = text.lstrip("0")
    return 0, len(digits), digits
