"""`report.html`: one file that needs nothing else, for the person who has to act on it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from floatref.files.atomic import replace_file
from floatref_conformance.checks.interface import Check
from floatref_conformance.checks.verdict import RunResult
from floatref_conformance.judge.events import Event, RunFinished, RunStarted
from floatref_conformance.render.page import page_of
from floatref_conformance.render.text import fill_template, needs_jinja

NAME = "report.html"
TEMPLATE = "report.html.j2"


@dataclass
class HtmlReport:
    """Writes ``report.html`` into ``folder`` when the verdict is there.

    The page explains the checks that the first event of a run names.
    """

    folder: Path
    _checks: tuple[Check, ...] = field(default=())

    @classmethod
    def into(cls, folder: Path) -> "HtmlReport":
        """Return a writer into ``folder``, made if need be; OSError if it cannot be.

        The report of an earlier run goes away now, so that it is never taken for this one's.
        Raises InputError where the package that fills in the page is not installed.
        """
        needs_jinja(NAME)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / NAME).unlink(missing_ok=True)
        return cls(folder)

    def handle(self, event: Event) -> None:
        """Keep the checks of a run that starts; write the page of one that has finished."""
        if isinstance(event, RunStarted):
            self._checks = event.checks
        elif isinstance(event, RunFinished):
            with replace_file(self.folder / NAME, overwrite=True, follow=False) as beside:
                beside.write_text(as_html(event.result, self._checks), encoding="utf-8")


def as_html(result: RunResult, checks: Sequence[Check] = ()) -> str:
    """Return the page that shows ``result``; it explains ``checks``.

    All text from a device or a file is escaped, and the page has no link to another file.
    """
    return fill_template(TEMPLATE, page=page_of(result, checks))
