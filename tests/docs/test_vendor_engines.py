"""Two engines of somebody else at a stop: ruined as they are, mended by one stage of ours."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.measures import short_interval_roughness
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.proving_ground import scenario_of_run, simulate
from floatref_reference.chapter_5.section_5_8 import captured

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
G = 9.80665
RATE_HZ, SPACING_M, PULSE_M = 4000.0, 0.024, 0.0003
PIPELINES = {
    "Our high-pass before its integrals": "temporal-adaptive-hpf-spatial-backward",
    "All three": "spatial-hpf-timer-distortion-reflection",
}


@pytest.fixture(scope="module")
def stop():
    """Acceleration, height and distance of one wheel path over a stop of 5.8 s, in SI units."""
    scenario = scenario_of_run(
        "sg_5.8s_0.20g", imu=False, gnss=False, tracks=("main",), rate_hz=RATE_HZ
    )
    recording = simulate(scenario).recording
    force = recording.channel("vertical_specific_force", "main").values
    return (
        force - G,
        recording.channel("height", "main").values,
        recording.channel("distance").values,
    )


@pytest.fixture(scope="module")
def slow_part(stop):
    """The second before the vehicle stands, and all of it up to four seconds after."""
    speed = np.diff(stop[2], prepend=stop[2][0])
    still = np.flatnonzero(speed[1000:-1000] > 0) + 1000
    gap = np.argmax(np.diff(still))
    begin, end = still[gap] - 4000, still[gap + 1] + 16000
    return tuple(x[begin:end] for x in stop)


@pytest.fixture
def engine(tmp_path):
    """Return a maker of an engine as it is, or with the change under a heading of its page."""

    def make(name, heading=None):
        source = (EXAMPLES / name / "engine.py").read_text(encoding="utf-8")
        file = tmp_path / "engine.py"
        file.write_text(source, encoding="utf-8")
        if heading is not None:
            change = tmp_path / "change.patch"
            change.write_text(changes(name)[heading], encoding="utf-8")
            alone = {**os.environ, "GIT_CEILING_DIRECTORIES": str(tmp_path.parent)}
            subprocess.run(["git", "apply", "change.patch"], cwd=tmp_path, env=alone, check=True)
            assert file.read_text(encoding="utf-8") != source
        spec = importlib.util.spec_from_file_location("engine", file)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return make


def changes(name):
    """Return the changes of an engine's page by heading."""
    page = (EXAMPLES / name / "README.md").read_text(encoding="utf-8")
    return dict(re.findall(r"^## ([^\n]+)\n.*?^```diff\n(.*?)^```$", page, re.M | re.S))


def in_time(engine, drive):
    """Profile in m of the temporal engine, from a record in its units."""
    return 0.001 * engine.run(temporal_record(engine, drive))


def temporal_record(engine, drive):
    acceleration, height, distance = drive
    record = np.empty(height.size, engine.SAMPLE)
    record["accel_g"], record["range_mm"] = 1.0 + acceleration / G, 1000.0 * height
    record["pulses"] = np.round(distance / PULSE_M) - round(distance[0] / PULSE_M)
    return record


def over_distance(engine, drive):
    """Profile in m of the spatial engine, from a record in its units."""
    return 0.001 * engine.run(spatial_record(drive))


def spatial_record(drive):
    """Return the lines of ``drive`` that the spatial engine reads."""
    acceleration, height, step = (x.astype(float) for x in captured(*drive, RATE_HZ, SPACING_M))
    timer = np.round(1e6 * np.cumsum(step)).astype(int)
    columns = timer.tolist(), (1e4 * acceleration).tolist(), (1e6 * height).tolist()
    return [f"{t},{a!r},{h!r}" for t, a, h in zip(*columns, strict=True)]


def peak(profile):
    return short_interval_roughness(profile, SPACING_M).max()


def pipeline(name, drive):
    """Elevation in m by a pipeline of ours."""
    acceleration, height, distance = drive
    clock = UniformClock.of(RATE_HZ)
    recording = Recording(
        (
            Channel.of("vertical_specific_force", acceleration + G, clock),
            Channel.of("height", height, clock),
            Channel.of("distance", distance, clock),
        ),
        Setup(profile_interval_m=SPACING_M),
    )
    return floatref.process(recording, name).tracks[0].elevation


def test_the_stop_ruins_the_temporal_engine_as_it_is(engine, stop):
    assert peak(in_time(engine("temporal_engine"), stop)) > 100.0


@pytest.mark.parametrize("heading", changes("temporal_engine"))
def test_one_stage_saves_the_temporal_engine(engine, stop, heading):
    assert peak(in_time(engine("temporal_engine", heading), stop)) < 5.0


def test_the_stop_ruins_the_spatial_engine_as_it_is(engine, stop):
    assert peak(over_distance(engine("spatial_engine"), stop)) > 100.0


def test_the_time_step_saves_the_spatial_engine_and_the_reflection_more(engine, stop):
    limited = engine("spatial_engine", "Our time step in its integrals")
    reflecting = engine("spatial_engine", "Our reflection in its second integral")
    worst = peak(over_distance(limited, stop))
    assert worst < 20.0
    assert peak(over_distance(reflecting, stop)) < min(10.0, 0.5 * worst)


def test_the_limit_of_its_own_needs_the_reflection(engine, stop):
    module = engine("spatial_engine", "Our reflection in its second integral")
    reflected = peak(over_distance(module, stop))

    class Plain:
        def __init__(self):
            self.integral = module.Integral()

        def reference_height(self, velocity, taken, step, height):
            return [self.integral.add(velocity[0], taken[0])]

    module.HeightReflection = Plain
    assert peak(over_distance(module, stop)) > 2.0 * reflected


def test_the_temporal_engine_with_our_high_pass_is_our_pipeline(engine, stop):
    heading = "Our high-pass before its integrals"
    profile = in_time(engine("temporal_engine", heading), stop)
    np.testing.assert_allclose(profile, pipeline(PIPELINES[heading], stop), rtol=0, atol=1e-6)


def test_the_spatial_engine_with_all_three_is_our_pipeline(engine, slow_part):
    profile = over_distance(engine("spatial_engine", "All three"), slow_part)
    assert profile.size > 400
    expected = pipeline(PIPELINES["All three"], slow_part)
    np.testing.assert_allclose(profile, expected, rtol=0, atol=1e-6)


def test_the_engines_run_as_programs(engine, slow_part, tmp_path):
    module = engine("temporal_engine")
    (tmp_path / "run.bin").write_bytes(temporal_record(module, slow_part).tobytes())
    lines = "\n".join(spatial_record(slow_part))
    for name, argument, given in (
        ("temporal_engine", "run.bin", None),
        ("spatial_engine", "-", lines),
    ):
        file = EXAMPLES / name / "engine.py"
        command = [sys.executable, file, argument]
        found = subprocess.run(
            command, cwd=tmp_path, input=given, capture_output=True, text=True, check=True
        )
        assert len(found.stdout.split()) == pipeline("spatial-basic", slow_part).size


def test_the_engines_know_nothing_of_ours():
    for source in EXAMPLES.glob("*/engine.py"):
        assert "import floatref" not in source.read_text(encoding="utf-8")
        assert "from floatref" not in source.read_text(encoding="utf-8")
