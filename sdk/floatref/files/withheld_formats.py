"""Profile formats that users ask for and that are refused: why, and what to do.

A layout that is not public is not guessed: such a file might open in another program and be wrong.
A plug-in that registers a format of the same suffix, from a licensed copy, is used as any other.
"""

from collections.abc import Mapping
from pathlib import Path

from floatref.errors import InputError

WITHHELD: Mapping[str, str] = {
    ".ppf": (
        "PPF is not supported: the order of its fields is in ASTM E2560, which is sold and of "
        "which there is no public description"
    ),
    ".pro": (
        "Texas PRO is not supported: the layout of its lines is in section 6 of Tex-1001-S, which "
        "no public copy that could be opened has in full"
    ),
}
"""What is missing of a format, in words, by the suffix of its files."""
INSTEAD = "write ERD, open it in ProVAL and export it there"
EXPORTED = "open it in ProVAL and export it as ERD"


def refuse_to_write(out: Path) -> None:
    """Raise InputError if the suffix of ``out`` is that of a format that is not written."""
    _refuse(out, INSTEAD)


def refuse_to_read(path: Path) -> None:
    """Raise InputError if the suffix of the file ``path`` is that of a format that is not read."""
    if path.suffix.lower() in WITHHELD and path.is_file():
        _refuse(path, EXPORTED)


def _refuse(path: Path, remedy: str) -> None:
    missing = WITHHELD.get(path.suffix.lower())
    if missing is not None:
        raise InputError(f"{path}: {missing}; {remedy}")
