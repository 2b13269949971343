"""The driving checks: their cases, and devices that must pass or fail them."""

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.conformance.checks.benches import OneRecording, follow_true_distance

import floatref
from floatref.errors import InputError
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.driving.check import driving_checks
from floatref_conformance.checks.driving.layout import layout_of
from floatref_conformance.checks.interface import Taken
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.editions.edition import find_edition
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.perfect import make_perfect
from floatref_conformance.proving_ground.simulate import simulate
from floatref_conformance.proving_ground.staging import drive_of

EDITIONS = tuple(find_edition(name) for name in ("2026.1", "2026.2"))
FIRST, SECOND = (driving_checks(edition) for edition in EDITIONS)
CHECKS = tuple(SECOND.values())
BOTH = tuple(check for edition in EDITIONS for check in driving_checks(edition).values())
STOP, NEAR_STOP = SECOND["stop"], SECOND["near-stop"]
RECOMMENDED = ("temporal-adaptive-hpf-spatial-backward", "spatial-hpf-timer-distortion-reflection")
NOMINAL, ADEQUATE, REFERENCE = DeviceClass
each = pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.id)
each_of_both = pytest.mark.parametrize(
    "check", BOTH, ids=lambda check: f"{check.id}-{check.edition.name}"
)


@pytest.fixture(scope="module")
def taken():
    """Return a function from checks to the recording of their simplest case, at 4 kHz."""
    made = {}

    def of(check):
        key = check.id, check.edition.name
        if key not in made:
            scenario = replace(check.simplest.scenario, rate_hz=4000.0, imu=False, gnss=False)
            simulated = simulate(scenario)
            made[key] = Taken(simulated.recording, simulated.truth, scenario)
        return made[key]

    return of


def failing(check, taken, device, device_class=NOMINAL):
    measured = check.judge(check.simplest, OneRecording(taken, device))
    return {m.quantity for m in measured if not m.within(device_class)}


def spoilt(change, valid=None):
    """Return a device that knows the truth, and gets ``change`` of it wrong."""

    def device(taken):
        known = make_perfect(taken)
        tracks = tuple(
            ProfileTrack.of(t.name, change(t.elevation), valid and valid(t.elevation))
            for t in known.tracks
        )
        return Profile(known.interval_m, tracks, known.start_m)

    return device


@pytest.mark.slow
@each_of_both
def test_a_device_that_knows_the_truth_is_of_the_strictest_class(check, taken):
    device = follow_true_distance if check.edition.true_axis else make_perfect
    assert failing(check, taken(check), device, REFERENCE) == set()


@pytest.mark.slow
@each_of_both
@pytest.mark.parametrize("pipeline", RECOMMENDED)
def test_the_recommended_pipelines_pass_the_simplest_case_as_nominal(check, pipeline, taken):
    def device(given):
        return floatref.process(given.recording, pipeline)

    # At the bump on which the vehicle stands, too: the laser is carried to its accelerometer.
    assert failing(check, taken(check), device) == set()


@pytest.mark.slow
@pytest.mark.parametrize("check", [STOP, NEAR_STOP], ids=lambda check: check.id)
def test_the_basic_pipeline_fails_the_simplest_stop(check, taken):
    def device(given):
        return floatref.process(given.recording, "temporal-basic")

    assert "IRI error, 160.9 m" in failing(check, taken(check), device)


@pytest.mark.slow
@each
def test_a_flat_profile_fails_by_its_roughness_and_the_bump(check, taken):
    found = failing(check, taken(check), spoilt(lambda z: 0.0 * z))
    assert "bump error" in found
    assert {q for q in found if q.startswith(("IRI", "correlation"))}


@pytest.mark.slow
@each
def test_a_smooth_profile_fails(check, taken):
    def smooth(z):
        window = round(2.0 / taken(check).truth.interval_m)
        return np.convolve(z, np.full(window, 1.0 / window), mode="same")

    assert failing(check, taken(check), spoilt(smooth))


@pytest.mark.slow
@each
def test_flagging_everything_fails_unless_all_of_it_is_slow(check, taken):
    device = spoilt(lambda z: z, lambda z: np.zeros(z.size, dtype=bool))
    found = failing(check, taken(check), device)
    assert bool(found) is (check is not SECOND["low-speed"])
    assert {quantity.split()[0] for quantity in found} <= {"flagged"}


@pytest.mark.slow
@each
def test_a_wheel_path_without_elevations_is_the_devices_fault_unless_all_of_it_is_slow(
    check, taken
):
    device = spoilt(lambda z: np.full(z.size, np.nan), lambda z: np.zeros(z.size, dtype=bool))
    if check is SECOND["low-speed"]:
        assert failing(check, taken(check), device) == set()
        assert failing(check, taken(check), device, ADEQUATE)
    else:
        with pytest.raises(DeviceError, match="without elevation"):
            failing(check, taken(check), device)


@pytest.mark.slow
def test_what_a_device_gets_wrong_behind_the_second_stop_counts(taken):
    scenario = replace(
        STOP.simplest.scenario,
        stops=2,
        stop_spacing_m=250.0,
        length_m=750.0,
        rate_hz=4000.0,
    )
    simulated = simulate(replace(scenario, imu=False, gnss=False))
    two = Taken(simulated.recording, simulated.truth, scenario)

    def device(given):
        x = make_perfect(given).distance_m
        return spoilt(lambda z: np.where(np.abs(x - 590.0) < 20.0, 8.0 * z, z))(given)

    measured = STOP.judge(replace(STOP.simplest, scenario=scenario), OneRecording(two, device))
    wholes = [m for m in measured if m.quantity == "IRI error, 160.9 m"]
    assert len(wholes) == 4
    assert [m.within(NOMINAL) for m in wholes] == [True, False, True, False]


def test_a_case_whose_numbers_leave_no_room_is_refused_before_anything_is_simulated():
    case = replace(
        STOP.simplest,
        scenario=replace(STOP.simplest.scenario, length_m=450.0),
    )
    with pytest.raises(InputError, match="must lie 106 m from its ends"):
        STOP.judge(case, OneRecording(None, make_perfect))


@each_of_both
def test_certification_drives_every_row_on_three_roads_and_those_of_a_quick_run_first(check):
    quick, more = (check.cases(5, effort) for effort in Effort)
    assert more[: len(quick)] == quick
    assert 3 <= len(quick) <= 6
    assert 20 <= len(more) <= 40
    roads = {(c.scenario.seed, c.scenario.road, c.scenario.iri_m_per_km) for c in more}
    assert len({case.name for case in more}) == len(roads) == len(more)


@each_of_both
def test_a_seed_draws_the_roads_and_what_the_edition_draws_and_leaves_the_manoeuvres(check):
    road = {"seed": 0, "road": "flat", "iri_m_per_km": 1.0}
    road |= {name: drawn.simplest for name, drawn in check.edition.drawn.items()}
    first, again, other = (check.cases(seed, Effort.CERTIFICATION) for seed in (5, 5, 6))
    assert first == again
    assert first != other
    for one, two in zip(first, other, strict=True):
        assert one.scenario.seed != two.scenario.seed
        assert replace(one.scenario, **road) == replace(two.scenario, **road)


@each_of_both
def test_every_case_can_be_driven_and_scored(check):
    for case in check.cases(0, Effort.CERTIFICATION):
        assert drive_of(case.scenario).length_m >= case.scenario.length_m - 1e-6
        assert layout_of(case.scenario).stretches


def test_the_corners_of_the_domains_are_among_the_cases_of_a_quick_run():
    def values(check, name):
        return {getattr(case.scenario, name) for case in check.cases(0, Effort.QUICK)}

    assert {16.1, 97.0} <= values(SECOND["constant-speed"], "speed_kmh")
    assert {4.0, 15.9} <= values(SECOND["low-speed"], "speed_kmh")
    assert {"constant", "creeping"} == values(SECOND["low-speed"], "manoeuvre")
    assert {0.05, 0.84} <= values(SECOND["braking"], "deceleration_g")
    assert {30.0, 100.0} <= values(SECOND["braking"], "speed_kmh")
    assert {15.0, 60.0} <= values(SECOND["braking"], "event_speed_kmh")
    assert {0.5, 120.0} <= values(STOP, "dwell_s")
    assert {1, 3} == values(STOP, "stops")


@each_of_both
@given(data=st.data())
@settings(
    deadline=None, max_examples=5, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_the_search_draws_cases_of_the_check_that_its_rule_covers(check, data):
    case = data.draw(check.strategy())
    assert case.check == check.id
    assert case.scenario.manoeuvre in {row.manoeuvre for row in check.rows}


@pytest.mark.parametrize("edition", EDITIONS, ids=lambda edition: edition.name)
def test_the_simplest_stop_differs_in_three_numbers_from_the_editions_scenario(edition):
    simplest, plain = driving_checks(edition)["stop"].simplest.scenario, edition.make_scenario()
    differing = {
        f.name for f in fields(plain) if getattr(simplest, f.name) != getattr(plain, f.name)
    }
    assert differing == {"manoeuvre", "bump_mm", "bump_at_m"}


@each_of_both
def test_a_check_says_what_it_asks_and_limits_every_quantity_in_some_class(check):
    assert all((check.title, check.clause, check.derivation, check.floor))
    for words in check.limits.values():
        assert set(words) == set(DeviceClass)
        assert set(words.values()) != {"not limited"}
