"""Recordings for devices that are not at hand: written now, their profiles judged later."""

import shutil
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path

from floatref.errors import InputError
from floatref.files import fingerprint, write_recording
from floatref.values.profile import Profile
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import Check, Taken, fit_check
from floatref_conformance.classes import Effort
from floatref_conformance.devices.interface import Description, visible
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.bench import make_taken, restrict_channels
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.proving_ground.scenario import Scenario

NAME_LENGTH = 12
"""Digits of a recording's name: from its content, so that it tells nothing."""


@dataclass
class ExportBench:
    """A bench whose device writes down what it is given and answers with the truth."""

    folder: Path
    description: Description
    written: set[str] = field(default_factory=set)

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels of the capabilities."""
        taken = make_taken(restrict_channels(self.description, scenario))
        return replace(taken, recording=visible(taken.recording, self.description.channels))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Write ``taken.recording`` into the folder unless it is there, and return its truth."""
        beside = Path(tempfile.mkdtemp(prefix=".new-", dir=self.folder))
        try:
            made = beside / "recording"
            write_recording(visible(taken.recording, self.description.channels), made)
            name = content_name(made)
            if name not in self.written and not (self.folder / name).exists():
                made.rename(self.folder / name)
            self.written.add(name)
        finally:
            shutil.rmtree(beside, ignore_errors=True)
        return make_perfect(taken)


def content_name(recording: Path) -> str:
    """Return the name of a recording directory that follows from its content alone."""
    digests = fingerprint(recording)
    text = "\n".join(f"{Path(name).name} {digests[name]}" for name in sorted(digests))
    return sha256(text.encode()).hexdigest()[:NAME_LENGTH]


def export(
    checks: Iterable[Check],
    folder: Path,
    description: Description,
    seed: int,
    effort: Effort,
    told: Callable[[str, int], None],
) -> int:
    """Write every recording that the seeded cases of ``checks`` need, and return how many.

    ``told`` is given each check's id and how many recordings there are by then. Checks whose
    needs ``description`` does not meet are left out. Raises InputError if
    ``folder`` cannot be made or is there.
    """
    _make(folder)
    bench = ExportBench(folder, description)
    for check in checks:
        if check.needs <= description.meets:
            for case in fit_check(check, description.meets).cases(seed, effort):
                _record(check, case, bench)
        told(check.id, len(bench.written))
    return len(bench.written)


def _record(check: Check, case: Case, bench: ExportBench) -> None:
    """Have ``check`` ask for all it needs; what it thinks of the truth does not matter."""
    try:
        check.judge(case, bench)
    except DeviceError:
        return


def _make(folder: Path) -> None:
    if folder.exists() or folder.is_symlink():
        raise InputError(f"{folder}: exists; choose another name")
    try:
        folder.mkdir()
    except OSError as error:
        raise InputError(f"{folder}: {error.strerror}; choose another place") from error
