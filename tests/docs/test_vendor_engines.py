"""Two engines of somebody else at a stop: ruined as they are, mended by one stage of ours."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import floatref
from floatref.measures import short_interval_roughness
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording, Setup

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"


def load(file):
    """Return the program ``file`` as a module."""
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


PROGRAM = load(EXAMPLES / "before_and_after.py")
G, RATE_HZ, SPACING_M = PROGRAM.G, PROGRAM.RATE_HZ, PROGRAM.SPACING_M
PIPELINES = {
    "Our high-pass before its integrals": "temporal-adaptive-hpf-spatial-backward",
    "All three": "spatial-hpf-timer-distortion-reflection",
}


@pytest.fixture(scope="module")
def stop():
    """Acceleration, height and distance of one wheel path over a stop of 5.8 s, in SI units."""
    return PROGRAM.drive()


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
        made = PROGRAM.make_engine(name, tmp_path, heading)
        source = (EXAMPLES / name / "engine.py").read_text(encoding="utf-8")
        written = (tmp_path / "engine.py").read_text(encoding="utf-8")
        assert (written == source) == (heading is None)
        return made

    return make


def in_time(engine, driven):
    """Profile in m of the temporal engine, from a record in its units."""
    return PROGRAM.profile_of("temporal_engine", engine, driven)


def over_distance(engine, driven):
    """Profile in m of the spatial engine, from a record in its units."""
    return PROGRAM.profile_of("spatial_engine", engine, driven)


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


@pytest.mark.parametrize("heading", PROGRAM.changes("temporal_engine"))
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
    (tmp_path / "run.bin").write_bytes(PROGRAM.temporal_record(module, slow_part).tobytes())
    lines = "\n".join(PROGRAM.spatial_record(slow_part))
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


@pytest.mark.parametrize("name", ["temporal_engine", "spatial_engine"])
def test_one_command_shows_both_as_the_page_has_it(name):
    command = [sys.executable, "docs/examples/before_and_after.py", name]
    found = subprocess.run(
        command, cwd=EXAMPLES.parents[1], capture_output=True, text=True, check=True
    )
    page = (EXAMPLES / name / "README.md").read_text(encoding="utf-8")
    assert f"python docs/examples/before_and_after.py {name}" in page
    assert found.stdout in page
    first, *changed = (float(line.split()[-2]) for line in found.stdout.splitlines()[1:])
    assert first > 100.0
    assert max(changed) < 20.0
