"""Every drive that may be asked for can be driven, fits its road and reads well."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.driving import strategies
from floatref_conformance.checks.driving.check import driving_checks
from floatref_conformance.checks.driving.layout import (
    ABRUPT,
    BUMP_REACH_M,
    END_M,
    layout_of,
    place,
)
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.proving_ground.drives.runs import KMH
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.staging import drive_of

FIRST, SECOND = (find_edition(name) for name in ("2026.1", "2026.2"))
DRAWS = settings(
    deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def simplest(strategy):
    """Return what Hypothesis starts with, which is what it shrinks to."""
    found = []

    @settings(database=None, max_examples=1, phases=[Phase.generate])
    @given(strategy)
    def first(value):
        found.append(value)

    first()
    return found[0]


@pytest.fixture(params=[FIRST, SECOND], ids=lambda edition: edition.name)
def edition(request):
    return request.param


@pytest.fixture(params=driving_checks(find_edition()))
def drives(request, edition):
    return strategies.drives(request.param, edition)


@pytest.mark.slow
@given(data=st.data())
@DRAWS
def test_a_drive_is_possible_and_what_is_scored_lies_far_from_its_ends(drives, data):
    scenario = data.draw(drives)
    drive, layout = drive_of(scenario), layout_of(scenario)
    assert drive.length_m >= scenario.length_m - 1e-6
    for start, end in layout.stretches:
        assert end - start == pytest.approx(160.9)
        assert start >= END_M
        assert end <= scenario.length_m - END_M


@pytest.mark.slow
@given(data=st.data())
@DRAWS
def test_the_bump_lies_in_no_scored_stretch_and_ahead_of_every_brake_or_at_its_event(
    drives, data, edition
):
    scenario = data.draw(drives)
    if edition is SECOND and scenario.manoeuvre in ABRUPT:
        assert scenario.bump_at_m == scenario.event_at_m
        return
    first, last = scenario.bump_at_m - BUMP_REACH_M, scenario.bump_at_m + BUMP_REACH_M
    assert all(last <= start or end <= first for start, end in layout_of(scenario).stretches)
    drive = drive_of(scenario)
    motion = drive.motion(np.linspace(0.0, drive.duration_s, 4000))
    near = (motion.distance > first - 10.0) & (motion.distance < last + 10.0)
    if scenario.manoeuvre not in ("creeping", "dead-start"):
        assert np.ptp(motion.speed[near]) < 1e-9


@pytest.mark.slow
@given(data=st.data())
@DRAWS
def test_numbers_are_rounded_and_make_the_same_case_again(drives, data):
    case = Case("any", data.draw(drives))
    assert Case.of("any", case.parameters) == case
    values = [v for v in case.parameters["scenario"].values() if isinstance(v, float)]
    assert all(value == round(value, 5) for value in values)


@pytest.mark.slow
@given(data=st.data())
@DRAWS
def test_speeds_stay_on_their_side_of_16_km_per_h(edition, data):
    slow = data.draw(strategies.drives("low-speed", edition))
    fast = data.draw(strategies.drives("constant-speed", edition))
    assert drive_of(slow).knot_speeds_mps.max() < 16 * KMH
    assert drive_of(fast).knot_speeds_mps.min() > 16 * KMH
    released = data.draw(strategies.drives("braking", edition)).event_speed_kmh
    assert released == 15.0 or released >= 17.0


@given(data=st.data())
@DRAWS
def test_no_brake_of_the_first_edition_is_released_within_a_second_of_a_standstill(data):
    brake = data.draw(strategies.drives("braking", FIRST))
    assert brake.event_speed_kmh / 3.6 >= 9.80665 * brake.deceleration_g * 1.1
    assert 0.05 <= brake.deceleration_g <= 0.84


@given(st.floats(15.0, 60.0), st.floats(0.5, 2.0))
@DRAWS
def test_the_hardest_release_stands_that_much_later_and_without_a_time_has_no_bound(kmh, soonest_s):
    hardest = strategies.hardest_release_g(kmh, soonest_s)
    stands_s = kmh / 3.6 / 9.80665 / hardest
    assert soonest_s <= stands_s <= kmh / 3.6 / 9.80665 / (hardest - 0.01)
    assert strategies.hardest_release_g(kmh, 0.0) == np.inf


@pytest.mark.parametrize(
    ("edition", "corners"),
    [
        (FIRST, [(100.0, 15.0, 0.05), (100.0, 60.0, 0.84), (30.0, 15.0, 0.38)]),
        (SECOND, [(100.0, 15.0, 0.05), (100.0, 60.0, 0.84), (100.0, 15.0, 0.84)]),
    ],
)
def test_the_corners_of_braking_are_in_its_domain(edition, corners):
    soonest_s = edition.document["drives"]["soonest_stand_s"]
    for speed, released, g in corners:
        numbers = {"manoeuvre": "braking", "speed_kmh": speed, "event_speed_kmh": released}
        assert strategies.hardest_release_g(released, soonest_s) >= g
        layout_of(place(edition.make_scenario(**numbers, deceleration_g=g), edition))


@pytest.mark.slow
@given(data=st.data())
@DRAWS
def test_what_the_edition_draws_is_drawn_for_every_drive_and_shapes_lie_at_the_event(
    drives, data, edition
):
    scenario = data.draw(drives)
    if edition is FIRST:
        assert (scenario.slip_percent_per_g, scenario.laser_ahead_m) == (0.3, 0.0)
        assert scenario.crown_mm == scenario.break_percent == 0.0
        return
    assert 3.0 <= scenario.slip_percent_per_g <= 12.0
    assert -0.3 <= scenario.laser_ahead_m <= 0.3
    assert not (scenario.crown_mm and scenario.break_percent)
    start, end = layout_of(scenario).stretches[0]
    for size, at_m in (
        (scenario.crown_mm, scenario.crown_at_m),
        (scenario.break_percent, scenario.break_at_m),
    ):
        assert not size or at_m == pytest.approx(start + 96.0)
        assert not size or start < at_m < end


def test_the_simplest_drive_of_each_is_on_the_default_road(drives, edition):
    scenario, default = simplest(drives), edition.make_scenario()
    names = ("seed", "road", "vehicle", "iri_m_per_km", "profile_interval_m")
    for name in (*names, "grade_percent", "cross_slope_percent", "curvature_per_km", "stops"):
        assert getattr(scenario, name) == getattr(default, name)


@given(st.integers(-40, 40), st.integers(0, 80), st.sampled_from([0.01, 0.1, 0.5, 10.0]), st.data())
@DRAWS
def test_a_number_is_a_whole_count_of_steps_from_the_simplest_within_its_limits(
    first, count, step, data
):
    low, high = round(first * step, 6), round((first + count) * step, 6)
    value = data.draw(strategies.number(low, high, step))
    assert low <= value <= high
    assert value / step == pytest.approx(round(value / step), abs=1e-6)


@pytest.mark.parametrize(
    ("low", "high", "simple"), [(4.0, 9.0, 4.0), (-9.0, -2.0, -2.0), (-3.0, 3.0, 0.0)]
)
def test_a_number_shrinks_to_the_simplest_one_that_is_allowed(low, high, simple):
    assert simplest(strategies.number(low, high, 0.5)) == simple
    assert simplest(strategies.number(-20.0, 20.0, 0.5, 7.5)) == 7.5


@pytest.mark.slow
@given(data=st.data())
@DRAWS
def test_placing_a_placed_drive_changes_nothing(drives, data, edition):
    scenario = data.draw(drives)
    assert place(scenario, edition) == scenario


@pytest.mark.parametrize(
    "change", [{"length_m": 480.0}, {"event_at_m": 200.0}, {"bump_mm": 20.0, "bump_at_m": 108.0}]
)
def test_a_drive_without_room_for_what_is_scored_is_refused(change):
    with pytest.raises(InputError, match="must lie 106 m from its ends"):
        layout_of(Scenario(**{"manoeuvre": "stop", **change}))


@pytest.mark.slow
def test_hypothesis_is_imported_only_when_a_strategy_is_asked_for():
    code = (
        "import sys; import floatref_conformance.checks.driving.strategies;"
        "sys.exit('hypothesis' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
