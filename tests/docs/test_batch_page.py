"""The page on batches: what it shows is printed, and its columns are those of the summary."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from floatref.batch.jobs.manifest import COLUMNS as MANIFEST_COLUMNS
from floatref.batch.results.positions import LONGEST_GAP_S
from floatref.batch.results.summary import COLUMNS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "batch.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_every_command_prints_what_the_page_shows() -> None:
    found = subprocess.run(
        [sys.executable, ".ci/consoles.py", "docs/batch.md"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr


def test_every_column_of_the_summary_is_explained_in_order() -> None:
    table = PAGE.partition("## What a row says")[2].partition("\n\n`summary.parquet`")[0]
    cells = re.findall(r"^\| (`.+?) \| .* \|$", table, re.MULTILINE)
    assert re.findall(r"`(\w+)`", " ".join(cells)) == list(COLUMNS)
    assert f"gaps of more than {LONGEST_GAP_S:g} s" in table


def test_the_columns_of_a_manifest_are_those_that_are_read() -> None:
    (said,) = re.findall(r"a column (`file`.+?)\. Paths", PAGE, re.DOTALL)
    assert tuple(re.findall(r"`(\w+)`", said)) == MANIFEST_COLUMNS
