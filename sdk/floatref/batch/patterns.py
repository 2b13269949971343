"""Patterns of names that the shell did not expand, as in ``'2026/**/*.mf4'``."""

from collections.abc import Iterator
from glob import has_magic
from pathlib import Path

from floatref.errors import InputError


def matching(text: str) -> tuple[Path, list[Path]]:
    """Return the folder before the first sign of a pattern, and what matches ``text``, sorted.

    What is hidden below that folder matches only a pattern that names hidden things. Raises
    InputError for a pattern that is none.
    """
    parts = Path(text).parts
    first = next(at for at, part in enumerate(parts) if has_magic(part))
    base, rest = Path(*parts[:first]).absolute(), parts[first:]
    try:
        found = sorted(base.glob("/".join(rest)))
    except (ValueError, NotImplementedError) as error:
        raise InputError(f"{text}: no pattern ({error}); write ** as a name of its own") from error
    if any(_hidden(rest)):
        return base, found
    return base, [path for path in found if not any(_hidden(path.relative_to(base).parts))]


def _hidden(parts: tuple[str, ...]) -> Iterator[bool]:
    return (part.startswith(".") for part in parts)
