"""What the page on the road prior from triggered samples says, held to the table behind it."""

import json
import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
DATA = Path(__file__).parent / "data" / "table_triggered.json"
TABLE = json.loads(DATA.read_text(encoding="utf-8"))
CELLS = {(cell["pipeline"], cell["run"]): cell for cell in TABLE["cells"]}
PAGE = (DOCS / "road-prior-spatial.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| `(\w+_\S+)` \|((?: [\d.+-]+ \|){4})$", PAGE, re.M)
OURS = "road-prior-smoother-spatial"
BESIDE = re.findall(r"\| `([\w-]+)`", re.findall(r"^\| run \|.*$", PAGE, re.M)[0])


def test_every_run_has_its_row_and_every_pipeline_is_in_the_command() -> None:
    assert [run for run, _ in ROWS] == [run for name, run in CELLS if name == OURS]
    told = re.findall(r"`conformance table ([^`]*)`", PAGE)[0].split()
    assert {name for name, _ in CELLS} == set(told[1::2][:3]) == {OURS, *BESIDE}


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_figures_are_the_tables(row: tuple[str, str]) -> None:
    run, figures = row
    cell = CELLS[OURS, run]
    expected = [f"{cell['cross_correlation']:.3f}", f"{cell['iri_error_percent']:+.1f}"]
    expected += [f"{CELLS[name, run]['cross_correlation']:.3f}" for name in BESIDE]
    assert [figure.strip() for figure in figures.strip("| ").split("|")] == expected


def test_it_is_adequate_on_every_run() -> None:
    ours = [cell for (name, _), cell in CELLS.items() if name == OURS]
    assert min(cell["cross_correlation"] for cell in ours) >= 0.96
    assert max(abs(cell["iri_error_percent"]) for cell in ours) <= 3.0
