"""Tyres that follow each other tell one road, (8) of Zhu."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import join_at_speed, join_roads, shift

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=25)
STEP, COUNT = 0.05, 600
DISTANCE = 20.0 + STEP * np.arange(COUNT)
AXLES = (-3.19, 6.19)


def road_at(distance):
    return 0.01 * np.sin(2 * np.pi * distance / 7.0) + 0.002 * np.cos(2 * np.pi * distance / 1.1)


@laws
@given(axles=st.tuples(*[st.floats(-8.0, 8.0)] * 2))
def test_every_tyre_of_one_road_tells_it_at_its_place(axles):
    roads = [road_at(DISTANCE + x) for x in axles]
    found, sigma = join_roads(roads, [np.full(COUNT, 1e-3)] * 2, axles, DISTANCE)
    known = np.isfinite(found)
    # One tyre or the other has been at all but what both leave out at an end.
    out = max(max(min(axles), 0) + min(-max(axles), 0), 0)
    assert known.sum() >= COUNT - 2 * out / STEP - max(np.abs(axles)) / STEP - 8
    np.testing.assert_allclose(found[known], road_at(DISTANCE)[known], atol=2e-6)
    np.testing.assert_allclose(sigma[known], 1e-3)


@laws
@given(samples=st.integers(-50, 50), seed=SEEDS)
def test_whole_samples_are_copied(samples, seed):
    values = np.random.default_rng(seed).normal(size=40)
    found = shift(values, samples)
    for at in range(40):
        wanted = values[at + samples] if 0 <= at + samples < 40 else np.nan
        np.testing.assert_equal(found[at], wanted)


@laws
@given(samples=st.floats(-5.0, 5.0), seed=SEEDS)
def test_polynomials_of_degree_five_are_kept_between_samples(samples, seed):
    coefficients = np.random.default_rng(seed).normal(size=6)
    place = np.linspace(-1, 1, 40)
    polynomial = np.polynomial.Polynomial(coefficients)
    found = shift(polynomial(place), samples)
    known = np.isfinite(found)
    assert known.sum() >= 40 - 5 - 6
    wanted = polynomial(place + samples * 2 / 39)
    np.testing.assert_allclose(found[known], wanted[known], rtol=1e-6, atol=2e-5)


@laws
@given(seed=SEEDS)
def test_weights_are_one_over_the_variances(seed):
    rng = np.random.default_rng(seed)
    roads, sigmas = rng.normal(size=(2, COUNT)), rng.uniform(0.1, 2.0, (2, COUNT))
    found, sigma = join_roads(roads, sigmas, (0.0, 0.0), DISTANCE)
    np.testing.assert_allclose(found, np.average(roads, axis=0, weights=sigmas**-2.0))
    np.testing.assert_allclose(sigma, np.average(sigmas, axis=0, weights=sigmas**-2.0))
    assert (sigma <= sigmas.max(axis=0)).all()


def test_where_one_tyre_tells_nothing_the_other_does():
    roads = np.stack([road_at(DISTANCE + x) for x in AXLES])
    sigmas = np.full(roads.shape, 1e-3)
    roads[0, 200:300] = np.nan
    sigmas[0, 400] = np.nan
    found, sigma = join_roads(roads, sigmas, AXLES, DISTANCE)
    inner = slice(150, -150)
    np.testing.assert_allclose(found[inner], road_at(DISTANCE)[inner], atol=2e-6)
    assert np.isfinite(sigma[inner]).all()
    alone, _ = join_roads(np.full(roads.shape, np.nan), sigmas, AXLES, DISTANCE)
    assert np.isnan(alone).all()


@pytest.mark.cites("(8) of Zhu")
@laws
@given(speed=st.floats(3.0, 30.0))
def test_at_constant_speed_the_rear_tyre_comes_by_the_delay_later(speed):
    step = STEP / speed
    front = road_at(speed * step * np.arange(COUNT))
    delay = (AXLES[1] - AXLES[0]) / speed
    rear = road_at(speed * (step * np.arange(COUNT) - delay))
    sigmas = [np.full(COUNT, 1e-3)] * 2
    found, _ = join_at_speed([rear, front], sigmas, AXLES, speed, step)
    point = road_at(speed * (step * np.arange(COUNT) - AXLES[1] / speed))
    np.testing.assert_allclose(found[150:-150], point[150:-150], atol=2e-6)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"speed": 0.0}, "a speed of 0 m/s; give a number above zero"),
        ({"speed": float("nan")}, "a speed of nan m/s"),
        ({"step": -1.0}, "a time step of -1 s"),
        ({"roads": [np.ones(9)]}, "1 roads, 2 sigmas and 2 positions"),
        ({"roads": [np.ones(9), np.ones(8)]}, r"shape \(8,\) with sigmas of \(9,\) over 9"),
        ({"sigmas": [np.ones(9), np.zeros(9)]}, "a sigma of 0 m; give numbers above zero"),
        ({"roads": [np.ones(1)] * 2, "sigmas": [np.ones(1)] * 2}, "not in even steps"),
    ],
)
def test_what_cannot_be_joined_is_refused(changed, message):
    kept = {"roads": [np.ones(9)] * 2, "sigmas": [np.ones(9)] * 2, "speed": 10.0, "step": 0.01}
    given_ = {**kept, **changed}
    with pytest.raises(InputError, match=message):
        join_at_speed(given_["roads"], given_["sigmas"], AXLES, given_["speed"], given_["step"])


def test_distances_have_even_steps():
    uneven = np.array([0.0, 1.0, 2.5, 3.0])
    with pytest.raises(InputError, match="not in even steps above zero; resample them"):
        join_roads([np.ones(4)] * 2, [np.ones(4)] * 2, AXLES, uneven)


@pytest.mark.parametrize("x_m", [float("nan"), float("inf")])
def test_tyres_have_a_place(x_m):
    with pytest.raises(InputError, match=rf"^tyres at -3\.19, {x_m:g} m; give finite numbers$"):
        join_roads([np.ones(9)] * 2, [np.ones(9)] * 2, (-3.19, x_m), np.arange(9.0))


@pytest.mark.parametrize(
    ("values", "samples"), [(np.ones((9, 2)), 1.5), (1.0, 1.0), (np.ones(9), float("nan"))]
)
def test_one_channel_is_shifted_by_a_number(values, samples):
    with pytest.raises(InputError, match="give one channel and a finite number"):
        shift(values, samples)


@pytest.mark.parametrize("ahead", [-2.5, -0.5, 0.5, 2.5])
def test_between_two_samples_the_larger_sigma_counts(ahead):
    sigma = np.full(40, 1e-3)
    sigma[20] = 5e-3
    _, found = join_roads([np.zeros(40)], [sigma], (ahead * STEP,), STEP * np.arange(40))
    np.testing.assert_array_equal(
        np.flatnonzero(found > 3e-3), [20 + ahead - 0.5, 20 + ahead + 0.5]
    )
