"""Cases as files, `floatref-case/1`: what failed once is kept and run again."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from reprlib import repr as shortened
from typing import Any

from floatref.errors import InputError
from floatref_conformance import EDITION
from floatref_conformance.checks.case import Case
from floatref_conformance.classes import DeviceClass
from floatref_conformance.proving_ground.scenario import Scenario

FORMAT = "floatref-case/1"
FOLDER = "cases"
"""Folder of a report directory that holds the cases."""
LARGEST_BYTES = 1 << 20


@dataclass(frozen=True)
class KeptCase:
    """A case in a file; ``device_class`` is the one whose limits it broke.

    ``refused`` says why this edition cannot run it, and then none of its numbers were read; it is
    empty otherwise.
    """

    file: str
    case: Case
    device_class: DeviceClass
    refused: str = ""


def name_of(case: Case) -> str:
    """Return the name in a report directory of the file that keeps ``case``."""
    return f"{FOLDER}/{case.check}-{case.digest}.json"


def document(case: Case, device_class: DeviceClass, device: str, reason: str) -> dict[str, Any]:
    """Return the JSON object that keeps ``case``, which ``device`` failed for ``reason``."""
    return {
        "format": FORMAT,
        "edition": EDITION,
        "check": case.check,
        "class": device_class.value,
        "device": device,
        "reason": reason,
        **case.parameters,
    }


def read_case(path: Path) -> KeptCase:
    """Return the case in file ``path``; InputError, naming the file, if it holds none.

    One of another edition is `refused`.
    """
    try:
        if path.stat().st_size > LARGEST_BYTES:
            raise InputError(f"{path}: larger than any case; name a case file")
        found = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; name a case file") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: not JSON ({error}); name a case file") from error
    try:
        return _parse_case(path.name, found)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def read_cases(folder: Path) -> tuple[KeptCase, ...]:
    """Return the cases kept in report directory ``folder``, by name; none if there are none."""
    return tuple(read_case(path) for path in sorted((folder / FOLDER).glob("*.json")))


def _parse_case(name: str, found: object) -> KeptCase:
    if not isinstance(found, Mapping) or found.get("format") != FORMAT:
        told = found.get("format") if isinstance(found, Mapping) else type(found).__name__
        raise InputError(f"format {told!r}: unknown, expected {FORMAT!r}")
    check, told = found.get("check"), found.get("class", DeviceClass.NOMINAL.value)
    if not isinstance(check, str):
        raise InputError("has no check; give its id")
    edition = found.get("edition")
    if edition != EDITION:
        return KeptCase(
            name, Case(check, Scenario()), DeviceClass.NOMINAL, _describe_edition(edition)
        )
    if told not in list(DeviceClass):
        raise InputError(f"class {told!r}: unknown; choose from {', '.join(DeviceClass)}")
    return KeptCase(name, Case.of(check, found, Path(name).stem), DeviceClass(told))


def _describe_edition(edition: object) -> str:
    told = "has no edition" if edition is None else f"is of edition {shortened(edition)}"
    return f"the case {told}, and its numbers may mean something else in {EDITION}; take it out"
