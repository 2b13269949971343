"""Reports of earlier runs, read from files that anybody may have made."""

import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator

from floatref.errors import InputError
from floatref.files import read_bytes
from floatref.files.document import parse_document, show
from floatref.files.sources import document_path, name_errors
from floatref_conformance.render.report import NAME
from floatref_conformance.schemas import read_schema

SCHEMA = "conformance-report-1"
LARGEST_BYTES = 16 << 20
"""Largest report that is read; one of all checks has a hundredth of it."""
LARGEST_DEPTH = 60
"""Most lists and objects within each other; a report has a tenth of it."""
NEEDED = "give the report.json of `conformance run --report`"


@dataclass(frozen=True)
class Terms:
    """What a device was asked. Results are comparable if, and only if, these are the same."""

    edition: str
    device_class: str
    seed: int
    effort: str

    @property
    def in_words(self) -> str:
        """The terms as a line."""
        return (
            f"edition {self.edition}, class {self.device_class}, seed {self.seed}, "
            f"effort {self.effort}"
        )


@dataclass(frozen=True)
class StoredReport:
    """One report: its name in the matrix, the path that was given, and its document."""

    name: str
    path: Path
    document: Mapping[str, Any]

    @property
    def terms(self) -> Terms:
        """What the device was asked."""
        found = self.document
        return Terms(found["edition"], found["class"], found["seed"], found["effort"])

    @property
    def device(self) -> str:
        """SPEC, name and version of the device."""
        device = self.document["device"]
        return f"{device['spec']} ({device['name']} {device['version']})"

    @property
    def checks(self) -> Mapping[str, Mapping[str, Any]]:
        """The checks by id, those of streams behind the others."""
        found = (*self.document["checks"], *self.document.get("stream_checks", ()))
        return {check["id"]: check for check in found}


def read_reports(paths: Sequence[Path]) -> tuple[StoredReport, ...]:
    """Return the reports in ``paths``, each a report.json or a folder with one.

    Their names are the shortest ends of the paths that differ. Raises InputError, in one line,
    for a file that is no report, is broken, or is given twice.
    """
    files = [document_path(path, NAME) for path in paths]
    _refuse_twice(files)
    documents = [_read(path) for path in files]
    names = _name(files)
    return tuple(map(StoredReport, names, paths, documents))


def _refuse_twice(files: Sequence[Path]) -> None:
    counts = Counter(map(os.path.realpath, files))
    for path in files:
        if counts[os.path.realpath(path)] > 1:
            raise InputError(f"{path}: given twice; name each report once")


def _read(path: Path) -> Mapping[str, Any]:
    content = read_bytes(path, LARGEST_BYTES, "report")
    with name_errors(path):
        try:
            document = parse_document(content.decode("utf-8-sig"))
        except UnicodeDecodeError as error:
            raise InputError(f"byte {error.start} is not UTF-8 text; {NEEDED}") from error
        _check(document)
    found: Mapping[str, Any] = document
    return found


def _check(document: Any) -> None:
    """Raise InputError unless ``document`` is a report, with every check once."""
    if not isinstance(document, Mapping) or document.get("format") != "conformance-report/1":
        given = document.get("format") if isinstance(document, Mapping) else document
        raise InputError(f"format {show(given)} is not that of a report; {NEEDED}")
    if _depth_exceeds(document, LARGEST_DEPTH):
        raise InputError(f"nested deeper than {LARGEST_DEPTH} levels; {NEEDED}")
    error = next(Draft202012Validator(read_schema(SCHEMA)).iter_errors(document), None)
    if error is not None:
        place = show(error.json_path)[1:-1]
        raise InputError(f"{place} breaks the format of a report: {_cut(error.message)}; {NEEDED}")
    ids = Counter(
        check["id"] for check in (*document["checks"], *document.get("stream_checks", ()))
    )
    for id_, count in ids.items():
        if count > 1:
            raise InputError(f"has the check {show(id_)} {count} times; {NEEDED}")


def _depth_exceeds(value: Any, limit: int) -> bool:
    if not isinstance(value, (Mapping, list)):
        return False
    inner = value.values() if isinstance(value, Mapping) else value
    return limit == 0 or any(_depth_exceeds(item, limit - 1) for item in inner)


def _cut(message: str, longest: int = 100) -> str:
    return message if len(message) <= longest else f"{message[: longest - 1]}…"


def _name(files: Sequence[Path]) -> list[str]:
    """Return a name for each of ``files``: as few parts from its end as make all differ."""
    parts = [_parts(path) for path in files]
    for count in range(1, max(map(len, parts)) + 1):
        names = ["/".join(words[-count:]) for words in parts]
        if len(set(names)) == len(names):
            return names
    return [str(path) for path in files]


def _parts(path: Path) -> tuple[str, ...]:
    """Return the parts of ``path`` that tell it from others: of report.json, its folder's."""
    full = Path(os.path.abspath(path))
    return full.parent.parts if full.name == NAME else (*full.parent.parts, full.stem)
