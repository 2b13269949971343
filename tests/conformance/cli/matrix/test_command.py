"""`conformance matrix` as a command: table, page, JSON, exit codes, and nothing half-written."""

import json
import re

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator
from tests.conformance.matrix.conftest import make_check, stored
from tests.conformance.page_reader import assert_accessible, assert_sound

from floatref_conformance.cli.main import main
from floatref_conformance.schemas import read_schema

__all__ = ["stored"]
HOSTILE = "<script>alert('x')</script>\x1b[31m\u202e{{ 7*7 }}\nPASS"


@pytest.fixture
def call():
    return lambda *words: CliRunner().invoke(main, ["matrix", *map(str, words)])


@pytest.fixture
def three(stored):
    """Two reports that may be compared, and one of another edition without a check."""
    return [
        stored("one", {"stop": 0.5, "bounce": 2.0}),
        stored("two", {"stop": 0.4, "bounce": None}),
        stored("old", {"stop": 0.3}, edition="2026.1"),
    ]


def test_the_table_marks_the_smallest_share_and_names_what_is_empty(call, three):
    ended = call(*three)
    assert ended.exit_code == 0, ended.output
    lines = [" ".join(line.split()) for line in ended.stdout.splitlines()]
    assert "check A: FAIL A: INCOMPLETE B: INCOMPLETE" in lines
    assert "stop pass 50 % pass 40 % * pass 30 %" in lines
    assert "bounce fail 200 % not run" in lines
    assert "two: bounce: not run (not selected)" in lines
    assert "old: bounce: not in it (its report, of edition 2026.1, has no such check)" in lines
    assert any(line.endswith("not compared with A: edition differs") for line in lines)


def test_json_and_page_have_the_same_cells(call, three, tmp_path):
    ended = call(*three, "--json", "-o", tmp_path / "m.html")
    document = json.loads(ended.stdout)
    Draft202012Validator(read_schema("conformance-matrix-1")).validate(document)
    found = assert_sound((tmp_path / "m.html").read_text(encoding="utf-8"))
    assert_accessible(found)
    for check in document["checks"]:
        assert check["id"] in found.text
        for cell in check["cells"]:
            shown = cell["reason"] if cell["share"] is None else f"{100 * cell['share']:.0f} %"
            assert shown in found.text
    assert found.text.count("smallest of group") == 1


def test_texts_of_a_report_are_text(call, stored, tmp_path):
    checks = [
        make_check(HOSTILE, 0.5, outcome="error", reason=HOSTILE),
        make_check("skipped", reason=HOSTILE),
    ]
    checks[0]["shown"] |= {"quantity": HOSTILE, "unit": HOSTILE, "track": HOSTILE, "case": HOSTILE}
    device = dict.fromkeys(("spec", "name", "version"), HOSTILE)
    device |= {"architecture": "temporal", "capabilities": []}
    paths = [stored(name, {}, checks=checks, device=device, edition=HOSTILE) for name in "ab"]
    ended = call(*paths, "-o", tmp_path / "m.html")
    assert ended.exit_code == 0, ended.output
    assert "\x1b" not in ended.stdout
    assert not any(line.strip() == "PASS" for line in ended.stdout.splitlines())
    found = assert_sound((tmp_path / "m.html").read_text(encoding="utf-8"))
    assert "<script>alert('x')</script>" in found.text
    assert "{{ 7*7 }}" in found.text
    assert not re.search("[\x1b\u202e]", found.text)


@pytest.mark.parametrize("words", [(), ("--json",)])
def test_a_file_that_is_no_report_is_one_line_and_leaves_nothing(call, three, tmp_path, words):
    (tmp_path / "cut.json").write_text((three[0] / "report.json").read_text()[:300])
    ended = call(*three, tmp_path / "cut.json", "-o", tmp_path / "m.html", *words)
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert "cut.json: not JSON" in ended.stderr
    assert not (tmp_path / "m.html").exists()


def test_a_page_is_replaced_on_request(call, three, tmp_path):
    page = tmp_path / "m.html"
    page.write_text("mine")
    assert call(*three, "-o", page).exit_code == 2
    assert page.read_text() == "mine"
    assert call(*three, "-o", page, "--overwrite").exit_code == 0
    assert page.read_text().startswith("<!DOCTYPE html>")


@pytest.mark.posix
@pytest.mark.parametrize("name", ["report.json", "link.html", "../one/report.json"])
def test_a_page_never_replaces_a_report_that_it_shows(call, three, name):
    before = (three[0] / "report.json").read_text()
    if name.startswith("link"):
        (three[0] / name).symlink_to("report.json")
    ended = call(*three, "-o", three[0] / name, "--overwrite")
    assert (ended.exit_code, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert "is one of the reports" in ended.stderr
    assert (three[0] / "report.json").read_text() == before


def test_a_pass_above_a_failed_check_is_named_in_each_output(call, stored, tmp_path):
    folder = stored("claim", {"stop": 1.2}, verdict="PASS")
    ended = call(folder, "-o", tmp_path / "m.html")
    said = "it states PASS, its outcomes make it FAIL"
    assert said in " ".join(ended.stdout.split())
    assert said in assert_sound((tmp_path / "m.html").read_text(encoding="utf-8")).text
    (found,) = json.loads(call(folder, "--json").stdout)["reports"]
    assert (found["verdict"], found["outcomes_make"]) == ("PASS", "FAIL")
