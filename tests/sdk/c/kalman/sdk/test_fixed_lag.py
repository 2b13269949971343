"""The Kalman smoother with a fixed lag: the SDK's, where the lag is long enough, and flags."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import Noise, Plan

SEEDS = st.integers(0, 2**32 - 1)
INERTIAL = Noise(
    acceleration_walk=3e-4, pitch_rate_walk=9.27e-6, constant_pitch=0.1, constant_roll=0.04
)
ALONE = Plan(gnss=False, attitude=False)
VARIANTS = [(Plan(), Noise()), (Plan(attitude=False), Noise()), (ALONE, INERTIAL)]
UNSETTLED = 8
TOLERANCE_M, SIGMAS = 1e-4, 5.0
INTERVAL_M = 0.125
WAVELENGTH_M = 105.91


def drawn_for(plan, drawn):
    return drawn if plan.gnss else drawn.without_gnss(0, len(drawn))


@pytest.mark.slow
@settings(max_examples=6, deadline=None)
@given(seed=SEEDS, variant=st.sampled_from(VARIANTS), interval_m=st.sampled_from([0.0625, 0.25]))
@example(seed=1, variant=VARIANTS[0], interval_m=0.0625)
@example(seed=2, variant=VARIANTS[2], interval_m=0.03125)
def test_with_a_lag_longer_than_the_run_it_is_the_sdks(
    drive, smoothed_by_sdk, read_at_points, path_of, smoothed, seed, variant, interval_m
):
    """At samples within rounding; between them the SDK reads a line, and this one a cubic.

    The second derivative of the correction is an acceleration, of 1 m/s² for the 0.1 rad that the
    pitch may be off by: over a step dt that is dt²/8, and 2e-6 m at 256 Hz.
    """
    plan, noise = variant
    drawn = drawn_for(plan, drive(seed, 20.0, stops=((9.0, 11.0),)))
    elevation, sigma = smoothed_by_sdk(drawn, plan, noise)
    expected = read_at_points(elevation, drawn, interval_m)
    path = path_of("kalman", drawn, plan, noise, interval_m=interval_m, lag_s=60.0)
    found, deviation, flags = smoothed(path, drawn)
    within = 1e-9 if interval_m >= 0.0625 else 2e-6
    np.testing.assert_allclose(found, expected, rtol=0, atol=within)
    assert not flags.any()
    ratio = deviation / read_at_points(sigma, drawn, interval_m)
    # A mark may lie a node earlier or later, and a line between two marks with it.
    assert np.abs(ratio - 1.0).max() < 0.03
    assert np.quantile(np.abs(ratio - 1.0), 0.8) < 1e-3


@settings(max_examples=12, deadline=None)
@given(seed=SEEDS, cuts=st.lists(st.integers(0, 5120), max_size=5), late=st.integers(0, 64))
def test_any_division_gives_the_same_bits(drive, path_of, smoothed, seed, cuts, late):
    drawn = drive(seed, 40.0, rate=128, stops=((9.0, 12.0), (25.0, 29.0)))
    common = {"interval_m": INTERVAL_M, "lag_s": 4.0}
    whole = smoothed(path_of("kalman", drawn, **common), drawn)
    path = path_of("kalman", drawn, filter__late_s=0.5, **common)
    found = smoothed(path, drawn, [0, *sorted(cuts), len(drawn)], late)
    for one, other in zip(found, whole, strict=True):
        assert one.tobytes() == other.tobytes()


def high_pass(x, interval_m=INTERVAL_M):
    """Return HPF_B3x2 of points, by the gain of both passes."""
    pad = round(6 * WAVELENGTH_M / interval_m)
    wide = np.concatenate([np.full(pad, x[0]), x, np.full(pad, x[-1])])
    gain = 1 - 1 / (1 + (np.fft.rfftfreq(wide.size, interval_m) * WAVELENGTH_M) ** 6)
    return np.fft.irfft(np.fft.rfft(wide) * gain, wide.size)[pad : pad + x.size]


def off_by(path, drawn, expected, smoothed):
    """Return what a lag changes behind the high-pass, and the flags."""
    found, _, flags = smoothed(path, drawn)
    return np.abs(high_pass(found - expected)), flags


STOPS = [(), ((40.0, 41.0),), ((60.0, 120.0),), ((30.0, 31.0), (60.0, 90.0), (110.0, 115.0))]


@pytest.mark.slow
@pytest.mark.parametrize("stops", STOPS)
@pytest.mark.parametrize("seed", [1, 2])
def test_with_gnss_a_lag_of_a_minute_is_as_good_as_the_whole_run(
    drive, elevation_by_sdk, read_at_points, path_of, smoothed, stops, seed
):
    drawn = drive(seed, 240.0, rate=128, stops=stops)
    expected = read_at_points(elevation_by_sdk(drawn, Plan(), Noise()), drawn, INTERVAL_M)
    path = path_of("kalman", drawn, interval_m=INTERVAL_M)
    change, flags = off_by(path, drawn, expected, smoothed)
    assert change.max() < 1e-6
    assert not flags.any()


@pytest.mark.slow
@pytest.mark.parametrize("stops", STOPS)
@pytest.mark.parametrize("lag_s", [20.0, 60.0])
def test_without_gnss_what_a_lag_changes_is_flagged(
    drive, elevation_by_sdk, read_at_points, path_of, smoothed, stops, lag_s
):
    drawn = drawn_for(ALONE, drive(4, 240.0, rate=128, stops=stops))
    expected = read_at_points(elevation_by_sdk(drawn, ALONE, INERTIAL), drawn, INTERVAL_M)
    path = path_of("kalman", drawn, ALONE, INERTIAL, interval_m=INTERVAL_M, lag_s=lag_s)
    change, flags = off_by(path, drawn, expected, smoothed)
    assert set(np.unique(flags)) <= {0, UNSETTLED}
    assert change[flags == 0].max(initial=0.0) < SIGMAS * TOLERANCE_M
    if lag_s == 60.0:
        assert (flags == 0).mean() > 0.5


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("stop_s", [1.0, 60.0, 3 * 3600.0])
def test_a_standstill_takes_no_room_however_long(
    drive, elevation_by_sdk, read_at_points, path_of, smoothed, variant, stop_s
):
    """At 8 Hz, so that three hours are short: their nodes alone would take 35 MB if stored."""
    plan, noise = variant
    stops = ((120.0, 120.0 + stop_s),)
    drawn = drive(5, 300.0 + stop_s, rate=8, stops=stops, every_s=0.5, pace=0.1)
    drawn = drawn_for(plan, drawn)
    expected = read_at_points(elevation_by_sdk(drawn, plan, noise), drawn, 2.0)
    path = path_of("kalman", drawn, plan, noise, interval_m=2.0, gnss_hz=2.0)
    assert path.made.memory.nbytes < 4_000_000
    found, _, flags = smoothed(path, drawn)
    change = np.abs(high_pass(found - expected, 2.0))
    assert set(np.unique(flags)) <= {0, UNSETTLED}
    assert change[flags == 0].max(initial=0.0) < SIGMAS * TOLERANCE_M
    assert (flags == 0).mean() > 0.5
