"""Which files are runs: paths, directories of runs and patterns, and unique names for them."""

import glob
import os
import re
from collections.abc import Iterator, Sequence
from itertools import takewhile
from pathlib import Path

from floatref.errors import InputError
from floatref.files.sources import real_path

DOCUMENTS = ("profile.json", "recording.json")
"""Names of the JSON files of our directories: whoever names one means its directory."""
BESIDE = (
    *(".bin", ".dbc", ".tdms_index"),
    *(".html", ".jpg", ".json", ".md", ".pdf", ".png", ".toml", ".xlsx", ".yaml", ".zip"),
)
"""Suffixes in a directory of runs that are no run: what belongs to one, maps, notes, pictures."""
MOST = 100_000
"""Largest number of names below a folder that is searched: that takes about a second."""
PATTERN = re.compile(r"[*?\[]")
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
    if PATTERN.search(text) and not (folder / text).exists():
        if "**" in text:
            _refuse_vast(_before_pattern(folder / text), text)
        matches = sorted(glob.glob(text, root_dir=folder, recursive=True), key=natural)
        if not matches:
            raise InputError(f"{folder / text}: no file matches this pattern; correct it")
        for match in matches:
            path = check_exists(match, folder)
            _refuse_vast(path, match)
            yield from _within(path)
    else:
        path = check_exists(text, folder)
        _refuse_vast(path, text)
        yield from _within(path)


def _before_pattern(path: Path) -> Path:
    """Return the folder in ``path`` before the first part with a pattern's character."""
    return Path(*takewhile(lambda part: not PATTERN.search(part), path.parts))


def _refuse_vast(folder: Path, text: str) -> None:
    """Raise InputError if more than `MOST` names lie below ``folder``, which ``text`` means."""
    count = 0
    for _, folders, files in os.walk(folder):
        count += len(folders) + len(files)
        if count > MOST:
            raise InputError(
                f"{text}: more than {MOST} files and folders lie below {folder}; name a folder "
                "that holds the runs alone"
            )


def _within(path: Path) -> Iterator[Path]:
    """Yield ``path`` if it is a run, else the runs in that directory and those below."""
    if not path.is_dir() or any((path / name).is_file() for name in DOCUMENTS):
        yield path
        return
    for child in sorted(path.iterdir(), key=lambda child: natural(child.name)):
        hidden = child.name.startswith(".")
        if child.is_dir() and not (hidden or child.is_symlink()):
            yield from _within(child)
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
