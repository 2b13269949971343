"""The forward pass in C has the bits of the SDK's kernel, which Python runs without numba."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import Noise, Plan

laws = settings(
    max_examples=2, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
SEEDS = st.integers(0, 2**32 - 1)
PLANS = [
    Plan(),
    Plan(reflects=False),
    Plan(attitude=False),
    Plan(gnss=False, attitude=False),
    Plan(gnss=False, attitude=False, reflects=False),
]
STOPS = ((7.0, 8.0),)


@pytest.mark.slow
@laws
@given(seed=SEEDS, plan=st.sampled_from(PLANS), quiet=st.sampled_from([1.0, 30.0]))
@example(seed=1, plan=PLANS[0], quiet=1.0)
@example(seed=2, plan=PLANS[3], quiet=1.0)
def test_heights_are_those_of_the_sdk_bit_for_bit(
    plain_forward, drive, by_sdk, path_of, filtered, seed, plan, quiet
):
    drawn = drive(seed, 10.0, stops=STOPS, quiet=quiet)
    if not plan.gnss:
        drawn = drawn.without_gnss(0, len(drawn))
    found = filtered(path_of("kalman_filter", drawn, plan), drawn)
    np.testing.assert_array_equal(found, by_sdk(drawn, plan, Noise()))


def spoil(drawn, seed):
    """Return the drive with readings that lack components, are wild or of a new datum, and gaps."""
    rng = np.random.default_rng(seed)
    y, u, height = drawn.y.copy(), drawn.u.copy(), drawn.height.copy()
    y[:, 1:][rng.uniform(size=(len(y), 3)) < 0.2] = np.nan
    wild = rng.uniform(size=len(y)) < 0.05
    y[wild] += 30.0 * rng.normal(size=(wild.sum(), 4))
    y[drawn.at > rng.integers(0, len(drawn)), 0] += 8.0
    lost = np.unique(rng.integers(0, len(drawn), 3)[:, None] + np.arange(7))
    lost = lost[lost < len(drawn)]
    u[lost, 2] = np.nan
    u[rng.integers(0, len(drawn), 5), rng.integers(0, 2, 5)] = np.nan
    height[rng.integers(1, len(drawn), 50)] = np.nan
    drawn = replace(drawn, y=y, u=u, height=height, lost=tuple(lost.tolist()))
    begin = int(rng.integers(0, len(drawn)))
    return drawn.without_gnss(begin, begin + int(rng.integers(64, 900)))


@pytest.mark.slow
@laws
@given(seed=SEEDS, plan=st.sampled_from(PLANS[:3]), every_s=st.sampled_from([0.0625, 0.015625]))
@example(seed=3, plan=PLANS[0], every_s=0.0625)
@example(seed=4, plan=PLANS[2], every_s=0.015625)
def test_with_gaps_and_wild_readings_too(
    plain_forward, drive, by_sdk, path_of, filtered, seed, plan, every_s
):
    drawn = spoil(drive(seed, 10.0, stops=STOPS, every_s=every_s), seed)
    path = path_of("kalman_filter", drawn, plan, missing=1)
    np.testing.assert_array_equal(filtered(path, drawn), by_sdk(drawn, plan, Noise()))
    count = path.ffi.new("int64_t[4]")
    assert path.made.call("left_out", count) == 0
    assert list(count) == plain_forward.state.memory.rejected.tolist()


@pytest.mark.slow
def test_at_16_khz_too(plain_forward, drive, by_sdk, path_of, filtered):
    drawn = drive(5, 1.0, rate=16384, stops=((0.5, 0.6),))
    found = filtered(path_of("kalman_filter", drawn), drawn)
    np.testing.assert_array_equal(found, by_sdk(drawn, Plan(), Noise()))


@given(seed=SEEDS, cuts=st.lists(st.integers(0, 1024), max_size=4), late=st.integers(0, 64))
@settings(max_examples=20, deadline=None)
def test_any_division_and_order_of_readings_gives_the_same_bits(
    drive, path_of, filtered, seed, cuts, late
):
    drawn = drive(seed, 4.0, stops=((2.0, 2.5),))
    whole = filtered(path_of("kalman_filter", drawn), drawn)
    order = np.random.default_rng(seed).permutation(drawn.at.size)
    path = path_of("kalman_filter", drawn, late_s=0.25)
    found = filtered(path, drawn, [0, *sorted(cuts), 1024], late, order)
    np.testing.assert_array_equal(found, whole)


def test_variances_of_a_receiver_replace_those_of_the_settings(drive, path_of, filtered):
    drawn, noise = drive(6, 3.0), Noise()
    whole = filtered(path_of("kalman_filter", drawn), drawn)
    changed = replace(noise, gnss_height_m=0.5, gnss_roll_rad=0.25)
    path = path_of("kalman_filter", drawn, noise=changed)
    height, roll = noise.gnss_height_m**2, noise.gnss_roll_rad**2
    found = filtered(path, drawn, variances=[height, np.nan, np.nan, roll])
    np.testing.assert_array_equal(found, whole)
    assert (filtered(path_of("kalman_filter", drawn, noise=changed), drawn) != whole).any()
