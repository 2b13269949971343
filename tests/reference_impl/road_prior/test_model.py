"""The discretization against the differential equations, and against itself in smaller steps."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_prior import model
from floatref_reference.road_prior.symbols import Constants, Recorded, recorded

C = Constants(sigma_a=0.03, sigma_b0=0.02, sigma_b1=0.05, q=2e-3, g=5e-3, lambda_p=3.0)


def split(run: Recorded, part: float, travelled: float) -> Recorded:
    """Put a sample into the only step, at a share of its time and one of its distance."""

    def between(x: np.ndarray, share: float) -> np.ndarray:
        return np.stack([x[..., 0], x[..., 0] + share * (x[..., 1] - x[..., 0]), x[..., 1]], -1)

    u = between(run.u.swapaxes(1, 2), part).swapaxes(1, 2)
    return recorded(
        between(run.t, part),
        between(run.distance, travelled),
        between(run.a_m, part),
        np.full((len(run.u), 3), np.nan),
        u,
        run.a_x[0],
        run.shared,
    )


def one_step(seed: int, n: int, J: int, shared: bool) -> Recorded:
    rng = np.random.default_rng(seed)
    t, x = [0.0, rng.uniform(1e-3, 2.0)], [0.0, 10 ** rng.uniform(-3, 2.8)]
    u, no_height = rng.normal(size=(n, 2, J)), np.full((n, 2), np.nan)
    return recorded(t, x, rng.normal(size=(n, 2)), no_height, u, rng.normal(), shared)


@settings(deadline=None, max_examples=30)
@given(
    seed=st.integers(0, 9999),
    n=st.integers(1, 3),
    J=st.integers(0, 3),
    shared=st.booleans(),
    part=st.floats(0.01, 0.99),
    travelled=st.floats(0, 1),
)
def test_two_steps_are_one(
    seed: int, n: int, J: int, shared: bool, part: float, travelled: float
) -> None:
    whole = one_step(seed, n, J, shared)
    halves = split(whole, part, travelled)
    F_0, F_1 = (model.transition(halves, k, C) for k in range(2))
    g_0, g_1 = (model.known_input(halves, k) for k in range(2))
    Q_0, Q_1 = (model.process_noise(halves, k, C) for k in range(2))
    F, g, Q = F_1 @ F_0, F_1 @ g_0 + g_1, F_1 @ Q_0 @ F_1.T + Q_1
    assert model.transition(whole, 0, C) == pytest.approx(F, rel=1e-12, abs=1e-14)
    assert model.known_input(whole, 0) == pytest.approx(g, rel=1e-11, abs=1e-14)
    assert model.process_noise(whole, 0, C) == pytest.approx(Q, rel=1e-10, abs=1e-18)


@settings(deadline=None, max_examples=15)
@given(u=st.floats(-3, 3), a_x=st.floats(-4, 4), V=st.floats(0, 20), dt=st.floats(0.01, 1.0))
def test_a_step_solves_the_differential_equations(
    u: float, a_x: float, V: float, dt: float
) -> None:
    """Euler's method with 2^24 steps, which doubling brings about in 24."""
    A, L = np.zeros((6, 6)), np.zeros((6, 6))
    A[0, 1], A[1, 2], A[1, 5] = 1, -1, -u
    A[3, 3], A[3, 4], A[4, 4] = -V / C.lambda_p, V, -V / C.lambda_p
    L[1, 1], L[3, 3], L[4, 4] = C.sigma_a**2, C.q * V, C.g * V
    L[2, 2] = C.sigma_b0**2 + (C.sigma_b1 * a_x) ** 2
    h = dt / 2**24
    F, Q = np.eye(6) + h * A, h * L
    for _ in range(24):
        F, Q = F @ F, F @ Q @ F.T + Q
    held = recorded([0, dt], [0, V * dt], [0, 0], [0, 0], [[u], [u]], a_x)
    assert model.transition(held, 0, C) == pytest.approx(F, rel=1e-4, abs=1e-6)
    assert model.process_noise(held, 0, C) == pytest.approx(Q, rel=1e-4, abs=1e-12)


@settings(deadline=None, max_examples=20)
@given(
    a=st.tuples(st.floats(-5, 5), st.floats(-5, 5)),
    u=st.tuples(st.floats(-5, 5), st.floats(-5, 5)),
    dt=st.floats(0.01, 1.0),
)
def test_a_ramp_is_integrated_as_a_ramp(
    a: tuple[float, float], u: tuple[float, float], dt: float
) -> None:
    """With κ = 2, from rest: v and r by the sums of a hundred thousand rectangles."""
    run = recorded([0, dt], [0, 0], a, [0, 0], np.reshape(u, (2, 1)))
    x = model.transition(run, 0, C) @ [0, 0, 0, 0, 0, 2] + model.known_input(run, 0)
    share = (np.arange(100000) + 0.5) / 100000
    force = a[0] - 2 * u[0] + share * (a[1] - a[0] - 2 * (u[1] - u[0]))
    v, r = dt * np.mean(force), dt**2 * np.mean(force * (1 - share))
    assert x == pytest.approx([r, v, 0, 0, 0, 2], abs=1e-8)


@settings(deadline=None, max_examples=20)
@given(dt=st.floats(1e-4, 120), distance=st.floats(0, 1e5))
def test_a_road_under_a_standing_vehicle_stays(dt: float, distance: float) -> None:
    run = recorded([0, dt], [distance, distance], [1, 2], [0, 0], [[1], [2]], a_x=3.0)
    F, Q = model.transition(run, 0, C), model.process_noise(run, 0, C)
    assert np.array_equal(F[3:5], [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0]])
    assert not Q[3:5].any()
    assert not Q[:, 3:5].any()


def test_each_track_has_its_own_constants_or_all_have_the_same() -> None:
    c = Constants(sigma_kappa=(0.1, 0.2))
    for shared, places in [(True, [10, 11]), (False, [10, 11, 12, 13])]:
        run = one_step(3, 2, 2, shared)
        F, P = model.transition(run, 0, c), model.prior(run, c)
        assert np.flatnonzero(F[1, 10:]).tolist() == [0, 1]
        assert (np.flatnonzero(F[6, 10:]) + 10).tolist() == places[-2:]
        assert np.sqrt(np.diag(P)[10:]) == pytest.approx([0.1, 0.2] * (len(places) // 2))
