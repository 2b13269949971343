"""The smoother is least squares, and does at a stop and without laser what the model says."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from floatref_reference.road_prior.least_squares import all_states, least_squares
from floatref_reference.road_prior.smoother import Smoothed, measurement_update, smooth
from floatref_reference.road_prior.symbols import Constants, Recorded, recorded

C = Constants()


def standing(seconds: float, rate: float = 10.0) -> Recorded:
    """Drive 2 s at 5 m/s, stand, and drive 2 s again, over a road that rises by 1 mm/m."""
    moving = int(2 * rate)
    N = 2 * moving + int(seconds * rate) + 1
    index = np.arange(N)
    x = 5 / rate * (np.minimum(index, moving) + np.maximum(index - (N - 1 - moving), 0))
    noise = np.random.default_rng(5).normal(size=N)
    return recorded(index / rate, x, 0.05 + 0.01 * noise, 0.3 - 1e-3 * x, a_x=0.5)


def of_height(P: np.ndarray) -> np.ndarray:
    """Return the variance of r - z."""
    return P[:, 0, 0] - 2 * P[:, 0, 3] + P[:, 3, 3]


def same(a: Smoothed, b: Smoothed, keep: np.ndarray | slice = slice(None)) -> None:
    assert a.x == pytest.approx(b.x[keep], abs=1e-9)
    assert a.sigma_r == pytest.approx(b.sigma_r[:, keep], rel=1e-6, abs=1e-12)


@pytest.mark.slow
@pytest.mark.cites("(6.5)", "(6.17)", "(6.22)")
@settings(deadline=None, max_examples=15, phases=[Phase.generate])
@given(
    seed=st.integers(0, 9999),
    n=st.integers(1, 2),
    J=st.integers(0, 2),
    shared=st.booleans(),
    share=st.floats(0.2, 1.0),
    dt=st.sampled_from([0.002, 0.01, 0.05]),
)
def test_smoother_is_least_squares(
    drawn, seed: int, n: int, J: int, shared: bool, share: float, dt: float
) -> None:
    run = drawn(seed, n, J, dt=dt, share=share, shared=shared)
    # A track that is hardly measured keeps priors, whose P the literal gain inverts badly.
    assume(np.isfinite(run.h).sum(axis=1).min() >= 8)
    smoothed, posterior = smooth(run, C), least_squares(run, C)
    assert smoothed.x == pytest.approx(posterior.x, abs=1e-8)
    P = posterior.root @ posterior.root.transpose(0, 2, 1)
    sigma = np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    scale = sigma[:, :, None] * sigma[:, None, :]
    assert smoothed.P / scale == pytest.approx(P / scale, abs=1e-5)
    assert smoothed.sigma_r == pytest.approx(sigma[:, 0 : 5 * n : 5].T, abs=1e-9)
    assert smoothed.sigma_z == pytest.approx(sigma[:, 3 : 5 * n : 5].T, abs=1e-9)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 9999), p=st.floats(-3, 3), q=st.floats(-3, 3))
def test_states_are_linear_in_the_data_and_deviations_know_none(
    drawn, seed: int, p: float, q: float
) -> None:
    first, other = drawn(seed, n=2), drawn(seed + 1, n=2, share=1.0)
    second = first._replace(a_m=other.a_m, h=other.h + 0 * first.h)
    both = first._replace(a_m=p * first.a_m + q * second.a_m, h=p * first.h + q * second.h)
    one, two, sums = (smooth(run, C) for run in (first, second, both))
    assert sums.x == pytest.approx(p * one.x + q * two.x, abs=1e-10)
    assert np.array_equal(sums.P, one.P)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 9999))
def test_a_sample_without_a_height_and_news_is_as_good_as_none(drawn, seed: int) -> None:
    run = drawn(seed, n=2, share=1.0)._replace(a_x=np.full(30, 0.7))
    rng = np.random.default_rng(seed)
    keep = np.sort(np.concatenate([[0, 29], 1 + rng.permutation(28)[:15]]))
    a_m = [np.interp(run.t, run.t[keep], a[keep]) for a in run.a_m]
    u = [np.interp(run.t, run.t[keep], u_i[keep, 0]) for u_i in run.u]
    h = np.full((2, 30), np.nan)
    h[:, keep] = run.h[:, keep]
    full = recorded(run.t, run.distance, a_m, h, np.expand_dims(u, 2), run.a_x)
    some = [np.asarray(part)[..., keep] for part in (run.t, run.distance, a_m, h)]
    less = recorded(*some, np.expand_dims(u, 2)[:, keep], run.a_x[keep])
    same(smooth(less, C), smooth(full, C), keep)


def test_a_height_of_one_track_is_used_without_the_other() -> None:
    P, H, R = np.diag([1.0, 2.0, 3.0]), np.eye(2, 3), 0.5 * np.eye(2)
    x, after = measurement_update(np.zeros(3), P, np.array([np.nan, 1.0]), H, R)
    assert x == pytest.approx([0, 0.8, 0])
    assert after == pytest.approx(np.diag([1, 0.4, 3]))


@pytest.mark.slow
@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 9999), sigma_h=st.sampled_from([1e-3, 1e-2, 0.1]))
def test_deviation_of_the_profile_is_that_of_its_error(drawn, seed: int, sigma_h: float) -> None:
    """The error of r - h written out in unknowns and noise, all of them independent."""
    run, c = drawn(seed), C._replace(sigma_h=sigma_h)
    rows = all_states(run, c)[:, :, :-1]
    there = ~np.isnan(run.h[0])
    H = (rows[there, 0] - rows[there, 3]) / sigma_h
    after = np.linalg.inv(np.eye(H.shape[1]) + H.T @ H)
    by_unknowns, by_noise = -rows[there, 0] @ after, rows[there, 0] @ after @ H.T
    by_noise -= sigma_h * np.eye(len(H))
    expected = np.sqrt(np.sum(by_unknowns**2, axis=1) + np.sum(by_noise**2, axis=1))
    assert smooth(run, c).sigma_e[0, there] == pytest.approx(expected, rel=1e-4)


def test_without_laser_the_accelerometer_alone_carries_the_height() -> None:
    run = standing(4.0)
    h = run.h.copy()
    h[0, 30:51] = np.nan
    gap, whole = smooth(run._replace(h=h), C), smooth(run, C)
    assert np.isnan(gap.e[0, 30:51]).all()
    assert np.isnan(gap.sigma_e[0, 30:51]).all()
    assert np.isfinite(gap.sigma_r).all()
    assert (gap.sigma_r >= whole.sigma_r * (1 - 1e-6)).all()
    of_rise = [
        np.sqrt(run.P[:, 0, 0] - 2 * run.P[:, 0, 3] + run.P[:, 3, 3]) for run in (gap, whole)
    ]
    assert of_rise[0][40] > 3 * of_rise[1][40]
    assert of_rise[0][20] < 1.5 * of_rise[1][20]


def test_at_a_stop_of_any_length_the_road_is_one_and_nothing_drifts() -> None:
    short, long = smooth(standing(4.0), C), smooth(standing(60.0), C)
    for run, stop in [(short, slice(20, 61)), (long, slice(20, 621))]:
        z, s = run.x[stop, 3:5].T
        assert z == pytest.approx(np.full(z.size, z[0]), abs=1e-9)
        assert s == pytest.approx(np.full(s.size, s[0]), abs=1e-9)
        assert run.sigma_z[0, stop] == pytest.approx(run.sigma_z[0, 20], rel=1e-6)
    assert long.sigma_r[0, 20:621].max() < 1.01 * short.sigma_r[0, 20:61].max()
    assert np.ptp(long.e[0, 20:621]) < 1e-3


@settings(deadline=None, max_examples=6)
@given(seed=st.integers(0, 9999))
def test_tracks_with_constants_of_their_own_are_runs_of_their_own(drawn, seed: int) -> None:
    both = drawn(seed, n=2, shared=False)
    smoothed = smooth(both, C)
    for i in range(2):
        own = (part[i : i + 1] for part in (both.a_m, both.h, both.u))
        alone = smooth(recorded(both.t, both.distance, *own, both.a_x), C)
        places = [*range(5 * i, 5 * i + 5), 10 + i]
        assert smoothed.x[:, places] == pytest.approx(alone.x, abs=1e-9)
        assert smoothed.sigma_r[i] == pytest.approx(alone.sigma_r[0], abs=1e-9)
    shared = smooth(both._replace(shared=True), C)
    assert shared.P[0, 10, 10] < min(smoothed.P[0, 10, 10], smoothed.P[0, 11, 11])


def test_finer_sampling_with_the_same_densities_converges() -> None:
    """Heights of the noise σ_h²/rate at every rate; compared at the instants of the coarsest."""

    def at(rate: int) -> Smoothed:
        t = np.arange(4 * rate + 1) / rate
        x = 3 * np.where(t < 1.5, t, np.where(t < 2.5, 1.5, t - 1))
        h, a_m = 0.3 + 0.01 * np.sin(3 * t) + 2e-3 * x, np.cos(5 * t)
        c = C._replace(sigma_h=5e-3 * np.sqrt(rate / 20), sigma_r=0.5)
        return smooth(recorded(t, x, a_m, h, np.sin(2 * t)[:, None], 2 * np.cos(t)), c)

    runs = [at(20 * 2**p) for p in range(4)]
    states = [run.r[0, :: 2**p] for p, run in enumerate(runs)]
    sigma = [run.sigma_r[0, :: 2**p] for p, run in enumerate(runs)]
    for values in (states, sigma):
        steps = [np.abs(b - a)[1:-1].max() for a, b in pairwise(values)]
        assert steps[1] < 0.6 * steps[0]
        assert steps[2] < 0.6 * steps[1]
