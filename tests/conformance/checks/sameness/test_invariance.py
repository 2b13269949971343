"""The check reads what two results differ by, and nothing where they do not."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.values.profile import ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.interface import fit_check
from floatref_conformance.checks.sameness.changes import CHANGES
from floatref_conformance.checks.sameness.invariance import InvarianceCheck
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge import oracle
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of

QUICK = InvarianceCheck().cases(0, Effort.QUICK)
ALIKE = next(case for case in QUICK if case.variation["change"] == "clock-storage")
LONGER = next(case for case in QUICK if case.variation["change"] == "longer-stop")
DRIVEN_AGAIN = ("road-height", "sample-rate", "longer-stop", "gyro-rate", "slope")
few = settings(
    deadline=None, max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def scaled(profile, gain):
    tracks = tuple(ProfileTrack.of(t.name, gain * t.elevation, t.valid) for t in profile.tracks)
    return replace(profile, tracks=tracks)


def judged(case, bench):
    return {m.quantity: m for m in InvarianceCheck().judge(case, bench)}


@pytest.mark.slow
@pytest.mark.parametrize(
    "case", InvarianceCheck().cases(3, Effort.CERTIFICATION), ids=lambda c: c.name
)
def test_a_right_device_keeps_every_limit_of_every_case(right_bench, case):
    bench = right_bench(augmented=True)
    measured = InvarianceCheck().judge(case, bench)
    assert bench.labels == ["changed", "unchanged"]
    assert {m.quantity for m in measured} <= InvarianceCheck().limits.keys()
    assert max(m.ratio(DeviceClass.REFERENCE) for m in measured) < 0.3


@pytest.mark.slow
@few
@given(gain=st.floats(0.9, 1.1))
def test_another_height_is_read_as_a_difference_of_the_iri(right_bench, gain):
    bench = right_bench(lambda label, p: scaled(p, gain if label == "changed" else 1.0))
    measured = judged(ALIKE, bench)
    expected = 100.0 * abs(gain - 1.0)
    assert measured["IRI difference of both"].value == pytest.approx(expected, rel=0.01, abs=1e-3)
    assert measured["displacement between both"].value == 0.0


@pytest.mark.slow
@few
@given(points=st.integers(-19, 19))
def test_another_place_is_read_as_a_displacement(right_bench, points):
    def moved(label, profile):
        by_m = points * profile.interval_m if label == "changed" else 0.0
        return replace(profile, start_m=profile.start_m + by_m)

    measured = judged(ALIKE, right_bench(moved))
    assert measured["displacement between both"].value == pytest.approx(0.025 * abs(points))
    assert measured["correlation loss between both"].value == pytest.approx(0.0, abs=1e-3)


@pytest.mark.slow
@few
@given(share=st.floats(0.05, 0.4))
def test_another_shape_is_read_as_a_loss_of_correlation(right_bench, share):
    def other(label, profile):
        if label == "unchanged":
            return profile
        (track,) = profile.tracks
        mixed = (1 - share) * track.elevation + share * track.elevation[::-1]
        return replace(profile, tracks=(ProfileTrack.of(track.name, mixed),))

    measured = judged(ALIKE, right_bench(other))
    assert measured["correlation loss between both"].value > share / 2


def stop_error(right_bench, gain):
    """The error of the IRI at the stop, in m/km, from the limit that it sets."""
    measured = judged(LONGER, right_bench(lambda _, p: scaled(p, gain)))["rise of the IRI error"]
    assert measured.value == pytest.approx(0.0, abs=1e-6)
    return 10.0 * (measured.limits[DeviceClass.NOMINAL] - 0.1)


@pytest.mark.slow
@few
@given(first=st.floats(1.0, 1.5), more=st.floats(-0.3, 0.6))
def test_the_error_at_a_stop_may_rise_by_a_tenth_of_it(right_bench, first, more):
    gains = {"unchanged": first, "changed": first + more}
    rise = judged(LONGER, right_bench(lambda label, p: scaled(p, gains[label])))[
        "rise of the IRI error"
    ]
    per_gain = stop_error(right_bench, 2.0)
    before, after = (per_gain * abs(gain - 1.0) for gain in gains.values())
    assert rise.value == pytest.approx(max(after - before, 0.0), abs=1e-6)
    assert rise.limits[DeviceClass.NOMINAL] == pytest.approx(0.1 * before + 0.1)


@pytest.mark.slow
@pytest.mark.parametrize("case", [ALIKE, LONGER], ids=lambda c: c.name)
def test_the_reference_measures_the_same(right_bench, case):
    bench = right_bench(lambda label, p: scaled(p, 1.1 if label == "changed" else 1.0))
    measured = InvarianceCheck().judge(case, bench)
    assert max(m.ratio(DeviceClass.NOMINAL) for m in measured) > 1.0
    for measurement in measured:
        oracle.confirm("invariance", measurement)


@pytest.mark.parametrize("case", [ALIKE, LONGER], ids=lambda c: c.name)
def test_a_profile_that_shows_nothing_fails(right_bench, case):
    measured = InvarianceCheck().judge(case, right_bench(lambda _, p: scaled(p, 0.0)))
    assert max(m.ratio(DeviceClass.NOMINAL) for m in measured) > 1.0


def test_a_point_without_elevation_where_it_counts_is_the_devices_fault(right_bench):
    def holed(_, profile):
        (track,) = profile.tracks
        z = track.elevation.copy()
        z[z.size // 2] = np.nan
        return replace(profile, tracks=(ProfileTrack.of(track.name, z),))

    with pytest.raises(DeviceError, match=r"1 of .* points without elevation"):
        InvarianceCheck().judge(ALIKE, right_bench(holed))


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(case=InvarianceCheck().strategy())
def test_whatever_is_drawn_is_a_drive_and_a_change(case):
    assert Case.of("invariance", case.parameters) == case
    change = CHANGES[case.variation["change"]]
    changed = change.scenario(case.scenario, case.variation)
    assert drive_of(changed).length_m >= case.scenario.length_m - 1e-6
    assert isinstance(changed, Scenario)
    assert (changed != case.scenario) == (case.variation["change"] in DRIVEN_AGAIN)


@pytest.mark.parametrize(
    ("change", "needed"), [("gnss-datum", "gnss"), ("gyro-rate", "imu"), ("imu-bias", "imu")]
)
def test_a_change_of_a_sensor_needs_it(right_bench, change, needed):
    case = next(case for case in QUICK if case.variation["change"] == change)
    without = right_bench()
    with pytest.raises(InputError, match=f"variation change {change}: needs {needed}, which"):
        InvarianceCheck().judge(case, without)
    assert without.labels == []


@pytest.mark.parametrize("effort", list(Effort))
@pytest.mark.parametrize("having", [(), ("imu",), ("gnss",), ("imu", "gnss")])
def test_changes_of_what_a_device_lacks_are_no_cases_and_all_others_stay(effort, having):
    assert fit_check(InvarianceCheck(), having).cases(1, effort) == tuple(
        case
        for case in InvarianceCheck().cases(1, effort)
        if CHANGES[case.variation["change"]].needs <= set(having)
    )


@settings(deadline=None, max_examples=40)
@given(case=fit_check(InvarianceCheck(), ()).strategy())
def test_what_a_device_lacks_is_not_searched_for(case):
    assert not CHANGES[case.variation["change"]].needs
