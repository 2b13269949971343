"""The road from the force of a tyre, against F = k·u + c·u' itself."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.response import Tyre, TyreRoad

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=25)
STEP = 1 / 200
STIFF, SOFT, BARE = Tyre("a", 2e5, 300.0), Tyre("b", 3e4, 2000.0), Tyre("c", 1.4e6)


def road_of(tyres, force, sigma=None):
    sigma = np.ones(force.shape) if sigma is None else sigma
    return TyreRoad(tyres, STEP).advance(force, sigma)


def finely(tyre, force, fine=4000):
    """Return u after each sample, by the rule of midpoints in fine steps, forces linear."""
    road, h = [force[0] / tyre.stiffness], STEP / fine
    for first, last in pairwise(force):
        u = road[-1]
        for at in range(fine):
            push = first + (last - first) * (at + 0.5) / fine
            half = u + h / 2 * (push - tyre.stiffness * u) / tyre.damping
            u += h * (push - tyre.stiffness * half) / tyre.damping
        road.append(u)
    return np.array(road)


@pytest.mark.parametrize("tyre", [STIFF, SOFT])
def test_the_road_is_exact_for_forces_that_change_linearly(tyre):
    force = 1e3 * np.random.default_rng(0).normal(size=8)
    found, _ = road_of([tyre], force[:, None])
    np.testing.assert_allclose(found[:, 0], finely(tyre, force), rtol=1e-5)


@laws
@given(slope=st.floats(-1.0, 1.0), height=st.floats(-0.1, 0.1))
def test_an_even_slope_is_found_once_the_start_has_faded(slope, height):
    time = STEP * np.arange(400)
    u = height + slope * time
    force = np.stack([t.stiffness * u + t.damping * slope for t in (STIFF, SOFT)], axis=1)
    found, _ = road_of([STIFF, SOFT], force)
    np.testing.assert_allclose(found[-50:], np.stack([u, u], axis=1)[-50:], atol=1e-9)


@laws
@given(seed=SEEDS)
def test_without_damping_it_is_force_over_stiffness(seed):
    force = np.random.default_rng(seed).normal(size=(50, 1))
    found, sigma = road_of([BARE], force, np.full((50, 1), 700.0))
    np.testing.assert_allclose(found, force / 1.4e6, rtol=1e-12)
    np.testing.assert_allclose(sigma, 0.0005, rtol=1e-12)


@laws
@given(seed=SEEDS, cut=st.integers(0, 60))
def test_parts_of_a_drive_give_the_same_as_all_of_it(seed, cut):
    rng = np.random.default_rng(seed)
    force, sigma = rng.normal(size=(60, 3)), rng.uniform(0.1, 2.0, (60, 3))
    force[rng.random((60, 3)) < 0.3] = np.nan
    tyres = [STIFF, SOFT, BARE]
    parts = TyreRoad(tyres, STEP)
    streamed = [parts.advance(force[s], sigma[s]) for s in (slice(cut), slice(cut, None))]
    whole = road_of(tyres, force, sigma)
    for found, wanted in zip(map(np.concatenate, zip(*streamed, strict=True)), whole, strict=True):
        np.testing.assert_array_equal(found, wanted)


@laws
@given(seed=SEEDS)
def test_a_missing_force_gives_no_road_and_counts_as_the_one_before(seed):
    rng = np.random.default_rng(seed)
    force, known = rng.normal(size=(40, 1)), rng.random((40, 1)) < 0.7
    known[5] = True
    found, sigma = road_of([SOFT], np.where(known, force, np.nan))
    np.testing.assert_array_equal(np.isfinite(found), known)
    np.testing.assert_array_equal(np.isfinite(sigma), known)
    begin = int(np.argmax(known))
    held = force[begin:].copy()
    for at in range(1, len(held)):
        if not known[begin + at]:
            held[at] = held[at - 1]
    wanted, _ = road_of([SOFT], held)
    np.testing.assert_array_equal(found[begin:][known[begin:]], wanted[known[begin:]])


@laws
@given(seed=SEEDS)
def test_no_error_within_one_sigma_of_force_leaves_that_of_the_road(seed):
    rng = np.random.default_rng(seed)
    force, sigma = rng.normal(size=(80, 2)), rng.uniform(0.1, 2.0, (80, 2))
    error = sigma * rng.choice([-1.0, 1.0], (80, 2))
    if seed % 2:
        error = sigma
    road, spread = road_of([STIFF, SOFT], force, sigma)
    wrong, _ = road_of([STIFF, SOFT], force + error, sigma)
    assert (np.abs(wrong - road) <= spread * (1 + 1e-9)).all()


def test_wrong_shapes_and_steps_are_refused():
    with pytest.raises(InputError, match=r"forces of shape \(4, 2\) .* must be \(samples, 1\)"):
        road_of([STIFF], np.ones((4, 2)))
    with pytest.raises(InputError, match=r"forces of shape \(4, 1\) with .* of \(3, 1\)"):
        road_of([STIFF], np.ones((4, 1)), np.ones((3, 1)))
    for step in (0.0, float("nan")):
        with pytest.raises(InputError, match="a time step of"):
            TyreRoad([STIFF], step)
