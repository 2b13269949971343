"""Levelling in C as samples come: what the SDK makes of the whole run, and nothing is silent."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tests.sdk.c.level_runs import (
    RATE,
    Run,
    copy_of,
    finish,
    level,
    level_by_sdk,
    made_of,
    push,
    run_of,
    take,
)
from tests.sdk.c.level_stops import STOPS, Stop

from floatref.estimators.road_slope.levelled import UNKNOWN_M
from floatref.values.channels import STANDARD_GRAVITY

few = settings(deadline=None, max_examples=6)
PITCH_RAD, ADDED_MPS2 = 1e-5, 1e-4
"""A hundredth of the 1-σ of a pitch, about a milliradian; and what it is of gravity."""
VARIANCE = 0.05
"""Of itself, see `test_level_fit`."""
NO_BRAKE, FOUND = -1, 0


def spread(values):
    return float(np.ptp(values)) if values.size else 0.0


def assert_same(found, drive, expected):
    """Compare all bins; pitch and climb go on from those before, so their constant is free."""
    bins = (found["first"] / round(drive.step * RATE)).astype(int)
    share, inside = expected.share[bins], expected.share[bins] > 0.0
    np.testing.assert_allclose(found["share"], share, rtol=0, atol=1e-12)
    np.testing.assert_allclose(
        np.square(found["sigma_m"]), np.square(expected.sigma_m[bins]), rtol=VARIANCE
    )
    pitch, lean, grade = (getattr(expected, name)[bins] for name in ("pitch", "lean", "grade"))
    tilt = pitch + lean
    climb = 0.5 * STANDARD_GRAVITY * (tilt**2 - lean**2)
    added = found["added"] - share * drive.along[bins] * (tilt - grade) - climb
    assert spread(added[inside]) <= ADDED_MPS2
    assert spread((np.arcsin(found["sin_pitch"]) - pitch)[inside]) <= PITCH_RAD
    return bins


@pytest.mark.slow
@few
@given(stop=STOPS)
@example(stop=Stop(stood_s=20.0, lever_m=0.1))
@example(stop=Stop(speed_mps=7.0, stood_s=0.5))
def test_a_run_is_levelled_as_by_the_sdk(double, stop):
    run = run_of(stop)
    found = level(made_of(double, stop), run)
    drive, expected = level_by_sdk(run, stop)
    bins = assert_same(found, drive, expected)
    left_out = np.setdiff1d(np.arange(drive.force.size), bins)
    assert np.all(drive.speed[left_out] < 0.02)


@pytest.mark.slow
@few
@given(seed=st.integers(0, 2**32 - 1), share=st.sampled_from([0.02, 0.3]))
@example(seed=0, share=0.7)
def test_missing_samples_do_not_count_in_their_bins(double, seed, share):
    stop, rng = Stop(), np.random.default_rng(seed)
    run = run_of(stop)
    for x in (run.force, run.height):
        x[rng.uniform(size=x.shape) < share] = np.nan
    # An end without a known sample would have no line to it.
    run.force[:8], run.force[-8:] = STANDARD_GRAVITY, STANDARD_GRAVITY
    found = level(made_of(double, stop, missing=1), run)
    assert_same(found, *level_by_sdk(run, stop))
    status, _ = push(made_of(double, stop), run, slice(0, 1000))
    assert status == "FR_BAD_SAMPLE"


def with_standstill(run, stood_s, rate):
    """Return a run with more samples where it is stationary, each the last one before."""
    at = int(np.flatnonzero(np.diff(run.counts) == 0)[400])
    more = round(stood_s * rate)
    return Run(*(np.insert(x, at, np.repeat(x[at : at + 1], more, axis=0), axis=0) for x in run))


@pytest.mark.parametrize("stood_s", [1.0, 60.0, pytest.param(10_800.0, marks=pytest.mark.slow)])
def test_a_standstill_of_any_length_takes_constant_memory(double, stood_s):
    stop, rate = Stop(stood_s=10.0), 100.0
    run = with_standstill(run_of(stop, rate), stood_s, rate)
    made = made_of(double, stop, rate)
    found = level(made, run)
    _, expected = level_by_sdk(run, stop, rate)
    assert made.memory.nbytes == made_of(double, stop, rate).memory.nbytes
    assert found["first"].size < 4000
    share = expected.share[found["first"].astype(int)]
    np.testing.assert_allclose(found["share"], share, rtol=0, atol=1e-12)
    inside = share > 0.0
    pitch = expected.pitch[found["first"].astype(int)]
    assert spread((np.arcsin(found["sin_pitch"]) - pitch)[inside]) <= PITCH_RAD


def queue(seconds):
    """Return a run of brakes and starts at low speed, one after the other, on the level."""
    t = np.arange(0.0, seconds, 1.0 / RATE)
    speed = 3.0 + 2.0 * np.sin(2.0 * np.pi * t / 12.0)
    rng = np.random.default_rng(2)
    noise = rng.normal(size=(2, t.size, 2)) * [[[2e-3]], [[1e-4]]]
    counts = np.rint(np.cumsum(speed) / RATE * 4096.0).astype(np.int64)
    return Run(STANDARD_GRAVITY + noise[0], 0.3 + noise[1], counts)


@pytest.mark.slow
def test_a_queue_that_outlasts_a_window_is_fitted_in_several_or_flagged(double):
    found = level(made_of(double, Stop()), queue(330.0))
    outcome, share = found["outcome"], found["share"]
    assert (outcome != NO_BRAKE).all()
    assert (found["sigma_m"] > 0.0).all()
    assert (share[outcome == FOUND][200:-200] == 1.0).all()
    assert (np.diff(found["first"]) == 2).all()


@pytest.mark.slow
@pytest.mark.parametrize("limit", [{"fit__most_width": 24}, {"fit__most_travel_m": 200.0}])
def test_a_stretch_without_room_is_flagged_or_split(double, limit):
    stop = Stop(speed_mps=20.0, brake_mps2=1.5)
    found = level(made_of(double, stop, **limit), run_of(stop))
    inside = found["outcome"] != NO_BRAKE
    assert inside.sum() > 2000
    lost = inside & (found["share"] == 0.0)
    # It comes and goes within a second, as in the SDK.
    np.testing.assert_allclose(found["sigma_m"][lost][200:-200], UNKNOWN_M, rtol=1e-12)
    assert lost.any() == ("fit__most_width" in limit)


def test_without_a_brake_nothing_is_added_and_bins_are_ready_within_60_m(double):
    run = queue(60.0)
    steady = run._replace(counts=np.arange(run.counts.size) * 4096 // 10)
    made, behind = made_of(double, Stop()), []
    for begin in range(0, run.counts.size, 100):
        assert push(made, steady, slice(begin, begin + 100))[0] == "FR_OK"
        rows = take(made)
        assert not np.array(rows).reshape(-1, 6)[:, 1:5].any()
        behind += [begin + 100 - rows[-1][0]] if rows else []
    # 20 m/s: 3 s of road, 0.64 s of bins at the begin, and the samples of a push.
    assert max(behind) / RATE <= 3.0 + 0.64 + 0.5
    assert len(finish(made)) > 0


@pytest.mark.slow
@settings(deadline=None, max_examples=4)
@given(cuts=st.lists(st.integers(0, 5000), max_size=5), data=st.integers(0, 5000))
@example(cuts=[1, 2, 3], data=4700)
def test_any_split_and_a_copy_give_the_same_bits(double, cuts, data):
    stop = Stop(speed_mps=8.0, stood_s=9.0)
    run = run_of(stop)
    edges = sorted({0, *range(0, run.counts.size, 3000), run.counts.size})
    whole = level(made_of(double, stop), run, edges)
    parts = level(made_of(double, stop), run, sorted({*edges, *cuts}))
    made = made_of(double, stop)
    first = []
    for begin in range(0, data, 2500):
        assert push(made, run, slice(begin, min(begin + 2500, data)))[0] == "FR_OK"
        first += take(made)
    copy = copy_of(made)
    made.memory[:] = 0
    rest = level(copy, run, [data, *(e for e in edges if e > data)])
    for k, name in enumerate(whole):
        assert parts[name].tobytes() == whole[name].tobytes()
        joined = np.concatenate([[row[k] for row in first], rest[name]])
        assert joined.tobytes() == whole[name].tobytes()


def test_single_precision_levels_its_own_samples(double, single):
    """Samples are rounded to float before; the fit itself is in double in both."""
    stop = Stop(speed_mps=8.0)
    run = run_of(stop)
    rounded = run._replace(**{k: np.float32(getattr(run, k)) for k in ("force", "height")})
    both = [level(made_of(library, stop), rounded) for library in (double, single)]
    for name in both[0]:
        assert both[0][name].tobytes() == both[1][name].tobytes()
    assert (both[0]["share"] == 1.0).any()
