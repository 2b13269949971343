"""`conformance simulate`: what it writes, what it refuses, in one line."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

from floatref.cli.lazy import LazyGroup
from floatref.files import read_profile, read_recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

TINY = Scenario(seed=5, length_m=20.0, rate_hz=1000.0, tracks=("left",), gnss=False)
COMMAND = {"simulate": ("floatref_conformance.cli.simulate:simulate", "simulate")}


def invoked(*arguments: object) -> Result:
    """Run the sub-command inside the group that turns errors into one line."""
    group = LazyGroup(lazy=COMMAND)
    return CliRunner().invoke(group, ["simulate", *map(str, arguments)])


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.json"
    path.write_text(json.dumps(TINY.to_dict()), encoding="utf-8")
    return path


def test_scenario_file_becomes_a_recording_and_its_truth(case: Path, tmp_path: Path) -> None:
    out, truth = tmp_path / "run", tmp_path / "truth"
    result = invoked(case, "--out", out, "--truth", truth)
    assert result.exit_code == 0, result.output
    expected = simulate(TINY)
    height = read_recording(out).channel("height", "left").values
    assert np.array_equal(height, expected.recording.channel("height", "left").values)
    elevation = read_profile(truth).track("left").elevation
    assert np.array_equal(elevation, expected.truth.track("left").elevation)
    assert not list(out.glob("*profile*"))


def test_seed_replaces_that_of_the_file(case: Path, tmp_path: Path) -> None:
    for name, arguments in (("plain", ()), ("same", ("--seed", 5)), ("other", ("--seed", 6))):
        assert invoked(case, "--out", tmp_path / name, *arguments).exit_code == 0
    read = {
        name: read_recording(tmp_path / name).channel("height", "left").values
        for name in ("plain", "same", "other")
    }
    assert np.array_equal(read["plain"], read["same"])
    assert not np.array_equal(read["plain"], read["other"])


@pytest.mark.slow
def test_reference_pass_by_name(tmp_path: Path) -> None:
    result = invoked("ref_72", "--out", tmp_path / "run")
    assert result.exit_code == 0, result.output
    recording = read_recording(tmp_path / "run")
    assert recording.tracks == ("left", "right")
    assert recording.channel("distance").values[-1] == pytest.approx(500.0, rel=1e-3)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("ref_27", "--out", "new"), "run 'ref_27': unknown; did you mean ref_72?"),
        (("missing.json", "--out", "new"), "missing.json: No such file or directory"),
        (("ref_72", "--out", "case.json"), "case.json: exists; choose another name"),
        (("ref_72", "--out", "no/new"), "no/new: its folder does not exist"),
        (("ref_72", "--out", "new", "--truth", "new"), "is the recording's own folder"),
        (("ref_72", "--out", "new", "--truth", "new/truth"), "its folder does not exist"),
        (("ref_72",), "Missing option '-o' / '--out'"),
        (("ref_72", "--out", "new", "--seed", "-1"), "Invalid value for '--seed'"),
    ],
)
def test_unusable_requests_are_refused_before_any_work(
    case: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], message: str
) -> None:
    monkeypatch.chdir(case.parent)
    result = invoked(*arguments)
    assert result.exit_code == 2
    assert message in result.output
    assert "Traceback" not in result.output
    assert sorted(path.name for path in case.parent.iterdir()) == ["case.json"]


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"manoeuvre": "braking", "event_speed_kmh": 90}, "case.json: manoeuvre braking: cannot"),
        ({"manoeuvre": "dead-start", "final_speed_kmh": 0}, "case.json: manoeuvre dead-start: the"),
        ({"tracks": ["../x"]}, "case.json: tracks has '../x'"),
        ({"tracks": ["a", "b"]}, "case.json: wheel path a: give its lateral position"),
    ],
)
def test_scenario_that_cannot_be_driven_is_refused_in_a_line_naming_its_file(
    case: Path, monkeypatch: pytest.MonkeyPatch, numbers: dict[str, Any], message: str
) -> None:
    monkeypatch.chdir(case.parent)
    case.write_text(json.dumps(numbers), encoding="utf-8")
    result = invoked("case.json", "--out", "new")
    assert result.exit_code == 2
    assert message in result.output
    assert [line for line in result.output.splitlines() if "case.json: " in line] == [
        result.output.splitlines()[-1]
    ]
    assert sorted(path.name for path in case.parent.iterdir()) == ["case.json"]


def test_repeat_passes_have_a_folder_each_and_one_road(case: Path, tmp_path: Path) -> None:
    out, truth = tmp_path / "runs", tmp_path / "truths"
    result = invoked(case, "--out", out, "--truth", truth, "--runs", 3)
    assert result.exit_code == 0, result.output
    names = ["run_001", "run_002", "run_003"]
    assert sorted(p.name for p in out.iterdir()) == sorted(p.name for p in truth.iterdir()) == names
    heights = [read_recording(out / n).channel("height", "left").values for n in names]
    roads = [read_profile(truth / n).track("left").elevation for n in names]
    assert np.array_equal(roads[0], roads[2])
    assert not np.array_equal(heights[0], heights[2])


def test_passes_that_cannot_be_written_leave_nothing(case: Path, tmp_path: Path) -> None:
    document = json.loads(case.read_text()) | {"manoeuvre": "stop", "event_at_m": 5.0}
    case.write_text(json.dumps(document))
    result = invoked(case, "--out", tmp_path / "runs", "--runs", 2)
    assert result.exit_code == 2
    assert not (tmp_path / "runs").exists()
