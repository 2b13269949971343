"""The page on batches: its columns are those of the summary."""

import re
from pathlib import Path

from floatref.batch.jobs.manifest import COLUMNS as MANIFEST_COLUMNS
from floatref.batch.results.positions import LONGEST_GAP_S
from floatref.batch.results.summary import COLUMNS

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "batch.md").read_text(encoding="utf-8")


def test_every_column_of_the_summary_is_explained_in_order() -> None:
    table = PAGE.partition("## What a row says")[2].partition("\n\n`summary.parquet`")[0]
    cells = re.findall(r"^\| (`.+?) \| .* \|$", table, re.MULTILINE)
    assert re.findall(r"`(\w+)`", " ".join(cells)) == list(COLUMNS)
    assert f"gaps of more than {LONGEST_GAP_S:g} s" in table


def test_the_columns_of_a_manifest_are_those_that_are_read() -> None:
    (said,) = re.findall(r"a column (`file`.+?)\. Paths", PAGE, re.DOTALL)
    assert tuple(re.findall(r"`(\w+)`", said)) == MANIFEST_COLUMNS
