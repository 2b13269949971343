"""A stop is measured within 2 % with no option, and a pipeline that cannot measure it says so."""

import csv
import json
import subprocess
import sys
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

import floatref
from floatref.files import write_recording
from floatref.measures import iri
from floatref_conformance.cli.main import main as conformance
from floatref_conformance.proving_ground import Scenario, simulate

SCENARIO = Scenario(
    manoeuvre="stop",
    event_at_m=130.0,
    length_m=280.0,
    rate_hz=1000.0,
    profile_interval_m=0.05,
    seed=3,
)
CLOSE = 0.02
LOSES = "--pipeline", "temporal-basic"
CANNOT = "temporal-basic cannot measure the stop at 130 m: "
Answer = tuple[dict[str, float], str]


@pytest.fixture(scope="module", params=["all sensors", "nominal sensors"])
def stop(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the recording `run` of a stop, and its `truth`."""
    folder = tmp_path_factory.mktemp("stop")
    more = request.param == "all sensors"
    run = simulate(SCENARIO if more else replace(SCENARIO, imu=False, gnss=False, response=False))
    write_recording(run.recording, folder / "run")
    floatref.write_profile(run.truth, folder / "truth")
    return folder


def by_process(folder: Path, *options: str) -> Answer:
    words = "process", str(folder / "run"), "--out", str(folder / "made"), "--overwrite", "--json"
    done = floatref_command(*words, *options)
    report = json.loads(done.stdout)
    return {t["name"]: t["iri_m_per_km"] for t in report["tracks"]}, " ".join(report["warnings"])


def by_batch(folder: Path, *options: str) -> Answer:
    out = folder / f"batch{len(options)}"
    words = "batch", str(folder / "run"), "--out", str(out), "--jobs", "1"
    done = floatref_command(*words, *options)
    with (out / "summary.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return {row["track"]: float(row["iri_m_per_km"]) for row in rows}, done.stderr


def by_certify(folder: Path, *options: str) -> Answer:
    words = "certify", str(folder / "run"), "--reference", str(folder / "truth"), "--json"
    document = json.loads(CliRunner().invoke(conformance, [*words, *options]).stdout)
    (run,) = document["sections"][0]["runs"]
    return {t["track"]: t["iri_m_per_km"] for t in run["tracks"]}, " ".join(run["said"])


def by_python(folder: Path, *options: str) -> Answer:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        profile = floatref.process(folder / "run", *options[1:])
    lines = " ".join(str(each.message) for each in caught)
    return {t.name: iri(t.elevation, profile.interval_m) for t in profile.tracks}, lines


def floatref_command(*words: str) -> subprocess.CompletedProcess[str]:
    command = sys.executable, "-m", "floatref", *words
    return subprocess.run(command, capture_output=True, text=True, check=True)


WAYS = by_process, by_batch, by_certify, by_python
by_way = pytest.mark.parametrize("way", WAYS)


@pytest.mark.slow
@by_way
def test_without_an_option_the_iri_is_right(stop: Path, way: Callable[..., Answer]) -> None:
    truth = floatref.read_profile(stop / "truth")
    found, lines = way(stop)
    assert list(found) == list(truth)
    for name, value in found.items():
        assert value == pytest.approx(iri(truth[name].elevation, truth.interval_m), rel=CLOSE)
    assert "cannot measure" not in lines


@pytest.mark.slow
@by_way
def test_a_pipeline_that_cannot_measure_it_names_one_that_can(
    stop: Path, way: Callable[..., Answer]
) -> None:
    found, lines = way(stop, *LOSES)
    assert f"{CANNOT}{way_out(stop)} can, with the channels of this recording" in lines
    assert min(found.values()) > 3.0


def way_out(stop: Path) -> str:
    gnss = (stop / "run" / "gnss_height.f64").exists()
    return "kalman-smoother-reflection" if gnss else "road-prior-smoother"
