"""`quiescent` and `bounce` on simulated recordings: what must pass and what must fail."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.stationary.parked_checks import (
    BOUNCE,
    QUIESCENT,
    SEARCHED_RATES_HZ,
)
from floatref_conformance.checks.stationary.plate import Plate, measure_plate
from floatref_conformance.classes import DeviceClass, Effort
from floatref_conformance.errors import DeviceError
from floatref_conformance.judge.bench import make_taken

TRACKS = ("left", "right")


def nominal(case):
    """Return what is simulated of a case for a device of nominal channels."""
    return replace(case.scenario, imu=False, gnss=False)


@dataclass
class TruthBench:
    """A bench whose device knows the truth, and gets ``change`` of it wrong."""

    change: Callable

    def simulate(self, scenario):
        return make_taken(replace(scenario, imu=False, gnss=False))

    def run(self, taken, label=""):
        return on_truths_grid(taken, self.change)


@pytest.fixture(scope="module")
def bounced():
    """One bounce case and its recording."""
    case = BOUNCE.cases(0, Effort.QUICK)[1]
    return case, make_taken(nominal(case))


def on_truths_grid(simulated, change):
    interval = simulated.truth.interval_m
    tracks = tuple(
        ProfileTrack.of(t.name, change(high_pass(t.elevation, interval), simulated))
        for t in simulated.truth.tracks
    )
    return Profile(interval, tracks)


def failing(check, case, change):
    measured = check.judge(case, TruthBench(change))
    return {m.quantity for m in measured if not m.within(DeviceClass.NOMINAL)}


def test_the_truth_itself_keeps_every_limit_of_the_strictest_class(bounced):
    measured = BOUNCE.judge(bounced[0], TruthBench(lambda z, _: z))
    assert {m.track for m in measured} == set(TRACKS)
    assert all(m.within(DeviceClass.REFERENCE) for m in measured)


def test_a_flat_profile_fails_by_the_plate_alone(bounced):
    assert failing(BOUNCE, bounced[0], lambda z, _: 0.0 * z) == {"plate height error"}


def test_a_profile_that_lets_the_bodys_motion_through_fails_by_the_iri_alone(bounced):
    def leaky(z, simulated):
        points = simulated.truth.distance_m
        bounce = np.sin(2 * np.pi * points / 10.0) * ((points > 200) & (points < 330))
        return z + 0.4e-3 * bounce

    assert failing(BOUNCE, bounced[0], leaky) == {"IRI"}


def test_smoothing_the_plate_away_fails_by_the_plate(bounced):
    def smooth(z, simulated):
        window = round(10.0 / simulated.truth.interval_m)
        return np.convolve(z, np.full(window, 1.0 / window), mode="same")

    assert failing(BOUNCE, bounced[0], smooth) == {"plate height error"}


def at_480_m(z, simulated):
    x = simulated.truth.distance_m
    return 0.005 * ((x > 480.0) & (x < 483.0))


def of_the_case_before(z, simulated):
    before = make_taken(nominal(BOUNCE.cases(0, Effort.QUICK)[0])).truth
    return high_pass(before.track("left").elevation, before.interval_m)[: z.size]


def of_the_other_track(z, simulated):
    tracks = [high_pass(t.elevation, simulated.truth.interval_m) for t in simulated.truth.tracks]
    return next(other for other in tracks if not np.array_equal(other, z))


def of_the_left_track(z, simulated):
    return high_pass(simulated.truth.track("left").elevation, simulated.truth.interval_m)


@pytest.mark.slow
@pytest.mark.parametrize(
    "cheat", [at_480_m, of_the_case_before, of_the_other_track, of_the_left_track]
)
def test_a_plate_from_elsewhere_fails_by_its_height(bounced, cheat):
    assert "plate height error" in failing(BOUNCE, bounced[0], cheat)


def test_a_profile_shifted_by_two_hand_widths_fails_by_the_plates_place_alone(bounced):
    def shifted(z, simulated):
        return np.roll(z, round(0.2 / simulated.truth.interval_m))

    assert failing(BOUNCE, bounced[0], shifted) == {"plate displacement"}


@pytest.mark.parametrize("place", [107.0, 150.0, 400.0, 533.0])
def test_a_point_without_elevation_is_an_error_wherever_the_filter_has_run_in(bounced, place):
    def holed(z, simulated):
        return np.where(np.abs(simulated.truth.distance_m - place) < 0.004, np.nan, z)

    with pytest.raises(DeviceError, match=r"points without elevation from 106\.0 m to 534\.0 m"):
        BOUNCE.judge(bounced[0], TruthBench(holed))


def test_the_iri_is_that_of_what_is_scored(bounced):
    ((start, end),) = BOUNCE.list_scored(bounced[0])

    def iri_with_a_dip(at_m):
        def dipped(z, simulated):
            return z - 0.002 * (np.abs(simulated.truth.distance_m - at_m) < 0.1)

        measured = BOUNCE.judge(bounced[0], TruthBench(dipped))
        return max(m.value for m in measured if m.quantity == "IRI")

    level = iri_with_a_dip(-1.0)
    assert iri_with_a_dip(start - 0.5) == iri_with_a_dip(end + 0.5) == level
    assert min(iri_with_a_dip(start + 0.5), iri_with_a_dip(end - 0.5)) > level + 0.001


def test_the_ends_of_the_run_may_lack_elevations(bounced):
    def without_ends(z, simulated):
        x = simulated.truth.distance_m
        return np.where((x < 105.9) | (x > 534.1), np.nan, z)

    assert failing(BOUNCE, bounced[0], without_ends) == set()


def test_the_plate_lies_outside_the_stretch_whose_iri_is_limited(bounced):
    _, simulated = bounced
    for track in simulated.truth.tracks:
        plate = Plate.find(simulated.truth, track.name)
        for check in (QUIESCENT, BOUNCE):
            assert plate.before[0] - 91.44 > check.end_m


def test_the_body_moves_to_its_full_extent_in_the_limited_stretch(bounced):
    _, simulated = bounced
    distance = simulated.recording.channel("distance").values
    height = np.mean([simulated.recording.channel("height", t).values for t in TRACKS], axis=0)
    inside = (distance > BOUNCE.start_m) & (distance < BOUNCE.end_m)
    still = np.median(height[distance < 190.0])
    assert height[inside].min() - still == pytest.approx(-0.056, abs=2e-3)
    assert height[inside].max() - still == pytest.approx(0.030, abs=2e-3)


def test_a_left_over_acceleration_bends_the_rise_as_published(bounced):
    _, simulated = bounced
    acceleration, speed = 0.0074, 20.0

    def bent(z, simulated):
        return z + acceleration / 2 * ((simulated.truth.distance_m - 480.0) / speed) ** 2

    profile = on_truths_grid(simulated, bent)
    for track in TRACKS:
        top = Plate.find(simulated.truth, track).top
        length = top[1] - top[0] + 0.54
        middles = (length / 2 + 1.0) ** 2 + 1.5**2 / 12 - (length / 2 - 0.27) ** 2 / 3
        measured, _ = measure_plate(profile, simulated.truth, track)
        expected = acceleration * middles / (2 * speed**2)
        assert measured.value == pytest.approx(1000 * expected, rel=0.02)
        assert expected < acceleration * 0.0103


def seeds(check, seed, effort=Effort.QUICK):
    return [case.scenario.seed for case in check.cases(seed, effort)]


def test_cases_follow_from_the_seed_and_differ_between_seeds_checks_and_each_other():
    assert QUIESCENT.cases(7, Effort.QUICK) == QUIESCENT.cases(7, Effort.QUICK)
    drawn = [*seeds(QUIESCENT, 7), *seeds(QUIESCENT, 8), *seeds(BOUNCE, 7)]
    assert len(set(drawn)) == len(drawn)
    assert len({case.scenario.rate_hz for case in BOUNCE.cases(0, Effort.QUICK)}) == 2


def test_certification_draws_more_cases_and_those_of_a_quick_run_first():
    for check in (QUIESCENT, BOUNCE):
        quick, more = (check.cases(3, effort) for effort in Effort)
        assert more[: len(quick)] == quick
        assert len(set(more)) == len(more) == 16


@settings(deadline=None, max_examples=30)
@given(st.sampled_from([QUIESCENT, BOUNCE]).flatmap(lambda c: st.tuples(st.just(c), c.strategy())))
def test_the_search_draws_cases_of_the_check_itself(drawn):
    check, case = drawn
    assert case.check == case.scenario.manoeuvre == check.id
    assert case.scenario.rate_hz in SEARCHED_RATES_HZ
    numbers = {
        "manoeuvre": case.check,
        "rate_hz": case.scenario.rate_hz,
        "seed": case.scenario.seed,
    }
    assert case.scenario == check.edition.make_scenario(**numbers)


def test_the_simplest_case_is_the_test_of_the_proving_ground_alone():
    for check in (QUIESCENT, BOUNCE):
        plain = check.edition.make_scenario(manoeuvre=check.id)
        assert check.simplest == Case(check.id, plain)


def test_the_limits_are_those_of_r_57_and_half_of_them_for_class_reference():
    for check, limit in ((QUIESCENT, 0.047), (BOUNCE, 0.126)):
        assert check.iri_limits[DeviceClass.NOMINAL] == limit
        assert check.iri_limits[DeviceClass.ADEQUATE] == limit
        assert check.iri_limits[DeviceClass.REFERENCE] == pytest.approx(limit / 2)
