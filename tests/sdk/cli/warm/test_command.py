"""After `floatref warm` a recording compiles nothing, and mistakes are one line."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from floatref import pipelines, process, write_recording
from floatref.cli.main import main
from floatref.cli.warm import command
from floatref.cli.warm.made_up_run import made_up_recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

PIPELINE = "temporal-adaptive-hpf-spatial-backward"


@pytest.mark.slow
def test_a_recording_compiles_nothing_after_it(tmp_path: Path) -> None:
    """Nor does the command itself, the second time."""
    environment = os.environ | {
        "FLOATREF_TRACE": "compile",
        "NUMBA_CACHE_DIR": str(tmp_path / "cache"),
    }
    drive = Scenario(length_m=150.0, imu=False, gnss=False, response=False, seed=3)
    write_recording(simulate(drive).recording, tmp_path / "run")

    def floatref(*words: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "floatref", *words]
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True
        )

    warmed = json.loads(floatref("warm", PIPELINE, "--json").stdout)
    assert [each["pipeline"] for each in warmed["pipelines"]] == [PIPELINE]
    lines = floatref("process", "run", "--out", "made", "--pipeline", PIPELINE).stderr.splitlines()
    traced = [line for line in lines if line.startswith("compile ")]
    assert len(traced) > 5
    assert all(line.startswith("compile loaded") for line in traced)


# Its inertial unit and its GNSS do not measure one motion, which a run states.
@pytest.mark.filterwarnings("ignore::floatref.engine.run.FloatrefWarning")
@pytest.mark.slow
@pytest.mark.parametrize("pipeline", pipelines())
def test_the_run_is_one_that_the_pipeline_takes(pipeline: str) -> None:
    made = process(made_up_recording(pipeline), pipeline)
    assert made.length_m > 100.0
    assert all(np.isfinite(track.elevation).any() for track in made.tracks)


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (("no-such",), "pipeline no-such: unknown"),
        (("--all", PIPELINE), "--all warms every pipeline; give it, or names of pipelines"),
    ],
)
def test_what_cannot_be_warmed_is_one_line(words: tuple[str, ...], line: str) -> None:
    done = CliRunner().invoke(main, ["warm", *words])
    assert done.exit_code == 2
    assert done.stderr.startswith(f"Error: {line}")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("stored", [True, False])
def test_a_line_says_that_nothing_was_stored(stored: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "_warm_all", lambda names, jobs: [(name, 1.0) for name in names])
    monkeypatch.setattr(command, "stores_code", lambda: stored)
    done = CliRunner().invoke(main, ["warm", PIPELINE, "--json"])
    assert done.exit_code == 0
    assert [each["pipeline"] for each in json.loads(done.stdout)["pipelines"]] == [PIPELINE]
    lines = [] if stored else [f"Warning: {command.NOT_STORED}"]
    assert done.stderr.splitlines() == lines
