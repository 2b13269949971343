"""Errors of scale: every run is held to the limit, with two sigma in its favour or more."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import ndtr

from floatref.errors import InputError
from floatref_conformance.certify.judging.contents import Judged, RunSheet, RunTrack
from floatref_conformance.certify.judging.limits import CertificationLimits
from floatref_conformance.certify.judging.scales import (
    judge_distance,
    judge_height,
    judge_long_waves,
    judge_mean_height,
    judge_readings,
    sigmas_of,
)
from floatref_conformance.certify.plan.plan_document import DistancePlan

NAN = float("nan")
LIMITS = CertificationLimits()


def track(name="left", distance=(0.0, 0.01), height=(0.0, 0.1)):
    """A wheel path that agrees, with its errors of scale and their sigma."""
    return RunTrack(name, 1.0, 0.0, 2.0, 0.0, 1.0, *distance, *height, 0.0)


def runs(*wheel_paths):
    """Return run-1, run-2, … of one wheel path each."""
    return [RunSheet(f"run-{k}", "", (), (t,)) for k, t in enumerate(wheel_paths, 1)]


def by_distance(*errors, limits=LIMITS):
    return judge_distance(runs(*(track(distance=error) for error in errors)), limits)


def by_height(*errors, limits=LIMITS):
    return judge_height("left", runs(*(track(height=error) for error in errors)), limits)


@settings(deadline=None)
@given(
    st.lists(st.tuples(st.floats(-3.0, 3.0), st.floats(0.0, 0.07)), min_size=1, max_size=12),
    st.floats(0.15, 2.0),
)
def test_it_fails_where_one_run_is_beyond_with_two_sigma_in_its_favour(errors, limit):
    found, mean = by_distance(*errors, limits=CertificationLimits(distance_percent=limit))
    beyond = [k for k, (e, s) in enumerate(errors, 1) if abs(e) - 2 * s > limit]
    assert found.judged is (Judged.FAIL if beyond else Judged.PASS)
    assert mean.value == pytest.approx(sum(e for e, _ in errors) / len(errors), abs=1e-12)
    assert mean.judged is Judged.REPORTED
    if beyond:
        worst = max(beyond, key=lambda k: abs(errors[k - 1][0]))
        assert found.value == errors[worst - 1][0]
        assert f"run-{worst} {found.value:+.2f} %" in found.reason


@pytest.mark.parametrize(
    ("sigma", "judged"), [(0.011, Judged.PASS), (0.009, Judged.FAIL), (0.0, Judged.FAIL)]
)
def test_an_error_beyond_the_limit_fails_once_two_sigma_say_so(sigma, judged):
    assert by_distance((0.17, sigma))[0].judged is judged
    assert by_height((-1.02, sigma)).judged is judged


def test_one_long_run_among_ten_is_the_one_that_is_named():
    found, _ = by_distance(*[(0.01, 0.01)] * 6, (1.0, 0.01), *[(-0.02, 0.01)] * 3)
    assert found.judged is Judged.FAIL
    assert found.reason == "beyond the limit: run-7 +1.00 % ± 0.02 %"


def test_the_wheel_path_that_tells_the_distance_best_counts_for_its_run():
    run = RunSheet(
        "run-1",
        "",
        (),
        (track(distance=(0.4, 0.05)), track("right", (0.1, 0.01)), track("mid", (NAN, NAN))),
    )
    found, mean = judge_distance([run], LIMITS)
    assert (found.value, mean.value, found.judged) == (0.1, 0.1, Judged.PASS)


@pytest.mark.parametrize("vague", [(0.1, 0.2), (NAN, NAN)])
def test_runs_that_do_not_tell_the_distance_are_named(vague):
    some, _ = by_distance((0.02, 0.01), vague)
    none, _ = by_distance(vague, vague)
    assert (some.judged, some.value) == (Judged.PASS, 0.02)
    assert some.reason.startswith("not known to 0.15 %: run-2")
    assert none.judged is Judged.MISSING
    assert by_distance()[0].judged is Judged.MISSING


def test_heights_that_nobody_tells_are_reported_and_leave_the_verdict_alone():
    assert by_height((NAN, NAN)).judged is Judged.REPORTED
    assert by_height((2.0, 1.5)).judged is Judged.REPORTED
    assert by_height((0.5, 0.2)).judged is Judged.PASS


def test_three_per_cent_of_height_fails_by_name_of_the_run():
    found = by_height((0.1, 0.3), (3.0, 0.3), (-0.1, 0.3))
    assert (found.judged, found.value, found.track) == (Judged.FAIL, 3.0, "left")
    assert found.reason == "beyond the limit: run-2 +3.00 % ± 0.6 %"


def test_an_error_that_is_large_beyond_all_doubt_fails_though_it_is_vague():
    found = by_height((9.0, 1.0))
    assert found.judged is Judged.FAIL
    assert "not told" not in found.reason


@given(st.integers(1, 200))
def test_the_largest_of_many_is_beyond_by_chance_as_rarely_as_one(count):
    assert sigmas_of(1) == pytest.approx(2.0)
    assert count * ndtr(-sigmas_of(count)) == pytest.approx(ndtr(-2.0))


def test_what_one_run_does_not_show_for_certain_their_mean_does():
    errors = [(2.6, 0.8)] * 10
    assert by_height(*errors).judged is not Judged.FAIL
    found = judge_mean_height(runs(*(track(height=error) for error in errors)), LIMITS)
    assert (found.judged, found.value) == (Judged.FAIL, pytest.approx(2.6))


@settings(deadline=None)
@given(st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=10), st.floats(0.1, 2.0))
def test_the_mean_of_heights_keeps_the_half_of_its_error_that_runs_share(errors, sigma):
    found = judge_mean_height(runs(*(track(height=(e, sigma)) for e in errors)), LIMITS)
    mean, count = sum(errors) / len(errors), len(errors)
    assert found.value == pytest.approx(mean, abs=1e-9)
    error = sigma * (0.5 + 0.5 / count) ** 0.5
    if abs(abs(mean) - 2.0 * error - 1.0) > 1e-9:
        assert (found.judged is Judged.FAIL) == (abs(mean) - 2.0 * error > 1.0)


def test_the_mean_of_heights_that_nobody_tells_is_reported():
    assert judge_mean_height(runs(track(height=(NAN, NAN))), LIMITS).judged is Judged.REPORTED
    assert judge_mean_height((), LIMITS).judged is Judged.REPORTED


def test_long_waves_fail_by_name_of_the_run_and_are_no_height():
    wheel_paths = [replace(track(), long_percent=e, long_sigma=1.5) for e in (2.0, 25.0, 1.0)]
    found = judge_long_waves("left", runs(*wheel_paths), LIMITS)
    assert (found.judged, found.value, found.track) == (Judged.FAIL, 25.0, "left")
    assert found.reason == "beyond the limit: run-2 +25.00 % ± 3 %"
    assert judge_height("left", runs(*wheel_paths), LIMITS).judged is Judged.PASS
    unknown = judge_long_waves("left", runs(track()), LIMITS)
    assert unknown.judged is Judged.REPORTED


def test_without_a_limit_it_is_reported():
    free = CertificationLimits(distance_percent=None, height_percent=None)
    assert by_distance((4.0, 0.01), limits=free)[0].judged is Judged.REPORTED
    assert by_height((4.0, 0.01), limits=free).judged is Judged.REPORTED
    assert by_height((4.0, 0.01), limits=free).value == 4.0


@settings(deadline=None)
@given(st.floats(100.0, 5000.0), st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=10))
def test_every_reading_of_a_known_length_is_held_to_the_limit(known, errors):
    readings = tuple(known * (1 + error / 100) for error in errors)
    found, mean = judge_readings(DistancePlan(known, readings), LIMITS)
    worst = max(errors, key=abs)
    assert abs(found.value) == pytest.approx(abs(worst), abs=1e-9)
    assert mean.value == pytest.approx(sum(errors) / len(errors), abs=1e-9)
    if abs(abs(worst) - 0.15) > 1e-9:
        assert found.judged is (Judged.FAIL if abs(worst) > 0.15 else Judged.PASS)


def test_the_reading_that_is_off_is_named():
    found, _ = judge_readings(DistancePlan(1000.0, (1000.2, 1002.0, 999.5)), LIMITS)
    assert found.reason == "beyond the limit: reading 2 (1002 m) +0.20 %"


def test_no_reading_is_missing_and_an_absurd_one_is_refused():
    assert judge_readings(DistancePlan(1000.0, ()), LIMITS)[0].judged is Judged.MISSING
    for plan in (
        DistancePlan(0.0, (1.0,)),
        DistancePlan(10.0, (NAN,)),
        DistancePlan(10.0, (-1.0,)),
    ):
        with pytest.raises(InputError, match="above zero"):
            judge_readings(plan, LIMITS)
