"""Links that a device under test plants in the folder of a report are not followed."""

import json
from pathlib import Path

import pytest

from floatref.errors import InputError
from floatref.files.atomic import replace_file
from floatref_conformance.case_files import name_of
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.verdict import Outcome
from floatref_conformance.devices.interface import Description
from floatref_conformance.judge.events import RunFinished, RunStarted
from floatref_conformance.plugins import load_registry
from floatref_conformance.render import html, junit, report
from floatref_conformance.render.cases import CaseFiles
from floatref_conformance.render.html import HtmlReport
from floatref_conformance.render.junit import JUnitReport
from floatref_conformance.render.report import JsonReport

WRITERS = {html.NAME: HtmlReport, junit.NAME: JUnitReport, report.NAME: JsonReport}


@pytest.fixture
def valuable(tmp_path: Path) -> Path:
    """A file of the user that a link of the device leads to."""
    (tmp_path / "valuable").write_text("mine", encoding="utf-8")
    return tmp_path / "valuable"


@pytest.mark.posix
@pytest.mark.parametrize("name", WRITERS)
def test_a_report_replaces_a_link_in_its_place(
    tmp_path: Path, valuable: Path, name: str, check, result
) -> None:
    folder, checks = tmp_path / "report", tuple(load_registry().checks.values())
    writer = WRITERS[name].into(folder)
    writer.handle(RunStarted("x", Description("x", "1", "temporal", ()), checks, ()))
    (folder / name).symlink_to(valuable)
    writer.handle(RunFinished(result(check(Outcome.PASS))))
    assert valuable.read_text(encoding="utf-8") == "mine"
    assert not (folder / name).is_symlink()
    assert (folder / name).stat().st_size > 100


@pytest.mark.posix
def test_a_report_is_not_written_through_a_link_beside_it(
    tmp_path: Path, valuable: Path, monkeypatch: pytest.MonkeyPatch, check, result
) -> None:
    """Even if a device could know the name under which it is written at first."""
    monkeypatch.setattr(report, "own_name", lambda: "guessed")
    (tmp_path / "guessed").symlink_to(valuable)
    with pytest.raises(FileExistsError):
        JsonReport.into(tmp_path).handle(RunFinished(result(check(Outcome.PASS))))
    assert valuable.read_text(encoding="utf-8") == "mine"


@pytest.mark.posix
def test_cases_are_not_written_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "report").mkdir()
    (tmp_path / "report" / "cases").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match=r"cases: is a link, .*; remove it"):
        CaseFiles.into(tmp_path / "report")
    assert list((tmp_path / "elsewhere").iterdir()) == []


@pytest.mark.posix
def test_a_case_replaces_a_link_in_its_place(tmp_path: Path, valuable: Path, check, result) -> None:
    writer, failed = CaseFiles.into(tmp_path / "report"), check(Outcome.FAIL)
    name = name_of(Case.of(failed.id, failed.counterexample["parameters"]))
    (tmp_path / "report" / name).symlink_to(valuable)
    writer.handle(RunFinished(result(failed)))
    assert valuable.read_text(encoding="utf-8") == "mine"
    assert not (tmp_path / "report" / name).is_symlink()


@pytest.mark.posix
def test_a_folder_of_cases_that_became_a_link_is_refused(tmp_path: Path, check, result) -> None:
    """A device plants it while it is judged."""
    writer = CaseFiles.into(tmp_path / "report")
    (tmp_path / "report" / "cases").rmdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "report" / "cases").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="cases: is a link"):
        writer.handle(RunFinished(result(check(Outcome.FAIL))))
    assert list((tmp_path / "elsewhere").iterdir()) == []


@pytest.mark.posix
@pytest.mark.parametrize("follow", [True, False])
def test_what_a_user_names_is_followed_and_what_is_planted_not(
    tmp_path: Path, valuable: Path, follow: bool
) -> None:
    (tmp_path / "link").symlink_to(valuable)
    with replace_file(tmp_path / "link", overwrite=True, follow=follow) as beside:
        beside.write_text(json.dumps(follow), encoding="utf-8")
    assert (tmp_path / "link").is_symlink() == follow
    assert valuable.read_text(encoding="utf-8") == ("true" if follow else "mine")
    assert (tmp_path / "link").read_text(encoding="utf-8") == json.dumps(follow)
