"""`conformance certify` as a user calls it: exit codes, options, and the report folder."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

from floatref.files import read_profile, write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify import certifying
from floatref_conformance.cli.main import main
from floatref_conformance.proving_ground.roads.random_roads import sayers_road

INTERVAL_M = 0.05
OPTIONS = {
    "--runs": ("runs", "3", 3),
    "--min-repeatability": ("repeatability", "0.5", 0.5),
    "--min-accuracy": ("accuracy", "0.6", 0.6),
    "--max-distance-error": ("distance_percent", "0.3", 0.3),
    "--max-height-error": ("height_percent", "none", None),
    "--max-iri-bias": ("iri_bias_percent", "4", 4.0),
    "--max-long-wave-error": ("long_wave_percent", "8", 8.0),
    "--max-quiescent": ("quiescent_m_per_km", "0.1", 0.1),
    "--max-bounce": ("bounce_m_per_km", "0.2", 0.2),
}
RUN = "--reference-is-run"
LOOSE = ("--runs", 2, "--max-distance-error", "none", "--max-height-error", "none")


def certify(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["certify", *map(str, arguments)])


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A reference of 150 m, two good runs, one of another road, and one at rest."""
    place = tmp_path_factory.mktemp("certify")
    points = 40.0 + INTERVAL_M * np.arange(3001)
    draw = np.random.default_rng(3)
    for name, seed, noise in (
        ("reference", 1, 0.0),
        ("runs/run-1", 1, 2e-5),
        ("runs/run-2", 1, 2e-5),
        ("other", 2, 0.0),
        ("rest", 1, 1.0),
    ):
        road = sayers_road("normal", 250.0, seed=seed)
        gain = 1e-6 if name == "rest" else 1.0
        tracks = [
            ProfileTrack.of(
                t, gain * road.at(t, points) + gain * noise * draw.normal(size=points.size)
            )
            for t in road.tracks
        ]
        (place / name).parent.mkdir(exist_ok=True)
        write_profile(Profile(INTERVAL_M, tuple(tracks)), place / name)
    return place


@pytest.fixture
def call(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Result]:
    """Return a function that calls the command from that folder, without distance or height."""
    monkeypatch.chdir(folder)
    return lambda *words: certify("--reference", "reference", *LOOSE, *words)


def document(result: Result) -> dict[str, Any]:
    return dict(json.loads(result.stdout))


@pytest.mark.slow
def test_pass_is_exit_0(call: Callable[..., Result]) -> None:
    result = call("runs")
    assert result.exit_code == 0, result.output
    assert "PASS" in result.stdout
    assert result.stderr == ""


@pytest.mark.slow
def test_fail_is_exit_1(call: Callable[..., Result]) -> None:
    result = call("runs", "--min-accuracy", 1.0)
    assert result.exit_code == 1
    assert "FAIL" in result.stdout


@pytest.mark.slow
def test_incomplete_is_exit_4(call: Callable[..., Result]) -> None:
    result = call("runs", "--runs", 3)
    assert result.exit_code == 4
    assert "INCOMPLETE" in result.stdout


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--reference", "reference"], "no RUN given"),
        (["runs"], "no --reference given"),
        (["runs", "--reference", "nowhere"], "nowhere: not found"),
        (["runs/run-9*", "--reference", "reference"], "no file matches this pattern"),
        (["runs", "reference", "--reference", "reference"], "is the reference itself"),
        (["runs", "--reference", "reference", "--plan", "plan.toml"], "--plan: names runs"),
        (["--plan", "nowhere.toml"], "nowhere.toml"),
        (["runs", "--reference", "reference", "--section", "a"], "--section a: expected FROM:TO"),
        (["runs", "--reference", "reference", "--section", "9:2"], "from 9 to 2 m is no stretch"),
        (["runs", "--reference", "reference", "--section", "0:2000"], "section 0 to 2000 m"),
        (
            ["runs", "--reference", "reference", *("--section", "0:90:a", "--section", "9:99:a")],
            "two are called a",
        ),
        (["runs", "--reference", "reference", "--min-accuracy", "1.1"], "no number from 0 to 1"),
        (["runs", "--reference", "reference", "--min-accuracy", "nan"], "no number from 0 to 1"),
        (["runs", "--reference", "reference", "--min-accuracy", "none"], "no number from 0 to 1"),
        (["runs", "--reference", "reference", "--max-iri-bias", "x"], "or none"),
        (["runs", "--reference", "reference", "--runs", "0"], "--runs"),
        (["runs", "--reference", "reference", "--class", "best"], "--class"),
        (["runs", "--reference", "reference", "--pipeline", "best"], "pipeline best: unknown"),
        (["runs", "--reference", "reference", "--bounce", "gone@1:2"], "gone: not found"),
        (["runs", "--reference", "reference", "--bounce", "rest@5:2"], "--bounce rest@5:2: from"),
        (["runs", "--reference", "reference", "--report", "plan.toml"], "is not a folder"),
        (["runs", "--reference", "reference", "--report", "runs"], "holds other files"),
        (["empty", "--reference", "reference"], "empty: holds no run"),
        (["bad", "--reference", "reference"], "the only run cannot be used"),
    ],
)
def test_wrong_usage_is_one_line_and_exit_2(
    folder: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], said: str
) -> None:
    monkeypatch.chdir(folder)
    (folder / "plan.toml").write_text("")
    (folder / "empty").mkdir(exist_ok=True)
    (folder / "bad").mkdir(exist_ok=True)
    (folder / "bad" / "profile.json").write_text("{")
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    result = certify(*words)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stderr.strip().count("\n") == 0
    assert result.stdout == ""
    assert {path: path.stat().st_mtime_ns for path in folder.rglob("*")} == before


def test_a_fault_of_the_suite_is_exit_3(
    call: Callable[..., Result], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def failing(*args: object) -> None:
        raise ZeroDivisionError("out of luck")

    monkeypatch.setattr(certifying, "section_sheet", failing)
    result = call("runs", "--report", tmp_path / "report")
    assert result.exit_code == 3
    assert "no worksheet" in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize("option", OPTIONS)
def test_every_limit_is_an_option(folder: Path, option: str) -> None:
    name, given, expected = OPTIONS[option]
    places = ("--reference", folder / "reference", "--json")
    limits = document(certify(folder / "runs", *places))["limits"]
    changed = document(certify(folder / "runs", *places, option, given))["limits"]
    assert limits[name] != expected
    assert changed == {**limits, name: expected}


@pytest.mark.slow
def test_a_class_brings_its_limits(call: Callable[..., Result]) -> None:
    sheet = document(call("runs", "--class", "reference", "--json"))
    assert sheet["class"] == "reference"
    assert (sheet["limits"]["repeatability"], sheet["limits"]["iri_bias_percent"]) == (0.98, 2.0)
    assert sheet["limits"]["distance_percent"] is None


@pytest.mark.slow
def test_sections_have_their_names_and_stretches(call: Callable[..., Result]) -> None:
    sheet = document(call("runs", "--section", "10:100:first", "--section", "50:140", "--json"))
    found = [(s["name"], s["start_m"], s["end_m"]) for s in sheet["sections"]]
    assert [name for name, _, _ in found] == ["first", "50 to 140 m"]
    assert [(start, end) for _, start, end in found] == [
        pytest.approx((10.0, 100.0)),
        pytest.approx((50.0, 140.0)),
    ]


@pytest.mark.slow
def test_tests_at_rest(call: Callable[..., Result], folder: Path) -> None:
    sheet = document(call("runs", "--quiescent", "rest", "--bounce", "other@20:140", "--json"))
    assert [test["id"] for test in sheet["stationary"]] == ["quiescent", "bounce"]
    assert sheet["stationary"][1]["start_m"] == pytest.approx(20.0)
    assert sheet["verdict"] == "FAIL"
    shutil.copytree(folder / "rest", folder / "rest@1:2", dirs_exist_ok=True)
    named = document(call("runs", "--quiescent", "rest@1:2", "--json"))
    assert named["stationary"][0]["source"].endswith("rest@1:2")


@pytest.mark.slow
def test_a_plan_says_it_all(folder: Path) -> None:
    (folder / "whole.toml").write_text(
        'profiler = "Van 3"\n[[sections]]\nname = "road"\nreference = "reference"\n'
        'runs = ["runs/*"]\nfrom_m = 10\nto_m = 140\n'
        '[quiescent]\nsource = "rest"\nfrom_m = 20\nto_m = 140\n'
    )
    result = certify("--plan", folder / "whole.toml", *LOOSE, "--json")
    sheet = document(result)
    assert result.exit_code == 0, result.output
    assert sheet["profiler"] == "Van 3"
    assert [run["name"] for run in sheet["sections"][0]["runs"]] == ["run-1", "run-2"]
    assert sheet["stationary"][0]["id"] == "quiescent"


@pytest.mark.slow
def test_a_report_holds_worksheet_and_profiles(
    call: Callable[..., Result], folder: Path, tmp_path: Path
) -> None:
    report = tmp_path / "report"
    result = call("runs", "--report", report, "--json")
    assert result.exit_code == 0, result.output
    assert json.loads((report / "worksheet.json").read_text("utf-8")) == document(result)
    assert "<html" in (report / "worksheet.html").read_text("utf-8")
    kept = read_profile(report / "runs" / "reference" / "run-1")
    given = read_profile(folder / "runs" / "run-1")
    assert np.array_equal(kept.track("left").elevation, given.track("left").elevation)
    assert (report / "reference" / "reference" / "profile.json").is_file()
    again = call("runs", "--report", report, "--json")
    assert document(again) == document(result)
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


@pytest.mark.slow
def test_a_run_of_another_road_is_named(call: Callable[..., Result]) -> None:
    sheet = document(call("runs", "other", "--json"))
    assert sheet["verdict"] == "FAIL"
    runs = {run["name"]: run for run in sheet["sections"][0]["runs"]}
    assert any("not on this road" in line for line in runs["other"]["said"])


@pytest.mark.slow
def test_practice_and_a_reference_that_is_a_run_are_said(
    call: Callable[..., Result], tmp_path: Path
) -> None:
    plain = document(call("runs", "--json"))
    assert plain["practice"]["name"] == "aashto-r56-14"
    assert set(plain["practice"]["changed"]) == {"runs", "distance_percent", "height_percent"}
    result = call("runs", "--practice", "tex-1001-s", RUN, "--report", tmp_path / "r", "--json")
    assert result.exit_code == 4, result.output
    other = document(result)
    assert "iri_spread_m_per_km" in other["practice"]["not_judged"]
    judged = {one["id"]: one["judged"] for one in other["sections"][0]["criteria"]}
    assert (judged["interval"], judged["accuracy"]) == ("pass", "reported")
    assert other["practice"]["sha256"] in (tmp_path / "r" / "worksheet.html").read_text("utf-8")
    said = [sheet["sections"][0]["reference_said"] for sheet in (plain, other)]
    assert (said[0], "another run, no truth" in said[1][0]) == ([], True)
