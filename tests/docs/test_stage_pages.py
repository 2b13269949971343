"""Each page of a stage says where it is: in Python, in C, and in which pipeline; and that is so."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

import floatref
from floatref.cli.main import main

DOCS = Path(__file__).parents[2] / "docs"
HEADER = (floatref.c_sources() / "floatref.h").read_text(encoding="utf-8")
LINE = re.compile(r"^\*Python: (.*)\. C: (.*)\. Pipeline: (.*)\.\*$", re.M)
ROW = re.compile(r"^\| \[(`\w+`)\]\[.*?\] \|.*\| ([^|]*) \| ([^|]*) \|$", re.M)
PAGES = {
    page.stem: LINE.findall(page.read_text(encoding="utf-8"))
    for page in sorted(DOCS.glob("*.md"))
    if LINE.search(page.read_text(encoding="utf-8"))
}
ALONE = ROW.findall((DOCS / "stages-alone.md").read_text(encoding="utf-8"))
NOTHING = "–"


def names(cell):
    """Return the names of one cell."""
    return re.findall(r"`(\S+?)`", cell)


@pytest.fixture(scope="module")
def pipelines():
    found = CliRunner().invoke(main, ["pipelines", "--json"])
    return {each["name"] for each in json.loads(found.output)["pipelines"]}


def assert_there(python, c, pipeline, pipelines):
    assert all(name in floatref.__all__ for name in names(python))
    assert all(re.search(rf"\b{name}(_push)?\w*\(", HEADER) for name in names(c))
    assert set(names(pipeline)) <= pipelines
    assert names(pipeline) or pipeline.startswith("every one")
    for cell in (python, c):
        assert names(cell) or cell == NOTHING


@pytest.mark.parametrize("page", PAGES)
def test_a_stage_is_where_its_page_says(page, pipelines):
    (where,) = PAGES[page]
    assert_there(*where, pipelines)


def test_the_stages_alone_are_where_their_table_says(pipelines):
    assert len(ALONE) == 9
    for row in ALONE:
        assert_there(*row, pipelines)


def test_every_pipeline_beyond_print_is_on_a_page(pipelines):
    lines = [cell for found in PAGES.values() for *_, cell in found]
    beyond = {name for name in pipelines if re.match("kalman|road-prior|response|.*matched", name)}
    assert beyond <= {name for line in lines for name in names(line)}


def test_a_stage_that_is_in_c_is_so_on_its_page():
    """An object or a call that has the name of a page is named there."""
    for page, found in PAGES.items():
        name = f"fr_{page.replace('-', '_')}"
        if re.search(rf"\b{name}\w*\(", HEADER):
            assert any(each.startswith(name) for each in names(found[0][1])), page
