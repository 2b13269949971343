"""The page on certification: limits, causes, units, files and exit codes are those of the code."""

import re
import tomllib
from pathlib import Path

import click

from floatref.files.schema import enforce_schema
from floatref.measures.locating.placing import MAX_OFFSET_M
from floatref.measures.locating.profile_units import DISTANCE_UNITS, HEIGHT_UNITS
from floatref_conformance.certify.fitting.fit import LONGEST_M, SHORTEST_M, WINDOW_M
from floatref_conformance.certify.judging import causes
from floatref_conformance.certify.judging.criteria import MISSING_PERCENT
from floatref_conformance.certify.judging.limits import limits_of
from floatref_conformance.certify.worksheet import keeping
from floatref_conformance.checks.stretches import END_M
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.main import main
from floatref_conformance.schemas import read_schema

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "certify.md").read_text(encoding="utf-8")
TEXT = " ".join(PAGE.split())


def _rows(first: str) -> dict[str, list[str]]:
    """Return the cells of the table whose head begins with ``first``, by the first word in code."""
    table = PAGE[PAGE.index(f"| {first} |") :].split("\n\n")[0]
    rows = [line.strip("| ").split(" | ") for line in table.splitlines()[2:]]
    return {row[0].strip("`"): row[1:] for row in rows}


def test_limits_are_those_of_the_classes() -> None:
    names = {
        "runs": "runs",
        "repeatability": "repeatability",
        "accuracy": "accuracy",
        "iri-bias": "iri_bias_percent",
        "distance": "distance_percent",
        "distance-readings": "distance_percent",
        "height-scale": "height_percent",
        "height-scale-mean": "height_percent",
        "long-waves": "long_wave_percent",
        "quiescent": "quiescent_m_per_km",
        "bounce": "bounce_m_per_km",
    }
    rows = _rows("criterion")
    assert rows.keys() == {*names, "coverage"}
    for id_, field in names.items():
        for cell, device_class in zip(rows[id_][1:4], DeviceClass, strict=True):
            limit = getattr(limits_of(device_class), field)
            shown = None if cell == "reported" else float(cell.split()[0])
            assert shown == limit, (id_, device_class)
    assert set(rows["coverage"][1:4]) == {f"{MISSING_PERCENT:g} %"}


def test_every_cause_has_its_row() -> None:
    ids = next(line for line in causes.causes.__doc__.splitlines() if "Ids are" in line)
    after = causes.causes.__doc__[causes.causes.__doc__.index(ids) :].split(".")[0]
    named = re.findall(r"[a-z]+(?:-[a-z]+)*", after.split("Ids are")[1])
    assert _rows("cause").keys() == set(named) - {"and"}


def test_every_unit_and_every_option_is_named() -> None:
    (distance,) = re.findall(r"has distance in (.+?) \|", TEXT)
    (heights,) = re.findall(r"has elevation in (.+?) \|", TEXT)
    assert distance.split(", ") == [unit for unit in DISTANCE_UNITS if unit != "m"]
    assert heights.split(", ") == [unit for unit in HEIGHT_UNITS if unit != "m"]
    command = main.get_command(click.Context(main), "certify")
    assert command is not None
    options = {option for p in command.params for option in p.opts if option.startswith("--")}
    assert options - {"--help"} <= set(re.findall(r"--[a-z-]+", PAGE)) | {"--quiescent", "--bounce"}


def test_the_plan_that_is_shown_is_one() -> None:
    (text,) = re.findall(r"```toml\n(.+?)```", PAGE, re.S)
    plan = tomllib.loads(text)
    enforce_schema(plan, read_schema("conformance-plan-1"), Path("plan.toml"))
    assert plan.keys() == read_schema("conformance-plan-1")["properties"].keys()


def test_exit_codes_files_and_numbers_are_those_of_the_code() -> None:
    for verdict in Verdict:
        assert f"| {verdict.exit_code} | **{verdict.value}**" in PAGE
    for name in keeping.OURS:
        assert f"`{name}" in PAGE, name
    for text in (
        f"within {MAX_OFFSET_M:g} m of its place",
        f"the last {END_M:g} m do not count",
        f"windows of {WINDOW_M:g} m. In waves from {LONGEST_M:g} m down to {SHORTEST_M:g} m",
    ):
        assert text in TEXT, text


def test_every_picture_is_there() -> None:
    pictures = re.findall(r"!\[.+?\]\((.+?)\)", PAGE)
    assert len(pictures) == 5
    assert all((DOCS / picture).is_file() for picture in pictures)
