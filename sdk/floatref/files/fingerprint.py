"""Fingerprints of files, for the provenance of a profile."""

import hashlib
from pathlib import Path

from floatref.files.recording_directory import DOCUMENT, sample_files
from floatref.files.sources import document_path, open_bytes


def fingerprint(path: Path) -> dict[str, str]:
    """Return the SHA-256 of every file of the recording at ``path``, by file name.

    ``path`` is the directory or its recording.json. Raises InputError as `read_recording` does for
    the JSON file, and for a sample file that cannot be read.
    """
    document = document_path(path, DOCUMENT)
    names = (document.name, *sample_files(document))
    return {name: sha256(document.with_name(name)) for name in names}


def fingerprint_native(path: Path) -> dict[str, str]:
    """Return the SHA-256 of a native file, or of every file directly in a native folder.

    Raises InputError for a file that cannot be read.
    """
    if not path.is_dir():
        return {path.name: sha256(path)}
    return {item.name: sha256(item) for item in sorted(path.iterdir()) if item.is_file()}


def sha256(path: Path) -> str:
    """Return the SHA-256 of the file ``path``; InputError if it cannot be read."""
    with open_bytes(path) as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
