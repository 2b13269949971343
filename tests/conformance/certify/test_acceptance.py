"""Simulated runs by a device of each class: the numbers of compare, and the causes of failure."""

import json
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from floatref.cli.main import main as floatref_command
from floatref.files import write_profile
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.interface import Taken
from floatref_conformance.classes import DeviceClass
from floatref_conformance.cli.main import main as conformance_command
from floatref_conformance.devices.builtin import process_quietly
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

pytestmark = pytest.mark.slow
PERFECT = "without error"
DEVICES = {
    DeviceClass.NOMINAL: "road-prior-smoother",
    DeviceClass.ADEQUATE: "kalman-smoother-reflection",
    DeviceClass.REFERENCE: PERFECT,
}
"""No pipeline claims class reference."""
SPEEDS_KMH = (56.0, 72.0, 88.0)
SECTION = "70:230:A1"

Drive = Callable[..., Taken]


@pytest.fixture(scope="module")
def taken() -> list[Taken]:
    """Return three drives over one road with errors of their own, and one of a bad encoder."""
    good = [_drive(number) for number in range(len(SPEEDS_KMH))]
    return [*good, _drive(1, encoder_error_percent=1.0)]


@pytest.fixture(scope="module", params=DEVICES, ids=str)
def written(
    request: pytest.FixtureRequest, taken: list[Taken], tmp_path_factory: pytest.TempPathFactory
) -> tuple[DeviceClass, Path]:
    """Return a class, and a folder of what its device makes of every drive, with the truth."""
    device, folder = DEVICES[request.param], tmp_path_factory.mktemp("runs")
    write_profile(taken[0].truth, folder / "truth")
    found = [_measured(device, one) for one in taken]
    for number, profile in enumerate(found[:-1]):
        write_profile(profile, folder / f"run-{number}")
    write_profile(found[-1], folder / "long")
    write_profile(_higher(found[1]), folder / "high")
    return request.param, folder


def _drive(number: int, encoder_error_percent: float = 0.0) -> Taken:
    scenario = Scenario(
        seed=number,
        road_seed=5,
        speed_kmh=SPEEDS_KMH[number],
        length_m=300.0,
        response=False,
        laser_ahead_m=0.0,
        encoder_error_percent=encoder_error_percent,
    )
    made = simulate(scenario)
    return Taken(made.recording, made.truth, scenario)


def _measured(device: str, one: Taken) -> Profile:
    return make_perfect(one) if device == PERFECT else process_quietly(one.recording, device)


def _higher(profile: Profile) -> Profile:
    tracks = (ProfileTrack.of(t.name, 1.03 * t.elevation, t.valid) for t in profile.tracks)
    return replace(profile, tracks=tuple(tracks))


def certified(folder: Path, *names: str, report: Path) -> tuple[int, Any]:
    """Return the exit code and the section of the worksheet of the runs called ``names``."""
    words = ["certify", *(str(folder / name) for name in names), "--report", str(report)]
    words += ["--reference", str(folder / "truth"), "--section", SECTION, "--runs", "3"]
    done = CliRunner().invoke(conformance_command, words)
    assert done.exit_code in (0, 1, 4), done.output
    return done.exit_code, json.loads((report / "worksheet.json").read_text())["sections"][0]


def correlations(reference: Path, profile: Path) -> dict[str, float]:
    """Return what `floatref compare` prints, by wheel path."""
    done = CliRunner().invoke(floatref_command, ["compare", str(reference), str(profile), "--json"])
    return {t["name"]: t["cross_correlation"] for t in json.loads(done.stdout)["tracks"]}


def test_every_correlation_is_that_of_compare(
    written: tuple[DeviceClass, Path], tmp_path: Path
) -> None:
    _, folder = written
    names = [f"run-{n}" for n in range(len(SPEEDS_KMH))]
    _, section = certified(folder, *names, report=tmp_path / "report")
    runs = [tmp_path / "report" / "runs" / "A1" / name for name in names]
    for sheet, run in zip(section["runs"], runs, strict=True):
        found = {track["track"]: track["accuracy"] for track in sheet["tracks"]}
        assert found == correlations(tmp_path / "report" / "reference" / "A1", run)
        assert min(found.values()) > 0.98
    for i, j in combinations(range(len(runs)), 2):
        pair = {name: rows[i][j] for name, rows in section["pairs"].items()}
        assert pair == correlations(runs[i], runs[j])


def test_a_good_device_passes(written: tuple[DeviceClass, Path], tmp_path: Path) -> None:
    _, folder = written
    code, section = certified(folder, "run-0", "run-1", "run-2", report=tmp_path / "report")
    assert code == 0, [c for c in section["criteria"] if c["judged"] in ("fail", "missing")]
    assert not any(track["causes"] for run in section["runs"] for track in run["tracks"])


@pytest.mark.parametrize(
    ("bad", "cause", "criterion", "percent"),
    [("long", "distance", "distance", 1.0), ("high", "height-scale", "height-scale", 3.0)],
)
def test_the_cause_of_failure_is_named(
    written: tuple[DeviceClass, Path],
    tmp_path: Path,
    bad: str,
    cause: str,
    criterion: str,
    percent: float,
) -> None:
    _, folder = written
    code, section = certified(folder, "run-0", "run-2", bad, report=tmp_path / "report")
    assert code == 1
    named = {
        run["name"]: {c["id"] for track in run["tracks"] for c in track["causes"]}
        for run in section["runs"]
    }
    assert named == {"run-0": set(), "run-2": set(), bad: {cause}}
    failed = [c for c in section["criteria"] if c["judged"] == "fail" and c["id"] == criterion]
    assert failed
    assert all(bad in one["reason"] for one in failed)
    assert [c["value"] for c in failed] == pytest.approx([percent] * len(failed), abs=0.2)
