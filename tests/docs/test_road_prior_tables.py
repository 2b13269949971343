"""What the pages on the road prior and its variants say of the 17 runs, held to the tables."""

import json
import re
from pathlib import Path

import pytest

from floatref_conformance.proving_ground.drives.runs import RUNS

DOCS, DATA = Path(__file__).parents[2] / "docs", Path(__file__).parent / "data"
PAGES = {
    "road-prior.md": "road-prior-smoother",
    "road-prior-spatial.md": "road-prior-smoother-spatial",
    "road-prior-imu.md": "road-prior-smoother-imu",
}
ROW = re.compile(r"^\| `(\w+_\S+)` \|((?: [\d.+-]+ \|)+)$", re.M)
TABLE = json.loads((DATA / "table.json").read_text(encoding="utf-8"))["cells"]
CELLS = {(cell["pipeline"], cell["run"]): cell for cell in TABLE}


def read(page: str) -> str:
    return (DOCS / page).read_text(encoding="utf-8")


def beside(page: str) -> list[str]:
    """Return the pipelines that have a column of the table besides our own."""
    (head,) = re.findall(r"^\| run \|.*$", read(page), re.M)
    return re.findall(r"\| `([\w-]+)`", head)


@pytest.mark.parametrize(
    ("page", "run", "figures"), [(page, *row) for page in PAGES for row in ROW.findall(read(page))]
)
def test_figures_are_the_tables(page: str, run: str, figures: str) -> None:
    own = CELLS[PAGES[page], run]
    expected = [
        f"{own['cross_correlation']:.3f}",
        f"{own['cross_correlation_encoder']:.3f}",
        f"{own['iri_error_percent']:+.1f}",
    ]
    expected += [f"{CELLS[name, run]['cross_correlation']:.3f}" for name in beside(page)]
    assert [figure.strip() for figure in figures.strip("| ").split("|")] == expected


@pytest.mark.parametrize("page", ["road-prior.md", "road-prior-spatial.md"])
def test_every_run_has_its_row(page: str) -> None:
    runs = [run for name, run in CELLS if name == PAGES[page]]
    assert [run for run, _ in ROW.findall(read(page))] == runs


@pytest.mark.parametrize(
    ("page", "least", "most_percent"),
    [
        ("road-prior.md", 0.98, 2.0),
        ("road-prior-spatial.md", 0.96, 3.0),
        ("road-prior-imu.md", 0.98, 2.0),
    ],
)
def test_it_is_adequate_on_every_run_along_the_encoder(
    page: str, least: float, most_percent: float
) -> None:
    """Slip of the encoder's wheel moves the profile, which no pipeline can know from it."""
    own = [cell for (name, _), cell in CELLS.items() if name == PAGES[page]]
    assert len(own) == 17
    assert min(cell["cross_correlation_encoder"] for cell in own) >= least
    assert max(abs(cell["iri_error_percent"]) for cell in own) <= most_percent


def test_the_lowest_along_the_encoder_is_the_slowest() -> None:
    own = {run: cell for (name, run), cell in CELLS.items() if name == PAGES["road-prior.md"]}
    assert min(own, key=lambda run: own[run]["cross_correlation_encoder"]) == "const_5"


@pytest.mark.parametrize("page", PAGES)
def test_the_range_of_stops_and_brakes_is_in_the_text(page: str) -> None:
    ours, text = PAGES[page], " ".join(read(page).split())
    for kind in ("stop", "braking"):
        own = [c for (n, run), c in CELLS.items() if n == ours and RUNS[run].kind == kind]
        for name in ("cross_correlation", "cross_correlation_encoder"):
            found = [cell[name] for cell in own]
            assert f"{min(found):.3f} to {max(found):.3f}" in text, (kind, name)


def test_every_pipeline_of_triggered_samples_is_in_the_command() -> None:
    page = "road-prior-spatial.md"
    words = re.findall(r"`conformance table ([^`]*)`", read(page))[0].split()
    named = set(words[1::2][:3])
    assert named == {PAGES[page], *beside(page)} <= {name for name, _ in CELLS}
