"""The mutants: known mistakes, each failed by a check that it names, and sound but for it."""

import numpy as np
import pytest

import floatref
from floatref.files import read_profile, write_recording
from floatref_conformance.checks.catalogue import IDS
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS
from floatref_conformance.checks.stationary.parked_checks import BOUNCE, QUIESCENT
from floatref_conformance.checks.streams.stream_catalogue import STREAM_CHECKS
from floatref_conformance.classes import Effort
from floatref_conformance.judge.bench import DeviceBench, make_taken
from floatref_conformance.judge.exercise import describe
from floatref_conformance.judge.replaying import judge_case
from floatref_conformance.mutants import MUTATIONS
from floatref_conformance.mutants.engine import in_time, over_distance, replace_elevations
from floatref_conformance.mutants.hostile import HOSTILE
from floatref_conformance.mutants.mutation import RECOMMENDED, SPATIAL
from floatref_conformance.plugins import load_registry
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.selftest.trying import Try, attempt

KIND = load_registry().kinds["mutant"]
ENTRIES = KIND.entries()
KNOWN = {
    *("accelerometer-sign", "laser-sign", "accelerometer-high", "accelerometer-low"),
    *("laser-high", "laser-low", "late-laser", "late-accelerometer", "gravity-kept"),
    *("tilt-ignored", "reverse-pass-missing", "cut-off-long", "cut-off-short", "sample-lost"),
    *("carry-leaking", "road-lost-at-a-stop", "held-at-the-stop", "reflection-sign", "all-zeros"),
    *("over-smoothed", "previous-result", "nan-at-the-end", "vouches-never", "vouches-always"),
    *("in-mm", "in-feet", "height-in-mm", "height-in-feet", "distance-in-feet", "force-in-g"),
    *("out-of-order", "hang", "crash", "flood", "garbage", "stop-refused"),
}
SHORT = {
    *("laser-high", "missing-height-zero", "height-in-mm", "cut-off-short", "stop-uncontained"),
    *("all-zeros", "swapped-tracks", "begins-late", "vouches-never", "crawl-low"),
    *("straight-at-a-near-stop", "steps-after-an-outage", "wheel-mass-halved"),
}
"""Some of every kind."""
CHEAPEST_FIRST = ("quiescent", "bounce", "low-speed", "dead-start", "coasting", "waveband")


def cheapest(fails):
    return next((id_ for id_ in CHEAPEST_FIRST if id_ in fails), fails[0])


def test_the_mutants_have_the_known_mistakes_and_different_names():
    names = [entry.name for entry in ENTRIES]
    assert set(names) >= KNOWN
    assert len(set(names)) == len(names)


def test_each_mutant_says_what_is_wrong_and_names_checks_that_there_are():
    for entry in ENTRIES:
        assert entry.summary
        assert entry.fails
        assert set(entry.fails) <= {*IDS, *STREAM_CHECKS}
        assert list(entry.fails) == [id_ for id_ in (*IDS, *STREAM_CHECKS) if id_ in entry.fails]


def test_each_check_is_the_only_one_that_some_mutant_names():
    assert {entry.fails[0] for entry in ENTRIES if len(entry.fails) == 1} == {*IDS, *STREAM_CHECKS}


@pytest.mark.slow
@pytest.mark.parametrize(
    "mutation",
    [pytest.param(m, marks=() if m.name in SHORT else pytest.mark.slow) for m in MUTATIONS],
    ids=lambda mutation: mutation.name,
)
def test_each_mutation_is_failed_by_a_check_that_it_names(mutation):
    assert attempt(Try(f"mutant:{mutation.name}", cheapest(mutation.fails), 0)).fails


@pytest.mark.slow
def test_what_a_mutant_repairs_is_no_news(tmp_path):
    """A warning would be an error here."""
    scenario = Scenario(rate_hz=4000.0, tracks=("left",), imu=False, gnss=False)
    hurt = SENSOR_FAULTS["laser-dropout"](
        make_taken(scenario).recording, {"at_m": 280.0, "length_s": 0.5}
    )
    write_recording(hurt.recording, tmp_path / "hurt")
    KIND.make("noisy-where-flat").run(tmp_path / "hurt", tmp_path / "profile")
    assert not read_profile(tmp_path / "profile").track("left").valid.all()


@pytest.mark.slow
def test_programs_that_behave_badly_are_mutants_too():
    assert {hostile.name for hostile in HOSTILE} <= {entry.name for entry in ENTRIES}
    assert "out-of-order" in {entry.name for entry in ENTRIES}
    assert "seq" in attempt(Try("mutant:out-of-order", "quiescent", 0)).fails


@pytest.mark.slow
def test_refusing_a_healthy_stop_is_a_false_alarm():
    check = load_registry().check("stop")
    case = check.cases(0, Effort.QUICK)[0]
    device = KIND.make("stop-refused")
    found = judge_case(check, case, DeviceBench(device, describe(device)))
    assert found.false_alarms == 1
    assert "raised InputError: channel distance: stuck" in found.fault


@pytest.mark.slow
def test_a_mutant_that_remembers_begins_with_nothing(tmp_path):
    case = BOUNCE.cases(0, Effort.QUICK)[1]
    delivered = []
    for n in range(2):
        write_recording(make_taken(case.scenario).recording, tmp_path / f"{n}")
        KIND.make("previous-result").run(tmp_path / f"{n}", tmp_path / f"p{n}")
        delivered.append(read_profile(tmp_path / f"p{n}").track("left").elevation)
        case = QUIESCENT.cases(0, Effort.QUICK)[1]
    assert not np.array_equal(*delivered)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("pipeline", "elevations"), [(RECOMMENDED, in_time()), (SPATIAL, over_distance())]
)
def test_the_engine_of_mutants_without_a_mistake_is_the_pipeline(pipeline, elevations):
    # The mutants' engine takes every laser to be under its accelerometer, and so it is here.
    numbers = {"tracks": ("left",), "imu": False, "gnss": False, "laser_ahead_m": 0.0}
    scenario = Scenario(manoeuvre="stop", rate_hz=4000.0, **numbers)
    recording = make_taken(scenario).recording
    sound = floatref.process(recording, pipeline)
    z = replace_elevations(recording, sound, elevations).track("left").elevation
    difference = z - sound.track("left").elevation
    assert np.nanstd(difference) < 1e-4
    assert np.nanmax(np.abs(difference)) < 5e-4
