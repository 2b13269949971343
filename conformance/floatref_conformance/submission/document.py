"""`submission.json`: what was judged, how, on what, and what its submitter states."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from floatref.errors import InputError
from floatref.files.document import parse_document
from floatref.files.schema import enforce_schema
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.interface import Description
from floatref_conformance.errors import DeviceError
from floatref_conformance.schemas import read_schema

NAME = "submission.json"
FORMAT = "conformance-submission/1"
SCHEMA = "conformance-submission-1"
MOST_BYTES = 1 << 25
"""Of a document: thousands of results have a tenth of it."""
LARGEST_SEED = 10**15
"""Beyond that not every reader of JSON keeps all digits."""


@dataclass(frozen=True)
class Submission:
    """The content of `submission.json`, whose keys are the names of the attributes.

    Attributes:
        edition, seed, effort, device_class, checks: what was asked; ``checks`` are those that ran.
        searching: whether cases were drawn beyond those of the edition.
        device: SPEC, description and, as ``files``, the SHA-256 of what makes it.
        fault: why the device could not describe itself, empty if it could.
        end_fault: what was wrong when it was stopped, empty if nothing was.
        timeout_s, variables: as the options of `conformance run`.
        waivers: why each check in it may fail.
        statement: what the submitter states, in free text.
        suite, environment: versions and hashes, as in `origins`.
    """

    edition: str
    seed: int
    effort: Effort
    device_class: DeviceClass
    checks: tuple[str, ...]
    searching: bool
    device: Mapping[str, Any]
    fault: str
    end_fault: str
    timeout_s: float | None
    variables: tuple[str, ...]
    waivers: Mapping[str, str]
    statement: str
    suite: Mapping[str, str]
    environment: Mapping[str, str]

    @property
    def document(self) -> dict[str, Any]:
        """The object of `submission.json`."""
        return {
            "format": FORMAT,
            "edition": self.edition,
            "seed": self.seed,
            "effort": self.effort.value,
            "class": self.device_class.value,
            "checks": list(self.checks),
            "searching": self.searching,
            "device": dict(self.device),
            "fault": self.fault,
            "end_fault": self.end_fault,
            "timeout_s": self.timeout_s,
            "variables": list(self.variables),
            "waivers": [{"check": id_, "reason": why} for id_, why in self.waivers.items()],
            "statement": self.statement,
            "suite": dict(self.suite),
            "environment": dict(self.environment),
        }

    @property
    def about(self) -> tuple[str, ...]:
        """What was judged, and how, in lines; then waivers with reasons, and the statement."""
        device, checks = self.device, len(self.checks)
        how = f"edition {self.edition}, seed {self.seed}, {self.effort} effort"
        return (
            f"device {device['spec']} ({device['name']} {device['version']})",
            f"{how}, class {self.device_class}, {checks} checks"
            + ("" if self.searching else ", without a search"),
            *(f"waived: {id_}: {why}" for id_, why in self.waivers.items()),
            *(f"statement: {line}" for line in self.statement.splitlines() if line.strip()),
        )

    @property
    def description(self) -> dict[str, Any]:
        """What the device says of itself."""
        keys = ("name", "version", "architecture", "capabilities")
        return {key: self.device[key] for key in keys}

    def describe(self) -> Description:
        """Return the description, verified; InputError if no device can say that."""
        try:
            return Description.of(self.description)
        except DeviceError as error:
            raise InputError(f"{NAME}: the device {error}; ask for the archive again") from error


def read_submission(content: bytes) -> Submission:
    """Return the submission in ``content``; InputError if it breaks the schema."""
    found = read_json(content, NAME)
    enforce_schema(found, read_schema(SCHEMA), NAME)
    return Submission(
        found["edition"],
        found["seed"],
        Effort(found["effort"]),
        DeviceClass(found["class"]),
        tuple(found["checks"]),
        found["searching"],
        found["device"],
        found["fault"],
        found["end_fault"],
        found["timeout_s"],
        tuple(found["variables"]),
        {entry["check"]: entry["reason"] for entry in found["waivers"]},
        found["statement"],
        found["suite"],
        found["environment"],
    )


def read_json(content: bytes, name: str) -> Any:
    """Return what the member ``name`` holds; InputError if that is not JSON."""
    if len(content) > MOST_BYTES:
        raise InputError(f"{name}: larger than any submission's, {MOST_BYTES >> 20} MiB")
    try:
        return parse_document(content.decode("utf-8"))
    except UnicodeDecodeError as error:
        raise InputError(f"{name}: not UTF-8 text; ask for the archive again") from error
    except InputError as error:
        raise InputError(f"{name}: {error}") from error


def write_json(document: Any) -> bytes:
    """Return ``document`` as the content of a member: the same object gives the same bytes."""
    text = json.dumps(document, indent=1, sort_keys=True, allow_nan=False)
    return f"{text}\n".encode("ascii")
