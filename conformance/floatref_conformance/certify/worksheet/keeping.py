"""The report folder of a certification: the worksheet, and the profiles that it rests on.

`floatref compare` on `reference/<section>` and `runs/<section>/<run>`, or on two runs, gives every
correlation and IRI of the worksheet again.
"""

import os
import re
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from floatref.errors import InputError
from floatref.files import write_profile
from floatref.files.owners import own_name, sweep_once
from floatref_conformance.certify.judging.contents import Worksheet

DOCUMENT = "worksheet.json"
PAGE = "worksheet.html"
REFERENCE, RUNS, STATIONARY = "reference", "runs", "stationary"
OURS = {DOCUMENT, PAGE, REFERENCE, RUNS, STATIONARY}
"""Files of a report folder; a folder with others is not replaced."""
NO_NAME = re.compile(r'[\x00-\x1f\x7f<>:"/\\|?*]+')
"""What no file name has on any system."""
LONGEST_NAME = 80

Writer = Callable[[Worksheet, Path], None]
"""Writes a worksheet to a file."""


def check_report(folder: Path) -> None:
    """Raise InputError, before the work, unless ``folder`` can become a report.

    It may exist if it is empty or holds an earlier report and nothing else.
    """
    target = Path(os.path.realpath(folder))
    if target.is_symlink():
        raise InputError(f"{folder}: is a loop of links; remove it, or choose another name")
    if not target.parent.is_dir():
        raise InputError(f"{folder}: its folder does not exist; make {target.parent} first")
    if not target.exists():
        return
    if not target.is_dir():
        raise InputError(f"{folder}: is not a folder; give the name of a folder for the report")
    names = {entry.name for entry in target.iterdir()}
    if names and DOCUMENT not in names:
        raise InputError(f"{folder}: holds other files and no {DOCUMENT}; choose another folder")
    if names - OURS:
        other = min(names - OURS)
        raise InputError(f"{folder}: holds {other}, which is of no report; move it elsewhere")


def write_report(worksheet: Worksheet, folder: Path, document: Writer, page: Writer) -> None:
    """Write ``worksheet`` and its profiles to ``folder``, complete or not at all.

    ``document`` writes worksheet.json and ``page`` worksheet.html. An earlier report stays until
    the new one is complete. Raises InputError if ``folder`` cannot be one, or not be written.
    """
    check_report(folder)
    with _replace_folder(folder) as beside:
        _write_profiles(worksheet, beside)
        page(worksheet, beside / PAGE)
        document(worksheet, beside / DOCUMENT)


def folders_of(names: Sequence[str]) -> tuple[str, ...]:
    """Return a folder's name for every name of ``names``, all different on any system."""
    taken: set[str] = set()
    made = []
    for name in names:
        plain = NO_NAME.sub("-", name)[:LONGEST_NAME].strip(" .") or "run"
        free, number = plain, 2
        while free.casefold() in taken:
            free, number = f"{plain}-{number}", number + 1
        taken.add(free.casefold())
        made.append(free)
    return tuple(made)


def _write_profiles(worksheet: Worksheet, folder: Path) -> None:
    """Write what was compared: references, runs and stationary tests."""
    names = folders_of([section.name for section in worksheet.sections])
    for name, section in zip(names, worksheet.sections, strict=True):
        (folder / REFERENCE).mkdir(exist_ok=True)
        write_profile(section.reference, folder / REFERENCE / name)
        place = folder / RUNS / name
        place.mkdir(parents=True)
        for own, run in zip(folders_of([r.name for r in section.runs]), section.runs, strict=True):
            if run.profile is not None:
                write_profile(run.profile, place / own)
    for sheet in worksheet.stationary:
        if sheet.profile is not None:
            (folder / STATIONARY).mkdir(exist_ok=True)
            write_profile(sheet.profile, folder / STATIONARY / sheet.id)


@contextmanager
def _replace_folder(folder: Path) -> Iterator[Path]:
    """Yield a new folder beside ``folder``; give it that name when all went well."""
    target = Path(os.path.realpath(folder))
    sweep_once(target.parent)
    beside = target.with_name(own_name())
    try:
        beside.mkdir()
        yield beside
        _exchange(beside, target)
    except OSError as error:
        raise InputError(
            f"{folder}: cannot be written ({error.strerror or error}); free space there or choose "
            "another folder"
        ) from error
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def _exchange(new: Path, target: Path) -> None:
    """Give ``new`` the name ``target``; the earlier report comes back if that fails."""
    if not target.exists():
        os.rename(new, target)
        return
    old = new.with_name(f"{new.name}-old")
    os.rename(target, old)
    try:
        os.rename(new, target)
    except BaseException:
        os.rename(old, target)
        raise
    shutil.rmtree(old, ignore_errors=True)
