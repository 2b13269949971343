"""Devices on another machine: their profiles of exported recordings, from a folder."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floatref.errors import InputError
from floatref.files import fingerprint
from floatref.files.document import read_document
from floatref_conformance.devices.delivered import take
from floatref_conformance.devices.interface import DeviceKind
from floatref_conformance.errors import DeviceSkipped

RECORDING = "recording.json"
PROFILE = "profile.json"
DESCRIPTION = "device.json"

Digests = Mapping[str, str]


@dataclass(eq=False)
class RecordedDevice:
    """Profiles in ``folder``, next to the recordings that they were made of.

    A recording is identified by its content, not by the name of its folder.

    Attributes:
        folder: contains `<case>/recording.json`, `<case>/profile.json` and their files.
        description: the device's description of itself.
        searchable: False; a search needs recordings that depend on the answers.
        concurrent: True; copies in several processes read the same files.
    """

    folder: Path
    description: Mapping[str, Any]
    searchable: bool = field(default=False, init=False)
    concurrent: bool = field(default=True, init=False)
    _digests: dict[Path, Digests] = field(default_factory=dict, init=False, repr=False)

    def describe(self) -> Mapping[str, Any]:
        """Return the content of device.json, or the folder's name and nominal sensors."""
        return self.description

    def run(self, recording: Path, profile: Path) -> None:
        """Copy the profile of ``recording`` to ``profile``; DeviceSkipped without one."""
        wanted = fingerprint(recording)
        case = next((c for c in self._like(recording, wanted) if self._of(c) == wanted), None)
        if case is None:
            raise DeviceSkipped(f"{self.folder}: no such recording in it; export with this seed")
        if not (case / PROFILE).is_file():
            raise DeviceSkipped(f"{case}: no {PROFILE} in it; process its {RECORDING}")
        take(case, profile, without=wanted)

    def _like(self, recording: Path, wanted: Digests) -> Iterator[Path]:
        """Yield the cases whose files have the names and sizes of those of ``recording``."""
        sizes = {name: (recording.parent / name).stat().st_size for name in wanted}
        for case in cases(self.folder):
            files = {name: case / name for name in wanted}
            if all(p.is_file() and p.stat().st_size == sizes[n] for n, p in files.items()):
                yield case

    def _of(self, case: Path) -> Digests:
        """Return the fingerprint of the recording in ``case``; empty if it cannot be read."""
        if case not in self._digests:
            try:
                self._digests[case] = fingerprint(case)
            except InputError:
                self._digests[case] = {}
        return self._digests[case]


def cases(folder: Path) -> list[Path]:
    """Return the folders in ``folder`` that contain a recording, sorted by name."""
    return sorted(path.parent for path in folder.glob(f"*/{RECORDING}"))


def make(name: str) -> RecordedDevice:
    """Return the device of folder ``name``.

    Raises InputError if there is no such folder, if it contains no recording, or if its
    device.json is unusable.
    """
    folder = Path(name).absolute()
    if not folder.is_dir():
        raise InputError(f"device files:{name}: no such folder; `conformance export` makes one")
    if not cases(folder):
        raise InputError(
            f"device files:{name}: no <case>/{RECORDING} in it; give the folder of an export"
        )
    description = _read_description(folder)
    if not isinstance(description, Mapping):
        raise InputError(f"{folder / DESCRIPTION}: not a JSON object; give name and version in one")
    default = {"version": "unknown", "architecture": "temporal", "capabilities": []}
    return RecordedDevice(folder, {"name": folder.name, **default, **description})


def _read_description(folder: Path) -> Any:
    return read_document(folder / DESCRIPTION) if (folder / DESCRIPTION).exists() else {}


FILES = DeviceKind("files", "DIR", make)
