"""Export of recordings for a device on another machine; its profiles are judged later."""

import shutil
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from hashlib import sha256
from pathlib import Path

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
"""Digits of a recording's name. They come from its content and do not reveal the case."""


@dataclass
class ExportBench:
    """A bench that writes every recording into a folder and returns the true profile."""

    folder: Path
    description: Description
    written: set[str] = field(default_factory=set)

    def simulate(self, scenario: Scenario) -> Taken:
        """Return the recording of ``scenario`` with the channels of the capabilities."""
        taken = make_taken(restrict_channels(self.description, scenario))
        return replace(taken, recording=visible(taken.recording, self.description.channels))

    def run(self, taken: Taken, label: str = "") -> Profile:
        """Write ``taken.recording`` unless it is already in the folder, and return its truth."""
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
    """Return the name of a recording directory, computed from its content alone."""
    digests = fingerprint(recording)
    text = "\n".join(f"{Path(name).name} {digests[name]}" for name in sorted(digests))
    return sha256(text.encode()).hexdigest()[:NAME_LENGTH]


def export(
    checks: Iterable[Check],
    folder: Path,
    description: Description,
    seed: int,
    effort: Effort,
    report: Callable[[str, int], None],
) -> int:
    """Write every recording that the seeded cases of ``checks`` need, and return how many.

    ``report`` is called with each check's id and the number of recordings so far. Checks whose
    needs ``description`` does not meet are left out. ``folder`` is there, and empty.
    """
    bench = ExportBench(folder, description)
    for check in checks:
        if check.needs <= description.meets:
            for case in fit_check(check, description.meets).cases(seed, effort):
                _record(check, case, bench)
        report(check.id, len(bench.written))
    return len(bench.written)


def _record(check: Check, case: Case, bench: ExportBench) -> None:
    """Let ``check`` request its recordings; its result for the truth is not used."""
    try:
        check.judge(case, bench)
    except DeviceError:
        return
