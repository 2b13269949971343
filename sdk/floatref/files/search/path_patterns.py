"""Paths that match a pattern, such as `2026/**/run-*.mf4`, found in a bounded search.

In a name * stands for any characters, ? for one and [abc] for one of these, as in a shell. A name
** stands for any number of folders, links left out; at the end it is the folder before it. A hidden
file or folder matches only a name that begins with a dot.
"""

import os
import stat
from collections import defaultdict
from collections.abc import Iterator
from fnmatch import fnmatch
from glob import has_magic
from heapq import heappop, heappush
from itertools import takewhile
from pathlib import Path

from floatref.errors import InputError
from floatref.files.search.counted_listing import CountedListing, is_real_folder

STARS = "**"


def is_pattern(text: str) -> bool:
    """Return whether ``text`` has a character of patterns."""
    return has_magic(text)


def split_pattern(text: str) -> tuple[Path, tuple[str, ...]]:
    """Return the folder before the first name in ``text`` that is a pattern, and the names after.

    Raises InputError if ** is a part of a name.
    """
    names = Path(text).parts
    for name in names:
        if STARS in name and name != STARS:
            raise InputError(f"{text}: bad pattern ({name}); write ** as a name of its own")
    fixed = tuple(takewhile(lambda name: not has_magic(name), names))
    rest = names[len(fixed) :]
    once = (name for k, name in enumerate(rest) if rest[k : k + 2] != (STARS, STARS))
    return Path(*fixed), tuple(once)


def find_matches(base: Path, names: tuple[str, ...], listing: CountedListing) -> Iterator[Path]:
    """Yield the paths in ``base`` that match ``names``, those of `split_pattern`, in no order.

    A folder that several links lead to is listed once, by the path with the fewest links. Raises
    InputError if ``listing`` becomes too long.
    """
    end = len(names)
    endless = end - 1 if names[-1:] == (STARS,) else end
    waiting = [(0, str(base), base, {0})]
    entered: set[tuple[int, int, frozenset[int]]] = set()
    while waiting:
        links, _, place, at = heappop(waiting)
        # A ** may be no folder at all.
        at |= {k + 1 for k in at if names[k : k + 1] == (STARS,)}
        if end in at and (endless == end or place.is_dir()):
            yield place
        at -= {endless, end}
        if at and _enter(place, at, entered):
            for child, then in _steps(place, at, names, listing).items():
                through = links + (then != {end} and child.is_symlink())
                heappush(waiting, (through, str(child), child, then))


def _enter(place: Path, at: set[int], entered: set[tuple[int, int, frozenset[int]]]) -> bool:
    """Return whether ``place`` is a folder that was not entered yet with the positions ``at``."""
    try:
        found = os.stat(place)
    except (OSError, ValueError):
        return False
    key = found.st_dev, found.st_ino, frozenset(at)
    if not stat.S_ISDIR(found.st_mode) or key in entered:
        return False
    entered.add(key)
    return True


def _steps(
    place: Path, at: set[int], names: tuple[str, ...], listing: CountedListing
) -> dict[Path, set[int]]:
    """Return what in ``place`` matches one of the names ``at``, with the positions after it."""
    found: dict[Path, set[int]] = defaultdict(set)
    patterns = [k for k in at if has_magic(names[k])]
    for k in at.difference(patterns):
        if os.path.lexists(place / names[k]):
            found[place / names[k]].add(k + 1)
    for entry in listing.readable(place) if patterns else ():
        for k in patterns:
            if _matches(entry, names[k]):
                found[place / entry.name].add(k if names[k] == STARS else k + 1)
    return found


def _matches(entry: os.DirEntry[str], name: str) -> bool:
    if entry.name.startswith(".") and not name.startswith("."):
        return False
    return is_real_folder(entry) if name == STARS else fnmatch(entry.name, name)
