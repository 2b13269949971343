"""The check reads what was not flagged and should have been, and what was and should not."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.profile import ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS, needs_of
from floatref_conformance.checks.interface import fit_check
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.devices.builtin import process_with_warnings
from floatref_conformance.judge import oracle
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import drive_of

NOMINAL = DeviceClass.NOMINAL
QUICK = {case.variation["fault"]: case for case in FaultsCheck().cases(0, Effort.QUICK)}
LASER = QUICK["laser-dropout"]
AT_M = LASER.variation["at_m"]
RECOMMENDED = (
    "temporal-adaptive-hpf-spatial-backward",
    "spatial-hpf-timer-distortion-reflection",
)
few = settings(
    deadline=None, max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def judged(case, bench, track="left"):
    return {m.quantity: m for m in FaultsCheck().judge(case, bench) if m.track == track}


def changed(profile, change, label="with the fault"):
    """Return what changes x, elevation and validity of every track in runs of ``label``."""

    def track(t):
        elevation, valid = change(profile.distance_m, np.array(t.elevation), np.array(t.valid))
        return ProfileTrack.of(t.name, elevation, valid)

    return replace(profile, tracks=tuple(track(t) for t in profile.tracks))


def spoiling(change, label="with the fault"):
    return lambda said, profile: changed(profile, change) if said == label else profile


@pytest.mark.slow
@pytest.mark.parametrize("case", QUICK.values(), ids=lambda c: c.name)
def test_a_right_device_need_flag_nothing(right_bench, case):
    measured = FaultsCheck().judge(case, right_bench(augmented=True))
    assert {m.quantity for m in measured} <= FaultsCheck().limits.keys()
    assert {m.track for m in measured} == {"left", "right"}
    assert max(m.ratio(DeviceClass.REFERENCE) for m in measured) < 0.6


@pytest.mark.slow
@few
@given(before_m=st.floats(0.0, 60.0), behind_m=st.floats(21.0, 90.0))
def test_what_is_flagged_beyond_the_fault_is_read(right_bench, before_m, behind_m):
    def flag(x, z, valid):
        return z, valid & ((x < AT_M - before_m) | (x > AT_M + behind_m))

    found = judged(LASER, right_bench(spoiling(flag)))["flagged beyond a fault: laser"]
    extent_m = LASER.scenario.speed_kmh / 3.6 * LASER.variation["length_s"]
    assert found.value == pytest.approx(before_m + behind_m - extent_m, abs=0.1)


def test_what_is_flagged_without_the_fault_too_is_not_its_doing(right_bench):
    def flag(x, z, valid):
        return z, valid & (np.abs(x - AT_M) > 50.0)

    bench = right_bench(lambda _, profile: changed(profile, flag))
    found = judged(LASER, bench)
    assert found["flagged beyond a fault: laser"].value == 0.0
    assert found["flagged elsewhere"].value == pytest.approx(100.0, abs=0.1)
    assert found["flagged elsewhere"].limits[NOMINAL] == 10.0


@pytest.mark.slow
@pytest.mark.parametrize("case", QUICK.values(), ids=lambda c: c.name)
def test_the_middle_of_a_run_is_flagged_for_a_stop_alone(right_bench, case):
    def flag(x, z, valid):
        return z, valid & (np.abs(x - 300.0) > 50.0)

    measured = FaultsCheck().judge(case, right_bench(lambda _, p: changed(p, flag), augmented=True))
    fails = max(m.ratio(NOMINAL) for m in measured) > 1.0
    assert fails == (case.scenario.manoeuvre != "stop")


@pytest.mark.slow
@few
@given(height_mm=st.floats(1.0, 20.0), at_m=st.floats(150.0, 400.0))
def test_what_is_wrong_counts_unless_it_is_flagged(right_bench, height_mm, at_m):
    def wrong(x, z, valid):
        return z + height_mm / 1000.0 * np.exp(-(((x - at_m) / 0.8) ** 2)), valid

    def flagged(x, z, valid):
        return wrong(x, z, valid)[0], valid & (np.abs(x - at_m) > 3.0)

    said = judged(LASER, right_bench(spoiling(wrong)))["local error, unflagged"]
    hidden = judged(LASER, right_bench(spoiling(flagged)))["local error, unflagged"]
    assert said.value > 0.2 * height_mm
    assert hidden.value < 0.01 * said.value
    doubled = judged(LASER, right_bench(spoiling(lambda *a: (2 * wrong(*a)[0] - a[1], a[2]))))
    assert doubled["local error, unflagged"].value == pytest.approx(2 * said.value, rel=1e-6)


@pytest.mark.slow
@few
@given(gain=st.floats(0.8, 1.2))
def test_the_roughness_of_what_is_vouched_for_is_read(right_bench, gain):
    error, true = (
        judged(LASER, right_bench(spoiling(lambda x, z, valid, by=by: (by * z, valid))))[
            "IRI error, unflagged"
        ].value
        for by in (gain, 0.0)
    )
    assert error == pytest.approx(abs(gain - 1.0) * true, rel=0.02, abs=1e-3)


@pytest.mark.slow
def test_the_reference_measures_the_same(right_bench):
    found = judged(LASER, right_bench(spoiling(lambda x, z, valid: (1.2 * z, valid))))
    for measurement in found.values():
        oracle.confirm("faults", measurement)


@pytest.mark.parametrize("wrong", ["flat", "flagged"])
def test_a_profile_that_says_nothing_fails(right_bench, wrong):
    def empty(x, z, valid):
        return (z * 0.0, valid) if wrong == "flat" else (z, np.zeros_like(valid))

    measured = FaultsCheck().judge(LASER, right_bench(lambda _, profile: changed(profile, empty)))
    assert max(m.ratio(NOMINAL) for m in measured) > 1.0


@pytest.mark.slow
@few
@given(flagged_m=st.floats(1.0, 120.0), untold=st.integers(0, 20))
def test_of_what_is_flagged_at_an_end_nothing_is_what_the_encoder_did_not_tell(
    right_bench, flagged_m, untold
):
    def short(label, profile):
        size = profile.distance_m.size - untold
        count = round(flagged_m / profile.interval_m)
        tracks = tuple(
            ProfileTrack.of(t.name, t.elevation[:size], np.arange(size) < size - count)
            for t in profile.tracks
        )
        return replace(profile, tracks=tracks)

    found = judged(QUICK["laser-dropout"], right_bench(short))["flagged at an end"]
    assert found.value == pytest.approx(flagged_m, abs=0.013)


@pytest.mark.parametrize("fault", ["encoder-leap", "encoder-lost-counts"])
def test_metres_told_in_error_are_taken_out(right_bench, fault):
    bench = right_bench()
    lengths = []
    bench.spoil = lambda _, profile: lengths.append(profile.length_m) or profile
    found = judged(QUICK[fault], bench)
    assert abs(lengths[0] - lengths[1]) > 0.5
    assert found["local error, unflagged"].value < 0.5


def test_the_fault_comes_first(right_bench):
    bench = right_bench()
    FaultsCheck().judge(LASER, bench)
    assert bench.labels == ["with the fault", "without the fault"]


@pytest.mark.parametrize(
    ("fault", "needed"),
    [("gnss-outage", "gnss"), ("imu-flicker", "imu"), ("response-wheel-stuck", "response")],
)
def test_a_fault_of_a_sensor_needs_it(right_bench, fault, needed):
    without = right_bench()
    with pytest.raises(InputError, match=f"variation fault {fault}: needs {needed}, which"):
        FaultsCheck().judge(QUICK[fault], without)
    assert without.labels == []


@pytest.mark.parametrize("effort", list(Effort))
@pytest.mark.parametrize(
    "having",
    [
        ("height",),
        ("height", "imu"),
        ("height", "imu", "gnss"),
        ("height", "response"),
        ("response",),
        ("response", "gnss"),
    ],
)
def test_faults_of_sensors_that_a_device_lacks_are_no_cases_and_all_others_stay(effort, having):
    lacking = {"imu", "gnss", "response", "height"} - set(having)
    assert fit_check(FaultsCheck(), having).cases(1, effort) == tuple(
        case
        for case in FaultsCheck().cases(1, effort)
        if case.variation["fault"].split("-")[0].replace("laser", "height") not in lacking
    )


@settings(deadline=None, max_examples=60)
@given(case=fit_check(FaultsCheck(), ("imu", "response")).strategy())
def test_what_a_device_lacks_is_not_searched_for(case):
    assert not case.variation["fault"].startswith(("gnss", "laser"))


@pytest.mark.parametrize("having", [("height",), ("response",), ("height", "response")])
def test_the_simplest_case_is_one_of_a_sensor_that_the_device_has(having):
    check = fit_check(FaultsCheck(), having)
    assert needs_of(check.simplest.variation["fault"]) <= set(having)


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(case=FaultsCheck().strategy())
def test_whatever_is_drawn_is_a_drive_and_a_fault(case):
    assert Case.of("faults", case.parameters) == case
    assert case.variation["fault"] in SENSOR_FAULTS
    assert drive_of(case.scenario).length_m == pytest.approx(560.0)


@pytest.mark.slow
@pytest.mark.parametrize("pipeline", RECOMMENDED)
@pytest.mark.parametrize(
    "scenario",
    [
        Scenario(manoeuvre="quiescent", rate_hz=4000.0),
        Scenario(manoeuvre="bounce", rate_hz=16000.0, tracks=("left",)),
        Scenario(manoeuvre="stop", rate_hz=4000.0, dwell_s=8.0, deceleration_g=0.6),
        Scenario(manoeuvre="braking", deceleration_g=0.84, rate_hz=8000.0, tracks=("left",)),
        Scenario(rate_hz=4000.0, sensors=0.0, bump_mm=80.0, bump_at_m=200.0, iri_m_per_km=6.0),
    ],
    ids=lambda s: s.manoeuvre,
)
def test_the_recommended_pipelines_find_no_damage_in_sound_sensors(pipeline, scenario):
    recording = simulate(replace(scenario, imu=False, gnss=False)).recording
    assert process_with_warnings(recording, pipeline)[1] == ()
