"""The example of a vendor's plug-in, installed into a fresh environment and removed again."""

import json
import re
import subprocess
import sys

import numpy as np
import pytest

from floatref import read_profile, write_recording

pytestmark = pytest.mark.slow

MAP = """format = "floatref-map/1"

[[channels]]
native = "ACC"
channel = "vertical_specific_force"
unit = "g"

[[channels]]
native = "LASER"
channel = "height"
unit = "mm"

[[channels]]
native = "ENCODER"
channel = "distance"
unit = "m"
scale = 0.0005
offset = -1073731.824
wrap = 4294967296
"""
WRITE = "-m", "acme_roadlogger.writer"


@pytest.fixture(scope="module")
def run(installed, wavy):
    """A recording, what the logger would have written of it, and its map."""
    write_recording(wavy, installed.folder / "run")
    installed.run("python", *WRITE, "run", "run.arl")
    (installed.folder / "run.toml").write_text(MAP)
    return installed


def test_it_is_found(installed):
    adapters = json.loads(installed.run("floatref", "adapters", "--json").stdout)
    assert {"name": "acme-roadlogger", "summary": "ACME RoadLogger, version 1"} in adapters[
        "adapters"
    ]
    pipelines = json.loads(installed.run("floatref", "pipelines", "--json").stdout)
    (ours,) = [p for p in pipelines["pipelines"] if p["name"] == "acme-roadlogger"]
    assert ours["settings"]["spike_m"] == 0.01
    assert adapters["warnings"] == pipelines["warnings"] == []


def test_the_stage_is_found(installed):
    code = "import floatref; print(floatref.stage_names())"
    assert "'RemoveSpikes'" in installed.run("python", "-c", code).stdout


def test_a_file_is_listed(run):
    found = json.loads(run.run("floatref", "channels", "run.arl", "--json").stdout)
    assert found["adapter"] == "acme-roadlogger"
    assert found["device"] == {"vendor": "ACME", "model": "RoadLogger RL-0042"}
    listed = {
        column["name"]: (column["unit"], stream["count"])
        for stream in found["streams"]
        for column in stream["columns"]
    }
    assert listed == {
        "ACC": ("g", 64_000),
        "LASER": ("mm", 64_000),
        "ENCODER": ("counts", 64_000),
    }


def test_a_file_gives_the_profile_of_the_recording_it_was_made_from(run):
    words = "--pipeline", "acme-roadlogger", "--out"
    done = run.run("floatref", "process", "run.arl", "--map", "run.toml", *words, "native")
    assert "Warning" not in done.stderr
    run.run("floatref", "process", "run", *words, "direct")
    native, direct = (read_profile(run.folder / name) for name in ("native", "direct"))
    assert native.provenance["adapter"] == "acme-roadlogger"
    one, two = native.tracks[0], direct.tracks[0]
    size = min(one.elevation.size, two.elevation.size)
    inside = slice(20_000, size - 20_000)
    assert np.ptp(two.elevation[inside]) > 0.008
    # The laser's quantum is 0.01 mm; half a count of the encoder is 0.5 µm on this road's slopes.
    np.testing.assert_allclose(one.elevation[inside], two.elevation[inside], rtol=0, atol=2e-5)


def test_a_damaged_file_is_processed_and_says_what_is_gone(run):
    whole = bytearray((run.folder / "run.arl").read_bytes())
    whole[len(whole) // 2] ^= 1
    (run.folder / "damaged.arl").write_bytes(whole)
    words = "--map", "run.toml", "--out", "damaged"
    done = run.run("floatref", "process", "damaged.arl", *words)
    assert "Warning: damaged.arl: 1 damaged places" in done.stderr
    assert "no samples for" in done.stderr or "missing" in done.stderr


def test_the_judge_runs_the_device(installed):
    checks = "--check", "quiescent", "--check", "bounce"
    device = "python:acme_roadlogger.device:device"
    # Some checks are selected, so that the verdict is INCOMPLETE.
    words = "run", "--device", device, *checks, "--report", "report"
    installed.run("conformance", *words, code=4)
    report = json.loads((installed.folder / "report" / "report.json").read_text())
    assert report["device"]["name"] == "ACME RoadLogger"
    outcomes = {check["id"]: check["outcome"] for check in report["checks"]}
    assert outcomes["quiescent"] == outcomes["bounce"] == "pass"
    assert set(outcomes.values()) <= {"pass", "skip"}


def test_its_own_tests_pass_as_its_page_says(installed, plugin):
    (line,) = re.findall("^pytest (.*)$", (plugin / "README.md").read_text(), re.M)
    # What is not among its own requirements is not there.
    words = "-p", "no:cacheprovider", "-p", "no:xdist"
    done = installed.run("python", "-m", "pytest", *words, plugin.parents[2] / line)
    assert " passed" in done.stdout


def test_removed_it_is_gone(make_environment, plugin):
    fresh = make_environment()
    without = fresh.run("floatref", "adapters").stdout
    fresh.install(plugin)
    assert "acme-roadlogger" in fresh.run("floatref", "adapters").stdout
    fresh.pip("uninstall", "--quiet", "--yes", "acme-roadlogger")
    after = fresh.run("floatref", "adapters")
    assert after.stdout == without
    assert after.stderr == ""
    fresh.run("python", "-c", "import acme_roadlogger", code=1)


def test_nothing_was_installed_here(installed):
    words = [sys.executable, "-c", "import acme_roadlogger"]
    assert subprocess.run(words, cwd="/", capture_output=True).returncode == 1
