"""What the page on the constants of the road prior says, held to the figures that were measured."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from floatref.builtin_pipelines.road_prior import CONSTANTS, EXPECTED, ROAD_PRIOR

DOCS = Path(__file__).parents[2] / "docs"
DATA = Path(__file__).parent / "data" / "road-prior-sensitivity.json"
USUAL, *CHANGED = json.loads(DATA.read_text(encoding="utf-8"))
PAGE = (DOCS / "road-prior-sensitivity.md").read_text(encoding="utf-8")
ROWS = [
    tuple(cell.strip() for cell in line.strip("|").split("|"))
    for line in re.findall(r"^\|.+\|$", PAGE, re.M)[2:]
]
SWAY = {"road_reading_sigma_m", "edge_sigmas"}
ALONG = "acceleration_walk_along"


def test_every_constant_has_two_rows_of_values_about_its_default() -> None:
    defaults = ROAD_PRIOR[0].settings
    # What is vouched for changes no elevation, and nothing is expected of the vehicle.
    for name in CONSTANTS.keys() - {"most_sigma_share", *EXPECTED}:
        smaller, larger = (each for each in CHANGED if each["constant"] == name)
        assert smaller["factor"] < 1.0 < larger["factor"]
        for each in (smaller, larger):
            assert each["value"] == pytest.approx(each["factor"] * defaults[name])


@pytest.mark.parametrize(("row", "measured"), list(zip(ROWS, (USUAL, *CHANGED), strict=True)))
def test_figures_are_those_measured(row: tuple[str, ...], measured: dict[str, Any]) -> None:
    name, value, lowest, median, loss, of, iri, within, fewest = row
    assert name.strip("`") == measured["constant"]
    if measured is not USUAL:
        assert float(value.split()[0]) == pytest.approx(measured["value"], rel=5e-3)
    for cell, figure in ((lowest, "lowest"), (median, "median"), (loss, "largest_loss")):
        assert float(cell) == pytest.approx(max(measured[figure], 0.0), abs=6e-4)
    assert of in ("", measured["of"])
    figures = [measured[f"{each}_percent"] for each in ("iri_error", "within", "fewest")]
    assert [float(cell) for cell in (iri, within, fewest)] == pytest.approx(figures, abs=0.051)


@pytest.mark.parametrize(
    "measured", CHANGED, ids=lambda measured: f"{measured['constant']}-{measured['factor']}"
)
def test_the_largest_loss_is_that_of_the_cases(measured: dict[str, Any]) -> None:
    losses = {name: USUAL["cases"][name] - own for name, own in measured["cases"].items()}
    assert measured["largest_loss"] == pytest.approx(max(losses.values()), abs=2e-4)
    assert measured["largest_loss"] == pytest.approx(losses[measured["of"]], abs=2e-4)


def worst(measured: dict[str, Any]) -> float:
    """Return the largest loss of a row."""
    return float(measured["largest_loss"])


def test_what_matters_is_what_the_page_says() -> None:
    assert {each["constant"] for each in CHANGED if worst(each) > 0.03} == SWAY
    most = max(CHANGED, key=worst)
    assert (most["constant"], most["of"]) == ("edge_sigmas", "edge, 5 mm")
    sway = [each for each in CHANGED if each["constant"] in SWAY]
    assert {e["of"] for e in sway if e["factor"] > 1.0} == {"edge, 5 mm"}
    along = {e["factor"] < 1.0: e for e in CHANGED if e["constant"] == ALONG}
    assert {smaller: e["of"] for smaller, e in along.items()} == {
        True: "soft-van, 0.3 g",
        False: "pickup, 0.26 g",
    }
    others = [each for each in CHANGED if each["constant"] not in {ALONG, *SWAY}]
    assert max(map(worst, others)) <= 0.02 < max(map(worst, along.values())) < 0.025
    assert min(each["median"] for each in CHANGED) >= 0.9855


def test_two_matter_in_one_place_alone() -> None:
    for each in CHANGED:
        if each["constant"] == "height_noise_m":
            assert each["cases"] == USUAL["cases"]
        if each["constant"] == "missing_acceleration_density":
            changed = [n for n, own in each["cases"].items() if own != USUAL["cases"][n]]
            assert changed == ["no acceleration, 0.5 s"]


def test_the_band_is_too_narrow_in_one_case() -> None:
    assert {each["fewest_of"] for each in (USUAL, *CHANGED)} == {"soft-van, 0.3 g"}
    reach = {e["factor"]: e["fewest_percent"] for e in CHANGED if e["constant"] == "road_reach_m"}
    assert max(reach.values()) == reach[3.0] > USUAL["fewest_percent"]
