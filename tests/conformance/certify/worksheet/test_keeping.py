"""The report folder: every profile that was compared, complete or not at all."""

import os
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.files import read_profile
from floatref.measures import agreement, on_common_grid
from floatref.values.profile import Profile
from floatref_conformance.certify.judging.contents import StationarySheet, Worksheet
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.sections import Run, section_sheet, truth_of
from floatref_conformance.certify.plan.plan_document import SectionPlan
from floatref_conformance.certify.worksheet.keeping import check_report, folders_of, write_report
from floatref_conformance.checks.verdict import Verdict
from floatref_conformance.classes import DeviceClass


@pytest.fixture(scope="module")
def worksheet(reference: Profile, ten_runs: tuple[Profile, ...]) -> Worksheet:
    """Two sections, cut and whole, three runs and one without a profile, and a test at rest."""
    limits = CertificationLimits()
    runs = [Run(f"day/run-{k}", "here", profile=run) for k, run in enumerate(ten_runs[:3])]
    runs.append(Run("lost", "there", error="cannot be read"))
    plans = (
        SectionPlan("a/b", Path("r"), (), (20.0, 150.0)),
        SectionPlan("A:B", Path("r"), ()),
    )
    sections = tuple(section_sheet(plan, truth_of(plan, reference), runs, limits) for plan in plans)
    still = StationarySheet("quiescent", "s", 0.0, 1.0, {}, (), (), ten_runs[0])
    return Worksheet("", DeviceClass.NOMINAL, limits, Verdict.FAIL, sections, (still,))


def page(worksheet: Worksheet, path: Path) -> None:
    path.write_text("page")


def document(worksheet: Worksheet, path: Path) -> None:
    path.write_text("{}")


def written(worksheet: Worksheet, folder: Path) -> set[str]:
    write_report(worksheet, folder, document, page)
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_dir()}


@pytest.mark.slow
def test_every_profile_that_was_compared_is_kept(worksheet: Worksheet, tmp_path: Path) -> None:
    folders = written(worksheet, tmp_path / "report")
    sections = ("a-b", "A-B-2")
    runs = {f"runs/{s}/day-run-{k}" for s in sections for k in range(3)}
    references = {f"reference/{s}" for s in sections}
    assert folders == {
        *runs,
        *references,
        *(f"runs/{s}" for s in sections),
        *("runs", "reference", "stationary", "stationary/quiescent"),
    }
    assert (tmp_path / "report" / "worksheet.json").read_text() == "{}"
    assert (tmp_path / "report" / "worksheet.html").read_text() == "page"
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


def test_what_is_kept_gives_every_number_again(worksheet: Worksheet, tmp_path: Path) -> None:
    written(worksheet, tmp_path / "report")
    for name, sheet in zip(("a-b", "A-B-2"), worksheet.sections, strict=True):
        truth = read_profile(tmp_path / "report" / "reference" / name)
        kept = sorted((tmp_path / "report" / "runs" / name).iterdir())
        used = [run for run in sheet.runs if not run.error]
        for run, place in zip(used, kept, strict=True):
            expected, found = on_common_grid(truth, read_profile(place))
            for track in run.tracks:
                p, q = (x.track(track.track).elevation for x in (expected, found))
                again = agreement(p, q, truth.interval_m, "iri", 1.0)
                assert again.cross_correlation == track.accuracy
                assert again.offset_m == track.offset_m


def test_an_earlier_report_is_replaced_whole(worksheet: Worksheet, tmp_path: Path) -> None:
    written(worksheet, tmp_path / "report")
    fewer = replace(worksheet, sections=worksheet.sections[:1], stationary=())
    folders = written(fewer, tmp_path / "report")
    assert "runs/a-b" in folders
    assert not {"runs/A-B-2", "stationary"} & folders
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError])
def test_a_report_that_fails_leaves_what_was_there(
    worksheet: Worksheet, tmp_path: Path, error: type[BaseException]
) -> None:
    def failing(worksheet: Worksheet, path: Path) -> None:
        raise error

    with pytest.raises(error):
        write_report(worksheet, tmp_path / "report", document, failing)
    assert list(tmp_path.iterdir()) == []
    before = written(worksheet, tmp_path / "report")
    with pytest.raises(error):
        write_report(worksheet, tmp_path / "report", failing, page)
    after = {p.relative_to(tmp_path / "report").as_posix() for p in tmp_path.rglob("*")}
    assert before <= after
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


def test_the_earlier_report_comes_back_where_the_new_one_cannot_take_its_place(
    worksheet: Worksheet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written(worksheet, tmp_path / "report")
    (tmp_path / "report" / "worksheet.html").write_text("earlier")
    renamed = os.rename

    def refusing(old: Path, new: Path) -> None:
        if Path(new).name == "report" and (Path(old) / "worksheet.html").read_text() == "page":
            raise OSError(28, "No space left on device")
        renamed(old, new)

    monkeypatch.setattr(os, "rename", refusing)
    with pytest.raises(InputError, match="No space left"):
        written(worksheet, tmp_path / "report")
    assert (tmp_path / "report" / "worksheet.html").read_text() == "earlier"
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (["thesis.docx"], "holds other files and no worksheet.json"),
        (["worksheet.json", "thesis.docx"], "holds thesis.docx, which is of no report"),
        ([], ""),
        (["worksheet.json", "runs"], ""),
    ],
)
def test_files_of_others_are_never_replaced(tmp_path: Path, names: list[str], said: str) -> None:
    folder = tmp_path / "report"
    folder.mkdir()
    for name in names:
        (folder / name).touch()
    if not said:
        check_report(folder)
        return
    with pytest.raises(InputError, match=said):
        check_report(folder)


def test_a_place_that_can_hold_no_report(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="is not a folder"):
        check_report(tmp_path / "file")
    with pytest.raises(InputError, match="its folder does not exist"):
        check_report(tmp_path / "nowhere" / "report")


@given(st.lists(st.text(max_size=100), max_size=8))
def test_every_name_has_a_folder_of_its_own(names: list[str]) -> None:
    folders = folders_of(names)
    assert len({folder.casefold() for folder in folders}) == len(names)
    for folder in folders:
        assert Path(folder).name == folder
        assert folder.strip(" .") == folder
        assert 0 < len(folder) <= 90
        assert not set(folder) & set('<>:"/\\|?*\0')


def test_names_that_are_folders_already_stay() -> None:
    names = ("run-1", "stop_0.20g", "Straße 3")
    assert folders_of(names) == names
    assert folders_of(["a", "a", "A"]) == ("a", "a-2", "A-3")
