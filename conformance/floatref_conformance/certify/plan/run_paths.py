"""Which files are runs: paths, directories of runs and patterns, and unique names for them."""

import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from floatref.errors import InputError
from floatref.files.search.counted_listing import CountedListing
from floatref.files.search.path_patterns import find_matches, is_pattern, split_pattern
from floatref.files.sources import real_path

DOCUMENTS = ("profile.json", "recording.json")
"""Names of the JSON files of our directories: whoever names one means its directory."""
BESIDE = (
    *(".bin", ".dbc", ".tdms_index"),
    *(".html", ".jpg", ".json", ".md", ".pdf", ".png", ".toml", ".xlsx", ".yaml", ".zip"),
)
"""Suffixes in a directory of runs that are no run: what belongs to one, maps, notes, pictures."""
CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]+")


def runs_of(given: Sequence[str], folder: Path = Path()) -> tuple[Path, ...]:
    """Return the runs in ``given``, each once; relative paths are looked for in ``folder``.

    Each is a recording, a profile, a directory of them, searched through, or a pattern. Raises
    InputError for one that does not exist or holds no run.
    """
    found: dict[Path, Path] = {}
    for text in given:
        runs = list(_runs(text, folder))
        if not runs:
            raise InputError(f"{text}: holds no run; give a profile, a recording or a pattern")
        for path in runs:
            found.setdefault(real_path(path), path)
    return tuple(found.values())


def check_exists(text: str, folder: Path = Path()) -> Path:
    """Return the path that ``text`` means in ``folder``; InputError if there is nothing."""
    if not text:
        raise InputError("a path is empty; name a file or a directory")
    path = folder / text
    try:
        there = path.exists()
    except (OSError, ValueError):
        there = False
    if not there:
        raise InputError(f"{path}: not found; check the name")
    return path.parent if path.name in DOCUMENTS else path


def natural(text: str) -> list[tuple[str, int]]:
    """Return what sorts ``text`` as people do: run-2 before run-10."""
    parts = re.findall(r"(\D*)(\d*)", text.casefold())
    return [(word, int(digits or -1)) for word, digits in parts]


def names_of(paths: Sequence[Path]) -> tuple[str, ...]:
    """Return a name for every path, all different: no longer a part of it than is needed."""
    parts = [[_on_one_line(part) for part in real_path(path).parts[1:]] for path in paths]
    bare = tuple(_bare(_on_one_line(path.name) or "run") for path in paths)
    longest = max(map(len, parts), default=0)
    deeper = ("/".join(names[-depth:]) for depth in range(1, longest + 1) for names in parts)
    levels = [bare, *zip(*[deeper] * len(paths), strict=True)] if paths else [bare]
    return next((tuple(names) for names in levels if len(set(names)) == len(paths)), bare)


def _runs(text: str, folder: Path) -> Iterator[Path]:
    listing = CountedListing(text)
    for path in _named(text, folder, listing):
        yield from _within(path, listing)


def _named(text: str, folder: Path, listing: CountedListing) -> list[Path]:
    """Return the path that ``text`` is, or those that match it, in the order of people."""
    if not is_pattern(text) or os.path.exists(folder / text):
        return [check_exists(text, folder)]
    start, names = split_pattern(text)
    matches = find_matches(folder / start, names, listing)
    found = sorted(matches, key=lambda path: natural(str(path)))
    if not found:
        raise InputError(f"{folder / text}: no file matches this pattern; correct it")
    return [path.parent if path.name in DOCUMENTS else path for path in found]


def _within(path: Path, listing: CountedListing) -> Iterator[Path]:
    """Yield ``path`` if it is a run, else the runs in that directory and those below."""
    if not path.is_dir() or any((path / name).is_file() for name in DOCUMENTS):
        yield path
        return
    children = [path / entry.name for entry in listing.entries(path)]
    for child in sorted(children, key=lambda child: natural(child.name)):
        hidden = child.name.startswith(".")
        if child.is_dir() and not (hidden or child.is_symlink()):
            yield from _within(child, listing)
        elif _is_file(child) and not hidden and child.suffix.lower() not in BESIDE:
            yield child


def _is_file(path: Path) -> bool:
    """Return whether ``path`` is a file or a broken link, which is a run with an error."""
    return path.is_file() or (path.is_symlink() and not path.exists())


def _bare(name: str) -> str:
    """Return ``name`` without its suffix; .20g of stop_0.20g is no suffix: a digit."""
    stem, dot, suffix = name.rpartition(".")
    return stem if dot and stem and suffix[:1].isalpha() else name


def _on_one_line(name: str) -> str:
    """Return ``name`` on one line."""
    return CONTROL.sub(" ", name)
