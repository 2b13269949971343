"""Cases as files, `floatref-case/1`: a case that failed once is stored and run again."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from reprlib import repr as shortened
from typing import Any

from floatref.errors import InputError
from floatref.files import read_bytes
from floatref_conformance.checks.case import Case
from floatref_conformance.classes import DeviceClass
from floatref_conformance.editions import EDITION, EDITIONS
from floatref_conformance.proving_ground.scenario import Scenario

FORMAT = "floatref-case/1"
FOLDER = "cases"
"""Folder of a report directory that holds the cases."""
LARGEST_BYTES = 1 << 20


@dataclass(frozen=True)
class KeptCase:
    """A case in a file; ``device_class`` is the one whose limits it exceeded.

    ``refused`` is the reason why this edition cannot run the case; its numbers are then not read.
    It is empty for a case that can be run. ``edition`` is the one whose checks judge the case.
    """

    file: str
    case: Case
    device_class: DeviceClass
    refused: str = ""
    edition: str = EDITION


def name_of(case: Case) -> str:
    """Return the name in a report directory of the file that stores ``case``."""
    return f"{FOLDER}/{case.check}-{case.digest}.json"


def document(
    case: Case, device_class: DeviceClass, device: str, reason: str, edition: str = EDITION
) -> dict[str, Any]:
    """Return the JSON object that stores ``case``, which ``device`` failed for ``reason``."""
    return {
        "format": FORMAT,
        "edition": edition,
        "check": case.check,
        "class": device_class.value,
        "device": device,
        "reason": reason,
        **case.parameters,
    }


def read_case(path: Path, edition: str | None = None, links: bool = True) -> KeptCase:
    """Return the case in file ``path``; InputError, naming the file, if it holds no case.

    Without ``links`` a symbolic link is refused. A case of an edition that is not ``edition``, or
    without it not one of ours, is `refused`.
    """
    try:
        found = json.loads(read_bytes(path, LARGEST_BYTES, "case", links).decode("utf-8"))
    except InputError as error:
        raise InputError(f"{error}; name a case file") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: not JSON ({error}); name a case file") from error
    try:
        return _parse_case(path.name, found, edition)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def read_cases(folder: Path, edition: str = EDITION) -> tuple[KeptCase, ...]:
    """Return the cases stored in report directory ``folder``, by name; empty without cases.

    Those of an edition other than ``edition`` are `refused`. InputError for a symbolic link: a
    device can have put it there.
    """
    cases = folder / FOLDER
    if cases.is_symlink():
        raise InputError(f"{cases}: is a link; take it out, or name another folder of reports")
    return tuple(read_case(path, edition, links=False) for path in sorted(cases.glob("*.json")))


def _parse_case(name: str, found: object, wanted: str | None) -> KeptCase:
    if not isinstance(found, Mapping) or found.get("format") != FORMAT:
        given = found.get("format") if isinstance(found, Mapping) else type(found).__name__
        raise InputError(f"format {given!r}: unknown, expected {FORMAT!r}")
    check, class_name = found.get("check"), found.get("class", DeviceClass.NOMINAL.value)
    if not isinstance(check, str):
        raise InputError("has no check; give its id")
    edition = found.get("edition")
    if edition not in EDITIONS or wanted not in (None, edition):
        reason = _describe_edition(edition, wanted or EDITION)
        return KeptCase(name, Case(check, Scenario()), DeviceClass.NOMINAL, reason)
    if class_name not in list(DeviceClass):
        raise InputError(f"class {class_name!r}: unknown; choose from {', '.join(DeviceClass)}")
    case = Case.of(check, found, Path(name).stem)
    return KeptCase(name, case, DeviceClass(class_name), edition=str(edition))


def _describe_edition(edition: object, wanted: str) -> str:
    state = "has no edition" if edition is None else f"is of edition {shortened(edition)}"
    return f"the case {state}, and its numbers may mean something else in {wanted}; take it out"
