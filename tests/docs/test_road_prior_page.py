"""What the page on the road prior says, held to the default table."""

import json
import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
TABLE = json.loads((Path(__file__).parent / "data" / "table.json").read_text(encoding="utf-8"))
CELLS = {(cell["pipeline"], cell["run"]): cell for cell in TABLE["cells"]}
PAGE = (DOCS / "road-prior.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| `(\w+_\S+)` \|((?: [\d.+-]+ \|){5})$", PAGE, re.M)
OURS = "road-prior-smoother"
BESIDE = re.findall(r"\| `([\w-]+)`", re.findall(r"^\| run \|.*$", PAGE, re.M)[0])


def test_every_run_has_its_row() -> None:
    assert [run for run, _ in ROWS] == [run for name, run in CELLS if name == OURS]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_figures_are_the_tables(row: tuple[str, str]) -> None:
    run, figures = row
    cell = CELLS[OURS, run]
    expected = [f"{cell['cross_correlation']:.3f}", f"{cell['iri_error_percent']:+.1f}"]
    expected += [f"{CELLS[name, run]['cross_correlation']:.3f}" for name in BESIDE]
    assert [figure.strip() for figure in figures.strip("| ").split("|")] == expected


def test_it_is_adequate_on_every_run() -> None:
    ours = [cell for (name, _), cell in CELLS.items() if name == OURS]
    assert min(cell["cross_correlation"] for cell in ours) >= 0.98
    assert max(abs(cell["iri_error_percent"]) for cell in ours) <= 2.0


def test_the_lowest_is_the_slowest() -> None:
    lowest = min(
        (cell["cross_correlation"], run) for (name, run), cell in CELLS.items() if name == OURS
    )
    assert lowest[1] == "const_5"
