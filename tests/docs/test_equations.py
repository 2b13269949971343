"""The page for readers of the dissertation: as generated, complete, and strict about its rows."""

import importlib
import re
import tomllib
from pathlib import Path

import pytest

import floatref

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
ROWS = tomllib.loads((ROOT / ".ci" / "equations.toml").read_text(encoding="utf-8"))
GOOD = {
    "cites": "(2.7)",
    "what": "Moving average",
    "reference": "chapter_2.section_2_1_4_waveband.h_moving_average",
    "used": "floatref.measures.roughness.quarter_car.moving_average_response",
}
BAD = {
    "no reference function given": {"reference": ""},
    "no function given": {"used": []},
    "floatref_reference.chapter_2.lost does not exist": {"reference": "chapter_2.lost"},
    "floatref.measures.lost.f does not exist": {"used": ["floatref.measures.lost.f"]},
    "the docstring of floatref.measures.gaps does not cite it": {"used": "floatref.measures.gaps"},
    "no test that imports floatref_conformance is marked": {
        "used": "floatref_conformance.proving_ground.vehicles.kinematics"
    },
    "no test that imports floatref_reference is marked": {"cites": "(9.9)"},
    "slips.md has no anchor 9-9": {"slip": "9-9"},
}


@pytest.fixture
def generator(monkeypatch):
    """Return the script that writes the page."""
    monkeypatch.syspath_prepend(str(ROOT / ".ci"))
    return importlib.import_module("equations_page")


def test_the_page_is_what_the_script_writes(generator, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["equations_page.py", "--check"])
    assert generator.main() == 0, capsys.readouterr().err


def test_a_page_of_yesterday_fails(generator, monkeypatch, capsys, tmp_path):
    page = tmp_path / "equations.md"
    page.write_text("# Yesterday\n", encoding="utf-8")
    monkeypatch.setattr("sys.argv", ["equations_page.py", "--check", "--page", str(page)])
    assert generator.main() == 1
    assert "is out of date" in capsys.readouterr().err


def test_a_complete_row_is_a_line_with_four_columns(generator):
    text = generator.page({"intro": "", "outro": "", "groups": [{"title": "One", "rows": [GOOD]}]})
    row = next(line for line in text.splitlines() if "(2.7)" in line)
    assert all(cell.strip() for cell in row.strip("|").split("|"))
    assert row.count("|") == 5


def test_a_row_without_what_it_cites_or_a_title_is_refused(generator):
    assert "cites no equation, table or section" in list(generator.faults(GOOD | {"cites": ""}))
    assert "no title given in what" in list(generator.faults(GOOD | {"what": ""}))
    for name in ("cites", "what"):
        row = {key: value for key, value in GOOD.items() if key != name}
        with pytest.raises(generator.IncompleteRowError):
            generator.complete([{"title": "One", "rows": [row]}])


def test_a_function_has_to_cite_it_itself(generator):
    module = "floatref.kernels.state_variable"
    assert "(A.6)" in generator.cited(generator.documentation(f"{module}.high_pass_1"))
    assert "(A.2)" in generator.cited(generator.documentation(module))
    assert "(A.2)" not in generator.cited(generator.documentation(f"{module}.high_pass_21"))


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("as (7) of Zhu has it", {"(7) of Zhu"}),
        ("(2) to (4) of Imine", {"(2) of Imine", "(3) of Imine", "(4) of Imine"}),
        ("(10), (11) and (13) of Zhu", {"(10) of Zhu", "(11) of Zhu", "(13) of Zhu"}),
        ("(7) of Zhu and of Imine", {"(7) of Zhu", "(7) of Imine"}),
        ("steps (a) and (b) of Zhu", {"(a) of Zhu", "(b) of Zhu"}),
        ("section 4.3 of Zhu, Table 1 of Zhu", {"section 4.3 of Zhu", "Table 1 of Zhu"}),
        ("section 4.3, and (7)", {"section 4.3"}),
    ],
)
def test_a_paper_is_cited_by_its_name(generator, text, found):
    assert generator.cited(text) == found


def test_in_the_home_of_a_paper_its_name_is_left_out(generator):
    name = "floatref_reference.zhu_2021.section_4_3_speed.calculation_rate"
    assert generator.paper_of(name) == "Zhu"
    assert generator.paper_of("floatref_reference.zhu_2021s") == ""
    text = generator.documentation(name)
    assert generator.cited(text, "Zhu") == {"section 4.3 of Zhu"}
    assert generator.cited("Step (a): as in (3)", "Imine") == {"(a) of Imine", "(3) of Imine"}


def test_a_file_can_cite_for_all_its_tests(generator):
    names = {test.name for test in generator.tests()["Table 5.12"] if "findings" in test.path}
    path = ROOT / "tests" / "conformance" / "table" / "test_findings.py"
    defined = re.findall(r"^def (test_\w+)", path.read_text(encoding="utf-8"), re.M)
    assert names == set(defined)


@pytest.mark.parametrize("reason", BAD)
def test_a_row_that_lacks_something_fails_in_one_line(generator, reason):
    row = GOOD | BAD[reason]
    with pytest.raises(generator.IncompleteRowError) as caught:
        generator.complete([{"title": "One", "rows": [row]}])
    said = [line for line in str(caught.value).splitlines() if reason in line]
    assert len(said) == 1
    assert said[0].startswith(f"{row['cites']}, Moving average: ")


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"pipeline": "temporal-lost"}, "there is no pipeline temporal-lost"),
        ({"cites": "section 5.4"}, "its summary does not cite section 5.4"),
        ({"table": "Table 5.4"}, "its figures are published in Table 5.3"),
        ({"reference": "chapter_5.lost"}, "floatref_reference.chapter_5.lost does not exist"),
    ],
)
def test_a_pipeline_that_lacks_something_fails(generator, change, reason):
    rows = [row for group in ROWS["groups"] for row in group["rows"]]
    good = next(row for row in rows if row.get("pipeline") == "temporal-basic")
    assert list(generator.pipeline_faults(good)) == []
    assert reason in list(generator.pipeline_faults(good | change))


def test_every_pipeline_is_on_the_page():
    page = (ROOT / "docs" / "equations.md").read_text(encoding="utf-8")
    assert [name for name in floatref.pipelines() if f"`{name}`" not in page] == []


def test_no_row_is_listed_twice_and_every_test_cites_what_is_on_the_page(generator):
    rows = [row for group in ROWS["groups"] for row in group["rows"]]
    listed = [(row["cites"], str(row["reference"])) for row in rows]
    assert len(set(listed)) == len(listed)
    page = generator.cited((ROOT / "docs" / "equations.md").read_text(encoding="utf-8"))
    assert set(generator.tests()) <= page
