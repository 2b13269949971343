"""The page on the matched high-pass: its script runs, its figures are what the code finds."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.measures import high_pass
from floatref.values.channels import STANDARD_GRAVITY
from floatref_conformance.proving_ground import scenario_of_run, simulate
from floatref_conformance.proving_ground.drives.runs import RUNS
from floatref_conformance.table.scores import score

pytestmark = pytest.mark.slow

DOCS = Path(__file__).parents[2] / "docs"
SCRIPT = DOCS / "examples" / "matched_high_pass.py"
PAGE = (DOCS / "matched-high-pass.md").read_text(encoding="utf-8")
ROWS = re.compile(r"^(.+?) +(\S+) +(\S+)$", re.M)
CASCADE, OBSERVER = "temporal-adaptive-hpf-spatial-backward", "temporal-matched-hpf"
SHOWN = {
    "the seven stops, mean": [name for name, run in RUNS.items() if run.kind == "stop"],
    "near stop 72 to 11 km/h, 0.20 g": ["ns_72-11_0.20g"],
    "brake 72 to 29 km/h, 0.39 g": ["brk_72-29_0.39g"],
    "brake 49 to 34 km/h, 0.84 g": ["brk_49-34_0.84g"],
}


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("matched_high_pass", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """What the script prints, and the picture that it writes."""
    folder = tmp_path_factory.mktemp("run")
    command = [sys.executable, SCRIPT, "out.png"]
    found = subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8", check=True)
    return found.stdout, (folder / "out.png").read_bytes()


def figures(text):
    return {name: (float(mm), tilt) for name, mm, tilt in ROWS.findall(text)[1:]}


def test_the_observer_leaves_nothing_and_the_cascade_millimetres(run):
    printed, picture = run
    assert picture.startswith(b"\x89PNG")
    assert len(picture) > 50_000
    found = figures(printed)
    assert len(found) == 5
    for name, (mm, _) in found.items():
        matched = "observer" in name or "matched" in name
        assert mm <= 1e-3 if matched else mm >= 1.0, name


def test_the_page_shows_what_the_script_prints(run):
    (shown,) = re.findall(r"^```text\n(.*?)^```$", PAGE, re.M | re.S)
    expected, found = figures(shown), figures(run[0])
    assert list(expected) == list(found)
    for name, (mm, tilt) in expected.items():
        assert found[name][0] == pytest.approx(mm, rel=0.02), name
        if tilt != "–":
            assert float(found[name][1]) == pytest.approx(float(tilt), abs=0.11), name


def test_the_cascade_keeps_its_drift_and_the_observer_takes_it_back(script):
    times, distance, *_ = script.drive()
    error = script.TILT * script.swelling(times, script.BEGINS[3], script.TO_STOP_S)[0]
    found = script.forward_passes(error, np.full(times.size, 0.3), distance)
    cascade, observer = (1000.0 * found[f"{x}, forward only"] for x in ("cascade", "observer"))
    stands, rolls = (np.searchsorted(times, script.BEGINS[k]) for k in (4, 5))
    assert cascade[rolls:] == pytest.approx(np.full(cascade[rolls:].size, 40.0), rel=0.01)
    highest = np.argmax(observer[:stands])
    assert observer[highest] == pytest.approx(85.0, abs=0.5)
    back = highest + np.argmax(observer[highest:] < 1.0)
    assert distance[back] - distance[highest] < 1.3
    assert np.abs(observer[rolls:]).max() < 0.1


def test_bounce_and_dive_alone_leave_what_the_page_says(script):
    times, distance, *_ = script.drive()

    def left(size, *swelling):
        motion, acceleration = (size * x for x in script.swelling(times, *swelling))
        found = script.elevations(acceleration, 0.3 + motion, distance).items()
        return {name: 1000.0 * np.abs(elevation).max() for name, (_, elevation) in found}

    run = 1.0, script.BEGINS[-1] - 2.0
    assert left(script.BOUNCE_M, *run, 3.0)[CASCADE] == pytest.approx(160.0, abs=5.0)
    assert left(script.BOUNCE_M, *run, 0.5)[CASCADE] > 1000.0
    dive = left(script.DIVE_M, script.BEGINS[3], script.TO_STOP_S + 0.5)
    assert dive["temporal-adaptive-hpf"] == pytest.approx(28.0, abs=0.5)
    assert dive[CASCADE] == pytest.approx(143.0, abs=0.5)
    trapezoids = script.BOUNCE_M * (2.0 * np.pi * 2.0 / script.RATE_HZ) ** 2 / 6.0
    assert trapezoids == pytest.approx(0.08e-6, abs=0.005e-6)
    found = left(script.BOUNCE_M, *run, 2.0)["observer, forward only"]
    assert found == pytest.approx(1000.0 * trapezoids, rel=0.1)


def correlations(run):
    """Cross correlation with the road, as driven and level: cascade and observer of each."""
    perfect = {"sensors": 0.0, "slip_percent_per_g": 0.0, "laser_ahead_m": 0.0}
    simulation = simulate(scenario_of_run(run, imu=False, gnss=False, rate_hz=4000.0, **perfect))
    interval_m, tracks = simulation.truth.interval_m, simulation.truth.tracks
    filtered = [
        floatref.ProfileTrack.of(x.name, high_pass(x.elevation, interval_m)) for x in tracks
    ]
    road = floatref.Profile(interval_m, tuple(filtered))
    return [
        np.mean([x.cross_correlation for x in score(road, profile).values()])
        for recording in (simulation.recording, level(simulation))
        for profile in (floatref.process(recording, name) for name in (CASCADE, OBSERVER))
    ]


def level(simulation):
    """The recording of an accelerometer and a laser that are kept plumb."""
    clock = simulation.motion.clock
    channels = [simulation.recording.channel("distance")]
    for name, track in simulation.motion.tracks.items():
        force = STANDARD_GRAVITY + track.acceleration
        height = track.height_m - track.road_m
        channels.append(floatref.Channel.of("vertical_specific_force", force, clock, name))
        channels.append(floatref.Channel.of("height", height, clock, name))
    return floatref.Recording(tuple(channels), simulation.recording.setup)


@pytest.mark.filterwarnings("ignore::floatref.FloatrefWarning")
@pytest.mark.parametrize("row", SHOWN)
def test_the_page_says_what_tilt_does(row):
    (shown,) = re.findall(rf"^\| {re.escape(row)} \|(.+)\|$", PAGE, re.M)
    found = np.array([correlations(run) for run in SHOWN[row]])
    mean = found.mean(axis=0)
    assert mean == pytest.approx([float(x) for x in shown.split("|")], abs=0.006)
    assert mean[3] > mean[2]
    assert (found[:, 3] < found[:, 2]).sum() == (3 if len(found) == 7 else 0)
