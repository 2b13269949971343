"""Names of sources in the output: one each, safe as a path, and the same from run to run.

A name becomes a folder below ``profiles`` and a file below ``records``, so that neither may lie
inside another's, also on a disk that does not distinguish capitals.
"""

import os
import re
import unicodedata
from collections import Counter
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path, PurePosixPath

UNSAFE = re.compile(r'[<>:"|?*\\/]|^\.|[. ]$')
"""Characters that some systems or shares refuse or remove in a part of a name."""
LONGEST = 200
"""Bytes of a part; with a tag it must fit into the 255 that disks allow."""
DIGITS = (8, 16, 32, 64)
"""Digits of a hash that distinguish names; more where that name already exists."""
RECORD = ".json"


def name_below(path: Path, base: Path) -> str:
    """Return the path of ``path`` from ``base`` as a safe name; its own name if it is outside."""
    parts = path.relative_to(base).parts if path.is_relative_to(base) else ()
    if not parts or ".." in parts:
        parts = (path.name,)
    return "/".join(map(_safe, parts))


def unique_names(names: Sequence[str], sources: Sequence[Path]) -> tuple[str, ...]:
    """Return ``names``, with a hash of the path of its source in each that collides.

    ``sources`` has the same length; its paths are absolute and different. The order does not
    matter.
    """
    found = list(names)
    for digits in DIGITS:
        for index in _find_meeting(found):
            found[index] = _mark(names[index], sources[index], digits)
    return tuple(found)


def _safe(part: str) -> str:
    """Return ``part`` without characters that are unsafe, hide the file, or change the folder."""
    plain = "".join(c if c.isprintable() else "_" for c in part)
    plain = UNSAFE.sub("_", plain) or "_"
    if len(plain.encode()) <= LONGEST:
        return plain
    return _tag(plain, _digest(part)[: DIGITS[0]])


def _mark(name: str, source: Path, digits: int) -> str:
    place = PurePosixPath(name)
    tag = _digest(os.fsdecode(os.path.realpath(source)))[:digits]
    return str(place.with_name(_tag(place.name, tag)))


def _tag(part: str, tag: str) -> str:
    """Return ``part`` with ``tag`` before its suffix, shortened where it is too long."""
    place = PurePosixPath(part)
    suffix = place.suffix if len(place.suffix.encode()) <= 20 else ""
    stem = part.removesuffix(suffix).encode()[: LONGEST - len(tag) - len(suffix.encode()) - 1]
    return f"{stem.decode(errors='ignore')}-{tag}{suffix}"


def _digest(text: str) -> str:
    return sha256(os.fsencode(text)).hexdigest()


def _find_meeting(names: Sequence[str]) -> list[int]:
    """Return which of ``names`` are equal, or lie inside another's profile or record."""
    keys = [tuple(_fold(name).split("/")) for name in names]
    counts = Counter(keys)
    folders = {key[:end] for key in counts for end in range(1, len(key))}
    return [
        at
        for at, key in enumerate(keys)
        if counts[key] > 1 or key in folders or (*key[:-1], key[-1] + RECORD) in folders
    ]


def _fold(name: str) -> str:
    """Return ``name`` as a disk compares it that ignores case and the encoding of accents."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())
