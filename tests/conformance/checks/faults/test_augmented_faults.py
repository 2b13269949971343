"""Injuries of inertial units and receivers do what they say, where and as long as they say."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.faults.augmented_faults import AUGMENTED
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.faults.sensor_faults import SENSOR_FAULTS
from floatref_conformance.classes import Effort
from floatref_conformance.devices.interface import CAPABILITIES
from floatref_conformance.proving_ground.scenario import Scenario

STEADY = Scenario(length_m=560.0, rate_hz=1000.0)
SPEED, AT_M = 20.0, 280.0
CASES = [c for c in FaultsCheck().cases(0, Effort.QUICK) if c.variation["fault"] in AUGMENTED]
RATES = {"roll_rate", "pitch_rate", "yaw_rate"}
HEIGHT, WORSE = frozenset({"gnss_height"}), frozenset({"gnss_height", "gnss_quality"})
INJURED = {
    **dict.fromkeys(("gnss-outage", "gnss-outage-at-a-stop"), CAPABILITIES["gnss"]),
    **dict.fromkeys(("gnss-wrong-fix", "gnss-float", "gnss-never-fixed"), WORSE),
    **dict.fromkeys(("gnss-jump", "gnss-stuck"), HEIGHT),
    "imu-gyro-gap": RATES,
    "imu-flicker": CAPABILITIES["imu"],
}
few = settings(
    deadline=None, max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@pytest.fixture
def before(right_bench):
    return right_bench(augmented=True).simulate(STEADY).recording


def faulty(recording, fault, **numbers):
    return AUGMENTED[fault](recording, {"at_m": AT_M, **numbers})


def change(before, hurt, name):
    """Times, difference and injured samples of a channel."""
    one, other = (r.channel(name) for r in (before, hurt.recording))
    return one.times_s, other.values - one.values, other.values


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_what_is_named_is_injured_and_nothing_else(right_bench, case):
    fault = case.variation["fault"]
    before = right_bench(augmented=True).simulate(case.scenario).recording
    hurt = SENSOR_FAULTS[fault](before, case.variation).recording
    changed = {
        one.id.name
        for one, other in zip(before.channels, hurt.channels, strict=True)
        if not np.array_equal(one.values, other.values)
    }
    assert changed == INJURED[fault]
    assert all(a.clock is b.clock for a, b in zip(before.channels, hurt.channels, strict=True))


@few
@given(length_s=st.floats(1.0, 6.0), size_m=st.floats(0.1, 3.0))
def test_a_receiver_without_a_fix_or_with_a_worse_one_says_so(before, length_s, size_m):
    numbers = {"length_s": length_s, "size_m": size_m}
    out, wrong, free = (
        faulty(before, fault, **numbers)
        for fault in ("gnss-outage", "gnss-wrong-fix", "gnss-float")
    )
    lost = np.isnan(out.recording.channel("gnss_height").values)
    assert lost.sum() == pytest.approx(20.0 * length_s, abs=1.0)
    assert out.extent_m == pytest.approx(SPEED * length_s, abs=0.05)
    for hurt, quality in ((out, 0.0), (wrong, 1.0), (free, 5.0)):
        read = hurt.recording.channel("gnss_quality").values
        assert set(read[lost]) == {quality}
        assert set(read[~lost]) == {4.0}
    np.testing.assert_allclose(change(before, wrong, "gnss_height")[1][lost], size_m)
    wander = change(before, free, "gnss_height")[1]
    assert wander.max() == pytest.approx(size_m, rel=0.05)
    assert np.abs(np.diff(wander)).max() < 0.2 * size_m
    assert not wander[~lost].any()


@few
@given(size_m=st.floats(-3.0, 3.0).filter(lambda x: abs(x) > 0.01))
def test_a_jump_stays_and_the_quality_knows_nothing(before, size_m):
    hurt = faulty(before, "gnss-jump", size_m=size_m)
    times, step, _ = change(before, hurt, "gnss_height")
    np.testing.assert_allclose(step[times >= AT_M / SPEED + 0.05], size_m)
    assert not step[times < AT_M / SPEED - 0.05].any()
    assert hurt.extent_m == pytest.approx(0.0, abs=0.05)


@few
@given(length_s=st.floats(1.0, 6.0))
def test_a_stuck_height_repeats_itself_as_if_it_were_measured(before, length_s):
    hurt = faulty(before, "gnss-stuck", length_s=length_s)
    times, _, heights = change(before, hurt, "gnss_height")
    during = (times > AT_M / SPEED + 0.06) & (times < AT_M / SPEED + length_s - 0.06)
    assert np.ptp(heights[during]) == 0.0
    assert during.sum() > 10


@few
@given(size_m=st.floats(0.1, 3.0))
def test_a_receiver_that_is_never_fixed_wanders_and_excuses_nothing(before, size_m):
    hurt = faulty(before, "gnss-never-fixed", size_m=size_m)
    assert set(hurt.recording.channel("gnss_quality").values) == {5.0}
    wander = change(before, hurt, "gnss_height")[1]
    assert np.abs(wander).max() == pytest.approx(size_m, rel=0.05)
    assert hurt.extent_m == 0.0


@few
@given(length_s=st.floats(0.1, 1.0))
def test_gyros_are_lost_together(before, length_s):
    hurt = faulty(before, "imu-gyro-gap", length_s=length_s)
    lost = [np.isnan(change(before, hurt, name)[2]) for name in sorted(RATES)]
    assert lost[0].sum() == pytest.approx(100.0 * length_s, abs=1.0)
    assert (lost[0] == lost[1]).all()
    assert (lost[0] == lost[2]).all()
    assert hurt.extent_m == pytest.approx(SPEED * length_s, abs=0.05)


@few
@given(count=st.integers(5, 30))
def test_an_inertial_unit_flickers_by_single_samples(before, count):
    hurt = faulty(before, "imu-flicker", count=count, span_m=60.0)
    for name in CAPABILITIES["imu"]:
        lost = np.flatnonzero(np.isnan(change(before, hurt, name)[2]))
        assert lost.size == count
        assert np.diff(lost).min() > 1
    assert hurt.extent_m == 60.0


@pytest.mark.parametrize("fault", AUGMENTED)
def test_without_the_sensor_nothing_changes(right_bench, fault):
    numbers = {"length_s": 3.0, "size_m": 1.0, "count": 3, "span_m": 10.0}
    plain = right_bench().simulate(STEADY).recording
    assert faulty(plain, fault, **numbers).recording is plain
