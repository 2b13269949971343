"""`floatref tune`: what it finds, writes, draws, doubts and refuses."""

import json
from collections.abc import Callable
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest
from click.testing import Result
from matplotlib.image import imread

from floatref.files import read_profile, write_profile, write_recording
from floatref.measures import agreement
from floatref.tuning.levels import TUNED
from floatref.values.profile import Profile
from floatref_conformance.proving_ground import Scenario, simulate

ROAD: dict[str, Any] = {
    "road_seed": 3,
    "rate_hz": 1000.0,
    "length_m": 160.0,
    "profile_interval_m": 0.05,
    "tracks": ["left"],
}
STOP: dict[str, Any] = {
    "manoeuvre": "stop",
    "speed_kmh": 50.0,
    "deceleration_g": 0.33,
    "dwell_s": 1.2,
    "event_at_m": 90.0,
    "final_speed_kmh": 25.0,
    "slip_percent_per_g": 0.0,
}
"""The encoder does not slip: a road that is displaced by a brake is nothing that settings mend."""
GIVEN = {"cutoff_wavelength_m": 30.0, "acceleration_walk": 0.5}
"""With the first 160 m of road are enough; the second is far too large for a stop."""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory, ran) -> Path:
    """Return a folder of three runs, their road, settings, and what was tuned to two of them."""
    folder = tmp_path_factory.mktemp("tuned")
    for seed, (name, drive) in enumerate({"fast": {}, "stop": STOP, "again": STOP}.items()):
        simulation = simulate(Scenario.from_dict({**ROAD, "seed": seed, **drive}))
        write_recording(simulation.recording, folder / name)
        if name == "fast":
            write_profile(simulation.truth, folder / "road")
    (folder / "given.json").write_text(json.dumps(GIVEN), encoding="utf-8")
    result = tuned(
        ran, folder, "fast", "stop", "--out", folder / "tuned.json", "--plot", folder / "p.png"
    )
    (folder / "out.txt").write_text(result.stdout, encoding="utf-8")
    (folder / "err.txt").write_text(result.stderr, encoding="utf-8")
    return folder


def tuned(ran, folder: Path, *arguments: object) -> Result:
    """Return what tuning to runs in ``folder`` prints; those without a slash are their names."""
    given = ["--reference", folder / "road", "--settings", folder / "given.json"]
    runs = [folder / a if a in ("fast", "stop") else a for a in arguments]
    return ran("tune", *runs, *given)


@pytest.fixture
def inputs(made: Path, tmp_path: Path) -> Path:
    for name in ("fast", "stop", "road"):
        copytree(made / name, tmp_path / name)
    return tmp_path


@pytest.fixture
def processed(made: Path, ran) -> Callable[[Path, str, str], Profile]:
    def process(target: Path, run: str, settings: str) -> Profile:
        arguments = ("--out", target, "--settings", made / settings)
        ran("process", made / run, *arguments, "--pipeline", "kalman-smoother-reflection")
        return read_profile(target)

    return process


@pytest.mark.slow
def test_settings_are_those_given_and_the_four_that_are_tuned(made: Path) -> None:
    written = json.loads((made / "tuned.json").read_text(encoding="utf-8"))
    assert set(written) == {*TUNED, "cutoff_wavelength_m"}
    assert written["cutoff_wavelength_m"] == GIVEN["cutoff_wavelength_m"]
    assert written["acceleration_walk"] < 0.2 * GIVEN["acceleration_walk"]


@pytest.mark.slow
def test_a_profile_made_with_them_agrees_better_with_the_road(
    made: Path, tmp_path: Path, processed
) -> None:
    road = read_profile(made / "road").track("left").elevation
    inside = slice(300, 2900)
    for run in ("stop", "again"):
        before = processed(tmp_path / f"{run}-before", run, "given.json")
        after = processed(tmp_path / f"{run}-after", run, "tuned.json")
        scores = [
            agreement(road[inside], p.track("left").elevation[inside], 0.05).cross_correlation
            for p in (before, after)
        ]
        assert scores[0] < 0.9 < 0.95 < scores[1], run


@pytest.mark.slow
def test_tables_tell_values_scores_and_sensitivity(made: Path) -> None:
    text = (made / "out.txt").read_text(encoding="utf-8")
    assert "\x1b" not in text
    rows = [line.split() for line in text.splitlines()]
    (walk,) = [row for row in rows if row[:2] == ["acceleration_walk", "0.5"]]
    written = json.loads((made / "tuned.json").read_text(encoding="utf-8"))
    assert float(walk[2]) == written["acceleration_walk"]
    assert walk[-1] == "m/s²/√s"
    (fast,) = [row for row in rows if row[:4] == ["fast", "high", "speed", "left"]]
    (stop,) = [row for row in rows if row[:4] == ["stop", "short", "stop", "left"]]
    assert min(map(float, fast[4:7])) > 0.95
    assert float(stop[4]) < 0.5 < float(stop[5]) < 0.9 < 0.95 < float(stop[6])
    assert (fast[7], stop[7]) == ("IRI", "peak")
    assert sum(row[-1:] == ["stop"] for row in rows) >= 1
    (before,) = [float(row[1]) for row in rows if row[:1] == ["loss_before"]]
    (after,) = [float(row[1]) for row in rows if row[:1] == ["loss_after"]]
    assert after < 0.3 * before


@pytest.mark.slow
def test_missing_kinds_are_a_warning(made: Path) -> None:
    text = (made / "err.txt").read_text(encoding="utf-8")
    assert "Warning: recommended, and not among the runs: constant speed of 8 km/h" in text
    assert "72 km/h" not in text


@pytest.mark.slow
def test_the_plot_is_a_picture(made: Path) -> None:
    assert imread(made / "p.png").shape[0] > 500


@pytest.mark.slow
def test_json_holds_runs_values_and_sensitivity(made: Path, tmp_path: Path, ran) -> None:
    target = tmp_path / "a.json"
    pipeline = "kalman-smoother-constant-height-attitude"
    result = tuned(ran, made, "fast", "--json", "--out", target, "--pipeline", pipeline)
    report = json.loads(result.stdout)
    assert report["settings"] == json.loads(target.read_text(encoding="utf-8"))
    assert (report["file"], report["pipeline"]) == (str(target), pipeline)
    (fast,) = report["runs"]
    assert (fast["run"], fast["kind"], fast["stop_s"]) == ("fast", "high speed", 0.0)
    assert fast["speed_kmh"] == pytest.approx(72.0, abs=0.2)
    (track,) = fast["tracks"]
    for score in (track["nominal"], track["before"], track["after"]):
        assert 0.9 < score["cross_correlation"] <= 1.0
        assert abs(score["iri_error_percent"]) < 5.0
        assert score["peak_error_percent"] is None
    assert [item["setting"] for item in report["tuned"]] == list(TUNED)
    # Without GNSS its four standard deviations have no effect.
    assert len(report["sensitivity"]) == 7
    for item in report["sensitivity"]:
        assert item["factors"] == pytest.approx([0.7071, 1.0, 1.4142], abs=1e-4)
        assert item["loss"][1] == report["sensitivity"][0]["loss"][1] <= report["loss"]["after"]
        assert item["largest_rise"] >= 0.0
    assert report["profiles"] == report["combinations"] <= 850
    assert len(report["missing_runs"]) == 5


@pytest.mark.slow
def test_what_is_there_is_kept(made: Path, refused) -> None:
    before = (made / "tuned.json").read_bytes()
    arguments = (made / "fast", "--reference", made / "road", "--out", made / "tuned.json")
    assert "tuned.json: exists; choose another name" in refused("tune", *arguments)
    assert (made / "tuned.json").read_bytes() == before


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["stop"], "no run at a constant speed of 60 km/h or more"),
        (["fast", "./fast"], "fast: given twice"),
        (["nowhere"], "nowhere: not found"),
        ([], "Missing argument 'RECORDING...'"),
        (["fast", "--pipeline", "temporal-basic"], "has no acceleration_density to tune"),
        (["fast", "--pipeline", "kalman"], "pipeline kalman: unknown"),
        (["fast", "--settings", "road/profile.json"], "setting format: "),
        (["fast", "--max-offset", "-1"], "-1.0 is not in the range"),
        (["fast", "--plot", "a.txt"], "a.txt: not the name of a drawing"),
        (["fast", "--plot", "out.json"], "is the settings' own name"),
        (["fast", "--out", "road", "--overwrite"], "road: is a folder"),
        (["fast", "--out", "none/a.json"], "its folder does not exist"),
    ],
)
def test_what_cannot_be_used_is_one_line_and_leaves_nothing(
    inputs: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], text: str, refused
) -> None:
    monkeypatch.chdir(inputs)
    (inputs / "g.json").write_text('{"cutoff_wavelength_m": 30.0}', encoding="utf-8")
    before = sorted(inputs.rglob("*"))
    usual = ["--reference", "road", "--out", "out.json", "--settings", "g.json"]
    assert text in refused("tune", *usual, *arguments)
    assert sorted(inputs.rglob("*")) == before


@pytest.mark.slow
def test_progress_is_shown_on_a_terminal_only(
    inputs: Path, monkeypatch: pytest.MonkeyPatch, invoke
) -> None:
    # The run with a stop is refused after it was looked at, which is progress enough.
    arguments = ("tune", inputs / "stop", "--reference", inputs / "road", "--out", inputs / "a")
    plain = invoke(*arguments)
    assert "Preparation" not in plain.output
    # rich takes this for a terminal.
    monkeypatch.setenv("FORCE_COLOR", "1")
    shown = invoke(*arguments)
    assert "Preparation of stop" in shown.stderr
    assert "Preparation" not in shown.stdout
