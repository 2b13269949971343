"""The modelled pitch in C is that of the SDK's `HeightByModel`, however the samples are pushed."""

from dataclasses import replace
from itertools import pairwise
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.linalg import solve_discrete_are
from tests.sdk.c.level_runs import Run, copy_of, push, run_of
from tests.sdk.c.level_stops import STOPS, Stop
from tests.sdk.c.pitch_runs import finish, made_of, model, model_by_sdk, take

from floatref import AxleSetup
from floatref.estimators.laser_place import half_car, pitching
from floatref.estimators.laser_place.half_car import Gains, HalfCar
from floatref.values.channels import STANDARD_GRAVITY

few = settings(deadline=None, max_examples=6)
fewer = settings(deadline=None, max_examples=2)
EPS = float(np.finfo(np.float64).eps)
SHORT = {"window_s": 10.0, "shared_s": 5.0}
IN_SDK = {"WINDOW_S": 10.0, "SHARED_S": 5.0}


def condition_of(stop, step):
    """Return the condition number of the covariance by whose inverse the SDK smooths."""
    axles = AxleSetup(stop.wheelbase_m, stop.front_m)
    car = HalfCar.usual(axles, -stop.lever_m)
    phi = Gains.of(car, step).transition
    driven = half_car.DISTURBANCE**2 * (1.0 - np.exp(-4.0 * np.pi * half_car.DISTURBED_HZ * step))
    noise = np.diag([0.0] * 8 + [driven] * 2)
    h = car.reading[:, np.newaxis]
    return np.linalg.cond(solve_discrete_are(phi.T, h, noise, [[half_car.READING**2]]))


def bound_of(stop, step, expected):
    """Return what rounding can make of a pitch, in rad.

    C goes back by the adjoint and inverts nothing; the SDK's gain has the rounding of an inverse.
    Before, eight passes of filters carry a rounding of the height by the inverse square of their
    corner, over the wheelbase.
    """
    corner = np.pi * pitching.SLOW_HZ * step
    of_filters = 8.0 * EPS * corner**-2.0 / stop.wheelbase_m
    return EPS * condition_of(stop, step) * np.abs(expected).max() + of_filters


def assert_same(found, run, stop, rate):
    expected = model_by_sdk(run, stop, rate)
    step = max(1, round(rate / 100.0)) / rate
    assert found.size == expected.size
    assert np.abs(found - expected).max() <= bound_of(stop, step, expected)
    return expected


@pytest.mark.slow
@fewer
@given(stop=STOPS, rate=st.sampled_from([100, 160, 200, 250]))
@example(stop=Stop(lever_m=0.3), rate=200)
@example(stop=Stop(lever_m=-0.3, speed_mps=25.0), rate=20)
def test_the_pitch_is_that_of_the_sdk(double, stop, rate):
    run = run_of(stop, float(rate))
    expected = assert_same(model(made_of(double, stop, rate), run), run, stop, rate)
    assert np.abs(expected).max() > 1e-3


@pytest.mark.slow
@few
@given(seed=st.integers(0, 2**32 - 1), share=st.sampled_from([0.02, 0.4, 0.7]))
@example(seed=0, share=0.98)
def test_missing_samples_do_not_count_and_missing_bins_are_on_a_line(double, seed, share):
    stop, rng = Stop(lever_m=0.3), np.random.default_rng(seed)
    run = run_of(stop)
    for x in (run.force, run.height):
        x[rng.uniform(size=x.shape) < share] = np.nan
    run.force[500:1500, 0] = np.nan
    assert_same(model(made_of(double, stop, missing=1), run), run, stop, 200)
    status, _ = push(made_of(double, stop), run, slice(0, 1000))
    assert status == "FR_BAD_SAMPLE"


def test_a_path_that_is_dead_is_left_out(double):
    stop = Stop(lever_m=0.3)
    run = run_of(stop)
    run.height[:, 1] = np.nan
    expected = assert_same(model(made_of(double, stop, missing=1), run), run, stop, 200)
    assert np.abs(expected).max() > 1e-3


@pytest.mark.parametrize("name", ["force", "height"])
def test_without_a_sensor_there_is_no_pitch(double, name):
    stop = Stop(lever_m=0.3)
    run = run_of(stop)
    getattr(run, name)[:] = np.nan
    found = model(made_of(double, stop, missing=1), run)
    assert found.size == len(run.counts) // 2
    assert not found.any()


@pytest.mark.slow
@few
@given(stop=STOPS, gone=st.integers(0, 900))
@example(stop=Stop(lever_m=0.2, between_s=20.0), gone=0)
def test_windows_pass_into_each_other_as_in_the_sdk(double, stop, gone):
    """A height is missing across the begin of the second window."""
    run = run_of(stop)
    run.height[1900 : 1900 + gone] = np.nan
    run = Run(*(x[: 100 * (len(x) // 100)] for x in run))
    found = model(made_of(double, stop, missing=1, **SHORT), run)
    with patch.multiple(pitching, **IN_SDK):
        assert_same(found, run, stop, 200)


@pytest.mark.parametrize("bins", [0, 1, 63, 64, 1500, 1501, 2501])
def test_a_run_of_any_length_ends(double, bins):
    """Fewer than 64 bins have no pitch; with 1500 a window is complete, and 500 are shared."""
    stop = Stop(lever_m=0.2, between_s=20.0)
    run = Run(*(x[: 2 * bins + 1] for x in run_of(stop)))
    found = model(made_of(double, stop, **SHORT), run)
    assert found.size == bins
    assert found.any() == (bins >= 64)
    if bins:
        with patch.multiple(pitching, **IN_SDK):
            assert_same(found, run, stop, 200)


def test_a_bounce_test_has_no_pitch_that_could_be_known(double):
    stop, t = Stop(lever_m=0.3), np.arange(6000) / 200.0
    moved = (0.01 * np.sin(3.0 * np.pi * t))[:, np.newaxis] * [1.0, 1.0]
    rng = np.random.default_rng(0)
    height = 0.3 + moved + 1e-5 * rng.normal(size=moved.shape)
    counts = np.rint(20.0 * t * 4096.0).astype(int)
    force = STANDARD_GRAVITY - (3.0 * np.pi) ** 2 * moved
    assert not model(made_of(double, stop), Run(force, height, counts)).any()


@pytest.mark.slow
@few
@given(cuts=st.lists(st.integers(0, 6000), max_size=5), at=st.integers(0, 6000))
@example(cuts=[1, 2, 3], at=3001)
def test_any_split_and_a_copy_give_the_same_bits(double, cuts, at):
    stop = Stop(speed_mps=8.0, stood_s=9.0, lever_m=0.3)
    run = run_of(stop)
    edges = sorted({*range(0, len(run.counts), 1900), len(run.counts), at})
    whole = model(made_of(double, stop, **SHORT), run, edges)
    parts = model(made_of(double, stop, **SHORT), run, sorted({*edges, *cuts}))
    assert parts.tobytes() == whole.tobytes()
    made, first = made_of(double, stop, **SHORT), []
    for begin, end in pairwise(edges):
        if begin < at:
            assert push(made, run, slice(begin, end))[0] == "FR_OK"
            first.append(take(made))
    copy = copy_of(made)
    made.memory[:] = 0
    rest = model(copy, run, [e for e in edges if e >= at])
    assert np.concatenate([*first, rest]).tobytes() == whole.tobytes()


def test_what_is_ready_is_taken_in_pieces(double):
    stop = Stop(lever_m=0.3)
    run = run_of(stop)
    whole, made = model(made_of(double, stop), run), made_of(double, stop)
    for begin in range(0, len(run.counts), 1000):
        assert push(made, run, slice(begin, begin + 1000)) == ("FR_OK", 0)
    first = made.library.ffi.new("size_t *")
    assert made.call("finish", first) == 0
    pieces = [take(made, 7) for _ in range(first[0] // 7 + 1)]
    assert np.concatenate(pieces).tobytes() == whole.tobytes()
    assert take(made).size == 0


@pytest.mark.slow
@few
@given(stop=STOPS)
def test_in_single_precision_only_the_samples_are_rounded(single, double, stop):
    """Double behind the samples: what is found is the pitch of the rounded samples."""
    stop = replace(stop, speed_mps=8.0)
    run = run_of(stop)
    rounded = Run(*(x.astype(np.float32).astype(float) for x in run[:2]), run.counts)
    # Sums in the bins are double, too.
    found = model(made_of(single, stop), run)
    assert found.tobytes() == model(made_of(double, stop), rounded).tobytes()


def test_no_finish_leaves_bins_behind(double):
    stop = Stop(lever_m=0.3)
    made = made_of(double, stop)
    assert push(made, run_of(stop), slice(0, 777)) == ("FR_OK", 0)
    assert finish(made).size == 388
