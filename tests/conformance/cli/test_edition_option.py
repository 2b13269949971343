"""`--edition`: whose checks are run, listed, explained and exported, and what names it."""

import json
import shlex
import xml.etree.ElementTree as ElementTree

import pytest
from click.testing import CliRunner
from tests.conformance.page_reader import Page

from floatref_conformance import EDITION, EDITIONS, exporting, golden
from floatref_conformance.cli import explain, export, replay, run, selftest
from floatref_conformance.cli import list as listing
from floatref_conformance.cli.main import main

FIRST, SECOND = EDITIONS
COMMANDS = ("run", "list", "explain", "export", "selftest")


@pytest.fixture
def asked(monkeypatch, registry):
    """Return the editions whose checks commands have asked for."""
    found = []

    def load(edition):
        found.append(edition)
        return registry

    for module in (explain, export, listing, replay, run, selftest):
        monkeypatch.setattr(module, "load_registry", load)
    return found


def call(*words):
    return CliRunner().invoke(main, [*map(str, words)])


def words_of(command, folder):
    return {
        "run": ["--device", "fake:good", "--check", "toy"],
        "explain": ["toy"],
        "export": ["--out", folder / "out"],
        "selftest": ["--check", "toy", "--seeds", 0, "--false-alarms", 0, "--no-limits"],
    }.get(command, [])


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(("options", "edition"), [((), EDITION), (("--edition", FIRST), FIRST)])
def test_a_command_takes_the_checks_of_the_edition_else_of_the_last(
    asked, monkeypatch, tmp_path, command, options, edition
):
    monkeypatch.setattr(golden, "copy_to", lambda folder: None)
    monkeypatch.setattr(exporting, "export", lambda *_: 3)
    answer = call(command, *words_of(command, tmp_path), *options)
    assert answer.exit_code in (0, 1, 4), answer.output
    assert set(asked) == {edition}


@pytest.mark.parametrize("command", COMMANDS)
def test_an_unknown_edition_is_exit_2_and_the_known_ones_are_named(asked, tmp_path, command):
    answer = call(command, *words_of(command, tmp_path), "--edition", "2025.9")
    assert answer.exit_code == 2
    assert "'2025.9' is not one of '2026.1', '2026.2'" in answer.stderr
    assert "Traceback" not in answer.output
    assert asked == []


@pytest.mark.slow
@pytest.mark.parametrize(("run_by", "kept_of"), [(FIRST, SECOND), (SECOND, FIRST)])
def test_a_run_skips_kept_cases_of_the_other_edition_and_has_no_verdict(
    run_toy, keep, devices, tmp_path, run_by, kept_of
):
    keep(tmp_path, edition=kept_of, seed=77)
    answer = run_toy("good", "--report", tmp_path, "--edition", run_by)
    assert answer.exit_code == 4
    report = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    (replayed,) = report["replayed"]
    assert replayed["outcome"] == "skip"
    assert f"is of edition '{kept_of}'" in replayed["reason"]
    assert f"something else in {run_by}" in replayed["reason"]
    assert report["edition"] == run_by
    keep(tmp_path, edition=run_by, seed=77)
    assert run_toy("good", "--report", tmp_path, "--edition", run_by).exit_code == 4
    report = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert [one["outcome"] for one in report["replayed"]] == ["pass"]


@pytest.mark.parametrize(("edition", "code"), [(FIRST, 1), (SECOND, 0)])
def test_a_kept_case_is_judged_by_the_rules_of_its_edition(
    asked, keep, devices, tmp_path, edition, code
):
    # A profile that ends 0.25 m early is an error in the first edition alone.
    devices["good"].spoil = lambda tracks: {t: z[:-5] for t, z in tracks.items()}
    path = keep(tmp_path, edition=edition)
    answer = call("replay", path, "--device", "fake:good")
    assert answer.exit_code == code, answer.output
    assert asked == [edition]


@pytest.mark.parametrize("edition", EDITIONS)
def test_what_a_run_keeps_names_the_edition_and_replays_by_it(run_toy, call, tmp_path, edition):
    run_toy("bad", "--report", tmp_path, "--edition", edition)
    (path,) = (tmp_path / "cases").iterdir()
    assert json.loads(path.read_text(encoding="utf-8"))["edition"] == edition
    assert call("replay", path, "--device", "fake:bad").exit_code == 1


@pytest.mark.parametrize("edition", EDITIONS)
def test_reports_name_the_edition_and_their_commands_one_that_is_not_the_default(
    run_toy, tmp_path, edition
):
    answer = run_toy("bad", "--report", tmp_path, "--edition", edition)
    command = shlex.split(answer.stdout.splitlines()[-1].partition("Reproduce with: ")[2])
    named = ["--edition", edition] if edition != EDITION else []
    assert command[command.index("--seed") + 2 :][: len(named) + 1] == [*named, "--check"]
    assert json.loads((tmp_path / "report.json").read_text())["edition"] == edition
    text = (tmp_path / "junit.xml").read_text(encoding="utf-8")
    suites = ElementTree.fromstring(text)
    other = next(name for name in EDITIONS if name != edition)
    assert f"floatref conformance {edition}" in text
    names = {case.get("classname").rpartition(".")[2] for case in suites.iter("testcase")}
    assert names == {edition.replace(".", "_")}
    page = Page((tmp_path / "report.html").read_text(encoding="utf-8")).text
    assert f"Edition {edition}" in page
    assert f"edition {edition}," in page
    for shown in (text, page):
        assert ("--edition" in shown) is bool(named)
        assert other not in shown


@pytest.mark.parametrize("edition", EDITIONS)
def test_the_list_names_the_edition(asked, edition):
    answer = call("list", "--json", "--edition", edition)
    assert json.loads(answer.stdout)["edition"] == edition


def test_the_command_after_an_export_names_an_edition_that_is_not_the_default(
    asked, monkeypatch, tmp_path
):
    monkeypatch.setattr(golden, "copy_to", lambda folder: None)
    monkeypatch.setattr(exporting, "export", lambda *_: 3)
    for edition, named in ((FIRST, True), (SECOND, False)):
        answer = call("export", "--out", tmp_path / edition, "--edition", edition)
        command = shlex.split(answer.stdout.splitlines()[-1].partition("after processing: ")[2])
        assert command[:3] == ["conformance", "run", "--device"]
        assert (f"--edition {edition}" in " ".join(command)) is named


@pytest.mark.parametrize(("edition", "slip"), [(FIRST, "up to 3 %"), (SECOND, "up to 12 %")])
def test_explain_has_the_words_of_the_edition(edition, slip):
    answer = call("explain", "distance", "--edition", edition)
    assert answer.exit_code == 0
    assert f"slips by {slip} per g" in " ".join(answer.stdout.split())
