"""Pages that count the judge's checks count those it has, and the class table adds up.

The list is the judge's own; what a device passes is of a run, here of the default device. The other
rows of the table are taken by `.ci/class_table.py`.
"""

import importlib
import re
from pathlib import Path

import pytest

from floatref_conformance.checks.catalogue import IDS

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
WORDS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
WORDS += ("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen")
PASSED = ("quiescent", "bounce", "throttle", "distance")
ALL = WORDS[len(IDS)]
REST = WORDS[len(IDS) - 1]
"""All checks, and all but one."""
COUNTED = {
    "conformance.md": (f"and {ALL} checks compare it",),
    "firmware.md": (
        f"It has {ALL} checks.",
        f"because the other {REST} were not run",
        f"of the {ALL} checks of class",
        f"method passes all {ALL}:",
    ),
    "index.md": (f"the judge with {ALL} checks",),
    "tutorial.md": (f"its {ALL} checks show", f"runs all {ALL},"),
    "your-format.md": (f"All {ALL} checks take",),
    "your-own-tests.md": (f"each of the {ALL}",),
    "../README.md": (f"{ALL.capitalize()} checks judge",),
    "examples/vendor_plugin/README.md": (f"of the {ALL} checks",),
}


def page(name: str) -> str:
    return " ".join((DOCS / name).read_text(encoding="utf-8").split())


@pytest.mark.parametrize("name", COUNTED)
def test_a_page_counts_the_checks_there_are(name: str) -> None:
    for text in COUNTED[name]:
        assert text in page(name), text


def test_no_other_page_counts_them() -> None:
    """A page that does belongs in the list above; where a device runs fewer, the page says why."""
    counts = re.compile(rf"\b(?:{'|'.join(WORDS[10:])}) checks\b")
    found = {
        p.relative_to(DOCS).as_posix() for p in DOCS.rglob("*.md") if "decisions" not in p.parts
    }
    counting = {name for name in found if counts.search(page(name))}
    assert counting <= COUNTED.keys() | {"response-limits.md"}


def test_every_row_of_the_class_table_adds_up(monkeypatch) -> None:
    rows = table(monkeypatch).rows_of_page()
    assert len(rows) >= 6
    for row in rows:
        assert row.fails <= set(IDS), row.device
        assert row.passed + len(row.fails) == len(IDS), row.device


@pytest.mark.slow
def test_the_default_device_fails_one_and_passes_one_as_the_table_says(monkeypatch) -> None:
    module = table(monkeypatch)
    first = module.rows_of_page()[0]
    fails = min(first.fails)
    found = module.judge(first.device, fails, PASSED[0])
    assert (found.fails, found.passed) == ({fails}, 1)


@pytest.mark.slow
@pytest.mark.nightly
def test_the_default_device_passes_and_fails_what_the_table_says(monkeypatch) -> None:
    module = table(monkeypatch)
    first = module.rows_of_page()[0]
    # A whole run takes minutes: those that fail, and some that pass.
    found = module.judge(first.device, *sorted(first.fails), *PASSED)
    assert (found.fails, found.passed) == (first.fails, len(PASSED))


def test_the_readme_counts_what_the_default_device_passes(monkeypatch) -> None:
    first = table(monkeypatch).rows_of_page()[0]
    assert f"the exit code 1: {WORDS[first.passed]} pass," in page("../README.md")


def test_a_row_is_renewed_in_its_place_alone(monkeypatch) -> None:
    module = table(monkeypatch)
    text = module.PAGE.read_text(encoding="utf-8")
    first, *others = module.rows_of_page()
    assert module.renewed(text, first) == text
    better = first._replace(passed=len(IDS) - 1, fails=frozenset({"stop"}))
    monkeypatch.setattr(module, "PAGE", Shown(module.renewed(text, better)))
    assert module.rows_of_page() == [better, *others]


def table(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("class_table")


class Shown:
    """A page in place of a file."""

    def __init__(self, text: str) -> None:
        self.text = text

    def read_text(self, encoding: str) -> str:
        return self.text
