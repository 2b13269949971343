"""Atomic writing: the content is written beside the target, then renamed to it."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from floatref.errors import InputError, TargetExists
from floatref.files.owners import PREFIX, own_name, sweep_once

SAMPLE_SUFFIXES = (".f64", ".u8")
"""Suffixes of a directory's sample files, which are deleted when it is replaced."""


@contextmanager
def replace_file(path: Path, overwrite: bool = False, follow: bool = True) -> Iterator[Path]:
    """Yield a path beside ``path``, with its suffix, to write to; rename it at the end.

    After any exception, KeyboardInterrupt included, the new file is gone and ``path`` is as
    before. What a link points to is replaced; without ``follow`` the link itself, for a folder in
    which others may have planted it. Raises InputError if ``path`` exists and ``overwrite`` is
    false, is not a file, or cannot be written.
    """
    target = _target(path, overwrite, follow)
    beside = _beside(target)
    with _explain_errors(path, target):
        if target.exists() and not (target.is_file() or target.is_symlink()):
            raise InputError(f"{path}: is not a file; give the name of a file to write")
        try:
            yield beside
            _refuse_existing(target, overwrite)
            if target.exists():
                _settle(beside)
            os.replace(beside, target)
        finally:
            beside.unlink(missing_ok=True)


@contextmanager
def replace_directory(path: Path, overwrite: bool, document: str) -> Iterator[Path]:
    """Yield a new, empty folder beside ``path``; rename it to ``path`` at the end.

    With ``overwrite`` an old folder is replaced if it is empty or holds the JSON file ``document``;
    other files in it are preserved. After any exception, KeyboardInterrupt included, the new folder
    is gone and ``path`` is as before. Raises InputError if ``path`` exists and may not be replaced,
    or cannot be written.
    """
    target = _target(path, overwrite)
    beside = _beside(target)
    with _explain_errors(path, target):
        _check_replaceable(target, path, document)
        try:
            beside.mkdir()
            yield beside
            _refuse_existing(target, overwrite)
            _exchange(beside, target, document)
        finally:
            shutil.rmtree(beside, ignore_errors=True)


def check_target(path: Path, overwrite: bool = False) -> None:
    """Raise InputError now for a target to which writing would fail later."""
    _target(path, overwrite)


def _target(path: Path, overwrite: bool, follow: bool = True) -> Path:
    """Return the path behind any links, so that a link stays a link.

    Without ``follow`` only the links of its folder are resolved.
    """
    try:
        target = Path(os.path.realpath(path))
        if not follow and path.name not in ("", ".."):
            target = Path(os.path.realpath(path.parent), path.name)
    except ValueError as error:
        raise InputError(f"{str(path)!a}: no possible file name; choose another") from error
    _refuse_existing(target, overwrite)
    if follow and os.path.islink(target):
        raise InputError(f"{path}: is a loop of links; remove it, or choose another name")
    if os.path.exists(target) and not (os.path.isfile(target) or os.path.isdir(target)):
        raise InputError(f"{path}: is not a file or folder; give the name of one to write")
    if not os.path.isdir(target.parent):
        raise InputError(f"{path}: its folder does not exist; make {target.parent} first")
    return target


def _refuse_existing(target: Path, overwrite: bool) -> None:
    if not overwrite and os.path.lexists(target):
        raise TargetExists(f"{target}: exists; choose another name")


def _beside(target: Path) -> Path:
    """Return a new name beside ``target``; what killed processes left there is removed."""
    sweep_once(target.parent)
    return target.with_name(own_name(suffix=target.suffix))


def _check_replaceable(target: Path, path: Path, document: str) -> None:
    if not os.path.lexists(target):
        return
    if not target.is_dir():
        raise InputError(f"{path}: is not a folder; give the name of a folder to write")
    names = os.listdir(target)
    if names and document not in names:
        raise InputError(f"{path}: holds other files and no {document}; choose another folder")


@contextmanager
def _explain_errors(path: Path, target: Path) -> Iterator[None]:
    """Turn an OSError while writing into an InputError of one line that names ``path``."""
    try:
        yield
    except OSError as error:
        where = str(error.filename or target)
        if where != str(target) and PREFIX not in where:
            raise
        reason = error.strerror or str(error)
        raise InputError(
            f"{path}: cannot be written ({reason}); free space there or choose another folder"
        ) from error


def _settle(path: Path) -> None:
    """Flush the content to the disk before a name points to it."""
    # Windows flushes only what is open for writing.
    handle = os.open(path, os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _exchange(new: Path, target: Path, document: str) -> None:
    """Give ``new`` the name ``target``; restore the old folder if that fails."""
    if not target.exists():
        os.rename(new, target)
        return
    for entry in new.iterdir():
        _settle(entry)
    old = new.with_name(f"{new.name}-old")
    try:
        os.rename(target, old)
        os.rename(new, target)
    except BaseException:
        if old.exists() and not target.exists():
            os.rename(old, target)
        raise
    _keep_others(old, target, document)
    shutil.rmtree(old, ignore_errors=True)


def _keep_others(old: Path, target: Path, document: str) -> None:
    for entry in old.iterdir():
        if entry.name != document and not entry.name.endswith(SAMPLE_SUFFIXES):
            os.rename(entry, target / entry.name)
