"""What a check says that it scores is what it judges: within it every point counts."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.values.profile import ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving.check import driving_checks
from floatref_conformance.checks.faults.check import FaultsCheck
from floatref_conformance.checks.sameness.invariance import InvarianceCheck
from floatref_conformance.classes import Effort
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.plugins import load_registry
from floatref_conformance.proving_ground.scenario import STATIONARY, Scenario
from floatref_conformance.render.places import join_stretches

STOP = driving_checks(find_edition())["stop"]
INSIDE_M, OUTSIDE_M = 0.1, 5.0
"""The lasers of `repeatability` lie up to 2 m from where the vehicle is said to be."""
WHOLE = [id_ for id_ in load_registry().checks if id_ not in (*STATIONARY, "faults")]


def edges(check, case):
    """Return distances within each end of what is scored, and without, where no bump lies."""
    scored = join_stretches(check.list_scored(case))
    within = [x for a, b in scored for x in (a + INSIDE_M, b - INSIDE_M)]
    return within, [x for a, b in scored for x in (a - OUTSIDE_M, b + OUTSIDE_M)]


def asked_for(check, case, bench_of, at_m):
    """Return whether the check can do without an elevation at ``at_m``."""

    def blank(label, profile):
        point = round((at_m - profile.start_m) / profile.interval_m)
        gone = np.arange(profile.distance_m.size) == point
        tracks = tuple(
            ProfileTrack.of(t.name, np.where(gone, np.nan, t.elevation), ~gone)
            for t in profile.tracks
        )
        return replace(profile, tracks=tracks)

    try:
        measured = check.judge(case, bench_of(blank))
    except DeviceError:
        return True
    return any(np.isnan(m.value) for m in measured)


def slow(case):
    """Return the case with as few samples as a recording may have."""
    return replace(case, scenario=replace(case.scenario, rate_hz=1000.0))


@pytest.mark.slow
@pytest.mark.parametrize("id_", WHOLE)
def test_a_point_without_elevation_counts_within_what_is_scored_alone(right_bench, id_):
    check = load_registry().checks[id_]
    case = slow(check.cases(1, Effort.QUICK)[0])
    within, without = edges(check, case)
    assert [asked_for(check, case, right_bench, x) for x in within] == [True] * len(within)
    assert [asked_for(check, case, right_bench, x) for x in without] == [False] * len(without)


def test_every_stop_of_several_has_its_stretch(right_bench):
    case = slow(STOP.cases(1, Effort.QUICK)[3])
    assert case.scenario.stops == len(STOP.list_scored(case)) == 3
    within, without = edges(STOP, case)
    assert all(asked_for(STOP, case, right_bench, x) for x in within)
    assert not any(asked_for(STOP, case, right_bench, x) for x in without)


def test_of_a_recording_that_begins_later_what_counts_begins_later(right_bench):
    constant = slow(InvarianceCheck().simplest)
    later = replace(constant, variation={"change": "later-start", "samples": 1500})
    ((start, end),), ((first, last),) = map(InvarianceCheck().list_scored, (later, constant))
    assert (start, end) == pytest.approx((first + 1.5 * 20.0, last))
    assert asked_for(InvarianceCheck(), later, right_bench, start + INSIDE_M)
    assert not asked_for(InvarianceCheck(), later, right_bench, start - OUTSIDE_M)


def test_a_stop_that_is_compared_has_both_its_stretches(right_bench):
    longer = next(
        case
        for case in InvarianceCheck().cases(1, Effort.QUICK)
        if "stop" in case.variation["change"]
    )
    within, without = edges(InvarianceCheck(), slow(longer))
    assert len(within) == 4
    assert all(asked_for(InvarianceCheck(), slow(longer), right_bench, x) for x in within)
    assert not any(asked_for(InvarianceCheck(), slow(longer), right_bench, x) for x in without)


def test_of_a_fault_every_point_of_the_drive_counts_that_is_vouched_for(right_bench):
    case = slow(FaultsCheck().simplest)
    ((start, end),) = FaultsCheck().list_scored(case)

    def lifted(at_m):
        """Return what is measured of a device that is wrong at one place."""

        def lift(label, profile):
            near = np.abs(profile.distance_m - at_m) < 1.0
            tracks = tuple(
                ProfileTrack.of(t.name, t.elevation + 0.01 * near) for t in profile.tracks
            )
            return replace(profile, tracks=tracks)

        measured = FaultsCheck().judge(case, right_bench(lift))
        return max(m.value for m in measured if m.quantity == "IRI error, unflagged")

    assert lifted(end + 10.0) < 1e-9
    assert all(lifted(x) > 0.01 for x in (start + 2.0, (start + end) / 2.0, end - 2.0))


def test_numbers_that_leave_no_room_are_refused():
    with pytest.raises(InputError, match="must lie 106 m from its ends"):
        STOP.list_scored(Case("stop", Scenario(manoeuvre="stop", length_m=400.0)))
    with pytest.raises(InputError, match="variation samples is None"):
        InvarianceCheck().list_scored(Case("invariance", Scenario(), {"change": "later-start"}))
