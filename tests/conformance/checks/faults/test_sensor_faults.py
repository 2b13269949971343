"""Every injury does what it says, where and as long as it says, and nothing else."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.checks.faults.augmented_faults import AUGMENTED
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS, fault_of, needs_of
from floatref_conformance.classes import Effort
from floatref_conformance.proving_ground.scenario import Scenario

STEADY = Scenario(length_m=560.0, rate_hz=1000.0)
STOP = Scenario(length_m=560.0, rate_hz=1000.0, manoeuvre="stop", event_at_m=320.0)
SPEED, RATE = 20.0, 1000.0
FORCE, HEIGHT, DISTANCE = "vertical_specific_force", "height", "distance"
INJURED = {
    "laser": HEIGHT,
    "accelerometer": FORCE,
    "encoder": DISTANCE,
    "response-wheel": "unsprung_specific_force",
    "response-body": "sprung_specific_force",
    "response-deflection": "suspension_deflection",
}
NEEDED = {"laser": "height", "gnss": "gnss", "imu": "imu", "response": "response"}
NOMINAL = [c for c in FaultsCheck().cases(0, Effort.QUICK) if c.variation["fault"] not in AUGMENTED]
few = settings(
    deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def recording_of(right_bench, scenario=STEADY, augmented=False):
    return right_bench(augmented=augmented).simulate(scenario).recording


def faulty(recording, fault, **numbers):
    return SENSOR_FAULTS[fault](recording, {"at_m": 280.0, **numbers})


def samples(recording, name, track=None):
    return recording.channel(name, track).values


@pytest.mark.parametrize("case", NOMINAL, ids=lambda c: c.name)
def test_only_what_is_named_is_injured_and_only_there(right_bench, case):
    fault = case.variation["fault"]
    before = recording_of(right_bench, case.scenario, augmented=True)
    hurt = fault_of(case.variation)(before, case.variation)
    if fault == "gap-in-time":
        return
    named = [name for part, name in INJURED.items() if fault.startswith(part)]
    for one, other in zip(before.channels, hurt.recording.channels, strict=True):
        same = (one.values == other.values).all()
        touched = fault == "gap" or (one.id.name in named and one.id.track in (None, "left"))
        assert same != touched
        assert other.clock is one.clock


@few
@given(length_s=st.floats(0.0, 2.0), at_m=st.floats(230.0, 330.0))
def test_a_dropout_is_as_long_as_it_says_and_one_sample_at_least(right_bench, length_s, at_m):
    before = recording_of(right_bench)
    hurt = faulty(before, "laser-dropout", length_s=length_s, at_m=at_m)
    lost = np.flatnonzero(np.isnan(samples(hurt.recording, HEIGHT, "left")))
    assert lost.size == pytest.approx(max(length_s * RATE, 1.0), abs=1.0)
    assert (np.diff(lost) == 1).all()
    assert samples(before, DISTANCE)[lost[0]] == pytest.approx(at_m, abs=SPEED / RATE)
    assert hurt.extent_m == pytest.approx(SPEED * length_s, abs=0.05)


def test_a_flickering_laser_loses_so_many_stretches(right_bench):
    hurt = faulty(recording_of(right_bench), "laser-flicker", length_s=0.005, count=12, span_m=30.0)
    lost = np.isnan(samples(hurt.recording, HEIGHT, "left"))
    assert np.sum(np.diff(lost.astype(int)) == 1) == 12
    assert lost.sum() == pytest.approx(60, abs=12)
    assert hurt.extent_m == 30.0


def test_a_stuck_laser_repeats_itself_and_one_out_of_range_is_pinned(right_bench):
    before = recording_of(right_bench)
    heights = samples(before, HEIGHT, "left")
    stuck = samples(faulty(before, "laser-stuck", length_s=0.4).recording, HEIGHT, "left")
    changed = np.flatnonzero(stuck != heights)
    assert set(stuck[changed]) == {heights[changed[0] - 1]}
    assert changed.size == pytest.approx(400, abs=2)
    for side, end in ((1.0, heights.max() + 0.05), (-1.0, heights.min() - 0.05)):
        hurt = faulty(before, "laser-out-of-range", length_s=0.1, side=side)
        pinned = samples(hurt.recording, HEIGHT, "left")
        assert set(pinned[pinned != heights]) == {end}


def test_a_saturated_accelerometer_is_at_its_full_scale(right_bench):
    before = recording_of(right_bench)
    hurt = faulty(before, "accelerometer-saturation", length_s=0.008, full_scale_g=-4.0)
    forces = samples(hurt.recording, FORCE, "left")
    changed = forces != samples(before, FORCE, "left")
    assert changed.sum() == pytest.approx(8, abs=1)
    assert set(forces[changed]) == {-4.0 * 9.80665}


def test_a_gap_is_in_all_channels_at_once(right_bench):
    before = recording_of(right_bench, augmented=True)
    missing = faulty(before, "gap", length_s=0.5).recording
    absent = faulty(before, "gap-in-time", length_s=0.5).recording
    spans = []
    for one, two, three in zip(before.channels, missing.channels, absent.channels, strict=True):
        lost = np.isnan(two.values)
        spans.append((one.times_s[lost][0], one.times_s[lost][-1]))
        np.testing.assert_array_equal(three.values, two.values[~lost])
        np.testing.assert_array_equal(three.times_s, one.times_s[~lost])
    begins, ends = np.array(spans).T
    assert np.ptp(begins) <= 0.05
    assert np.ptp(ends) <= 0.05


@few
@given(size_m=st.floats(0.1, 3.0))
def test_a_leap_adds_to_all_that_follows(right_bench, size_m):
    before = recording_of(right_bench)
    hurt = faulty(before, "encoder-leap", size_m=size_m)
    added = samples(hurt.recording, DISTANCE) - samples(before, DISTANCE)
    first = int(np.argmax(added > 0))
    np.testing.assert_allclose(added[first:], size_m, atol=1e-12)
    assert not added[:first].any()
    assert (hurt.shift_m, hurt.extent_m) == (size_m, 0.0)


@few
@given(length_s=st.floats(0.05, 1.0))
def test_silence_is_made_up_for_and_lost_counts_are_not(right_bench, length_s):
    before = recording_of(right_bench)
    true = samples(before, DISTANCE)
    silent = samples(faulty(before, "encoder-silence", length_s=length_s).recording, DISTANCE)
    hurt = faulty(before, "encoder-lost-counts", length_s=length_s)
    lost = samples(hurt.recording, DISTANCE)
    assert silent[-1] == true[-1]
    held = np.flatnonzero(silent != true)
    assert held.size == pytest.approx(length_s * RATE, abs=2)
    assert np.ptp(silent[held]) == 0.0
    np.testing.assert_array_equal(lost[held], silent[held])
    assert lost[-1] - true[-1] == pytest.approx(-SPEED * length_s, abs=0.05)
    assert hurt.shift_m == pytest.approx(lost[-1] - true[-1], abs=0.05)
    assert (np.diff(lost) >= 0).all()


def test_counts_go_back_and_are_right_again(right_bench):
    before = recording_of(right_bench)
    hurt = faulty(before, "encoder-counts-back", count=4, size_m=0.03)
    change = samples(hurt.recording, DISTANCE) - samples(before, DISTANCE)
    assert sorted(np.unique(np.round(change, 9))) == [-0.03, 0.0]
    assert np.sum(change < 0) == 4


def test_a_vehicle_rolls_back_where_it_stands(right_bench):
    before = recording_of(right_bench, STOP)
    hurt = faulty(before, "encoder-rolling-back", size_m=0.3)
    true, counted = (samples(r, DISTANCE) for r in (before, hurt.recording))
    rolled = counted != true
    assert np.ptp(true[rolled]) == pytest.approx(0.0, abs=1e-6)
    assert (true - counted).max() == pytest.approx(0.3, rel=1e-3)
    assert np.abs(np.diff(counted)).max() < 0.03
    assert hurt.at_m == pytest.approx(320.0)


def test_a_variation_names_a_fault_and_its_numbers(right_bench):
    with pytest.raises(InputError, match="variation fault 'fire': unknown; known: laser-dropout"):
        fault_of({"fault": "fire"})
    with pytest.raises(InputError, match="variation length_s is None; give a number"):
        faulty(recording_of(right_bench), "laser-dropout")


@pytest.mark.parametrize("fault", SENSOR_FAULTS)
def test_faults_need_the_sensor_that_they_are_named_after_unless_every_device_has_it(fault):
    part = fault.partition("-")[0]
    assert needs_of(fault) == ({NEEDED[part]} if part in NEEDED else set())


@few
@given(length_s=st.floats(0.1, 1.0))
def test_a_stuck_wheel_repeats_itself_and_the_other_one_goes_on(right_bench, length_s):
    name = INJURED["response-wheel"]
    before = recording_of(right_bench, augmented=True)
    hurt = faulty(before, "response-wheel-stuck", length_s=length_s).recording
    read = samples(hurt, name, "left")
    changed = np.flatnonzero(read != samples(before, name, "left"))
    assert set(read[changed]) == {read[changed[0] - 1]}
    assert changed.size == pytest.approx(RATE * length_s, abs=2)
    np.testing.assert_array_equal(samples(hurt, name, "right"), samples(before, name, "right"))
