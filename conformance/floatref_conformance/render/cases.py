"""`cases/*.json`: the failing cases, to be replayed and run again."""

import json
from dataclasses import dataclass
from pathlib import Path

from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref_conformance.case_files import FOLDER, document, name_of
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import CheckResult, RunResult
from floatref_conformance.judge.events import Event, RunFinished


@dataclass(frozen=True)
class CaseFiles:
    """Writes the simplest failing case of every check into ``folder`` when the run is over."""

    folder: Path

    @classmethod
    def into(cls, folder: Path) -> "CaseFiles":
        """Return a writer into ``folder``, made if need be; OSError if it cannot be.

        Raises InputError if its folder of cases is a link: a device may have planted it.
        """
        _refuse_link(folder / FOLDER)
        (folder / FOLDER).mkdir(parents=True, exist_ok=True)
        return cls(folder)

    def handle(self, event: Event) -> None:
        """Write what the finished run found."""
        if isinstance(event, RunFinished):
            for check in event.result.checks:
                self._write(check, event.result)

    def _write(self, check: CheckResult, result: RunResult) -> None:
        found = check.counterexample
        if found is None:
            return
        case = Case.of(check.id, found["parameters"])
        spec = str(result.device["spec"])
        kept = document(case, result.device_class, spec, found["reason"], result.edition)
        text = json.dumps(kept, indent=2, ensure_ascii=False) + "\n"
        _refuse_link(self.folder / FOLDER)
        with replace_file(self.folder / name_of(case), overwrite=True, follow=False) as beside:
            # A lone surrogate, which UTF-8 has no bytes for, becomes its escape in JSON.
            beside.write_bytes(text.encode("utf-8", "backslashreplace"))


def _refuse_link(folder: Path) -> None:
    if folder.is_symlink():
        raise InputError(f"{folder}: is a link, cases are not written through it; remove it")
