"""The stationary checks as a user runs them, on the device by default."""

import json
import subprocess
import sys

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from floatref_conformance.cli.main import main
from floatref_conformance.schemas import read_schema

pytestmark = pytest.mark.slow

BOTH = ["--check", "quiescent", "--check", "bounce"]


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """The report of the first command of the README, from a process of its own."""
    folder = tmp_path_factory.mktemp("report")
    command = [sys.executable, "-m", "floatref_conformance", "run", *BOTH, "--report", str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done, (folder / "report.json").read_bytes()


def test_the_recommended_pipeline_passes_both_and_the_run_is_incomplete(reported):
    done, report = reported
    assert done.returncode == 4, done.stderr
    assert "INCOMPLETE: 2 of 2 checks that ran passed; 13 were not run" in done.stdout
    document = json.loads(report)
    Draft202012Validator(read_schema("conformance-report-1")).validate(document)
    outcomes = {c["id"]: c["outcome"] for c in document["checks"]}
    assert (outcomes.pop("quiescent"), outcomes.pop("bounce")) == ("pass", "pass")
    assert set(outcomes.values()) == {"skip"}


def test_another_process_with_the_same_seed_writes_the_same_bytes(reported, tmp_path):
    CliRunner().invoke(main, ["run", *BOTH, "--report", str(tmp_path)])
    assert (tmp_path / "report.json").read_bytes() == reported[1]
