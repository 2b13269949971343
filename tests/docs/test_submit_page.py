"""The page on submissions: what it shows is printed, and its tables are those of code and tests."""

import subprocess
import sys
from pathlib import Path

import pytest
from tests.conformance.submission.tamperings import TAMPERINGS

from floatref_conformance.resemblance import reviewing
from floatref_conformance.submission import agreement, stored_zip
from floatref_conformance.submission.checksums import SUMS
from floatref_conformance.submission.document import NAME
from floatref_conformance.submission.packing import RESULTS
from floatref_conformance.submission.stored_answers import FOLDER

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "submit.md").read_text(encoding="utf-8")


def rows(first: str) -> list[list[str]]:
    """Return the cells of the table whose head begins with ``first``."""
    table = PAGE[PAGE.index(f"| {first} |") :].split("\n\n")[0]
    return [line.strip("| ").split(" | ") for line in table.splitlines()[2:]]


def test_every_tampering_is_listed_with_what_shows_it() -> None:
    expected = []
    for tampering in TAMPERINGS:
        shown = "nothing: a signature shows it"
        if tampering.with_device:
            shown = f"with the device: `{tampering.with_device}`"
        if tampering.alone:
            shown = f"`{tampering.alone}`"
        expected.append([tampering.name + ", with a report that fits" * tampering.forged, shown])
    assert rows("what is changed") == expected
    (line,) = [x for x in (ROOT / "CHANGELOG.md").read_text().splitlines() if "tamperings" in x]
    assert {38: "thirty-eight"}[len(TAMPERINGS)] in line


def test_digits_are_those_of_the_code() -> None:
    cells = [cell for _, cell in rows("figure")]
    assert cells[1] == f"within {agreement.SCORED:g} of the larger of value and limit"
    assert cells[2] == f"within {agreement.REMADE:g} of the larger of value and limit"
    assert cells[3] == f"within {agreement.TRUTH_M:g} m"
    assert cells[5].startswith(f"within {agreement.SCORED:g} or {agreement.REMADE:g} of the larger")
    assert cells[6] == f"within {reviewing.REMADE:g}"
    assert f"1 GiB and {stored_zip.MOST_MEMBERS} members" in PAGE
    assert stored_zip.MOST_BYTES == 1 << 30


def test_members_are_those_of_an_archive() -> None:
    first = [cell.split("`")[1].split("/")[0] for cell, _ in rows("member")]
    assert first == [SUMS, f"{SUMS}.sig", NAME, "report.json", RESULTS, "cases", FOLDER]


@pytest.mark.slow
def test_every_command_prints_what_the_page_shows() -> None:
    words = [sys.executable, ".ci/consoles.py", "docs/submit.md"]
    found = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    assert found.returncode == 0, found.stdout + found.stderr
