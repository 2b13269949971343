"""The observer with unknown inputs follows the road and all states, and knows what it does not."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from tests.sdk.vehicle_response.estimators.observers import readings

from floatref.errors import InputError
from floatref.vehicle_response import (
    IMINE_TRAILER,
    ZHU_HALF_CAR,
    Kind,
    QuarterCar,
    Reading,
    UnknownInputObserver,
    default_gains,
)

FEW = settings(deadline=None, max_examples=10)
SEEDS = st.integers(0, 2**32 - 1)
STEP = 1.0 / 128.0
QUARTER_CAR = QuarterCar(350.0, 40.0, 20e3, 1500.0, 200e3, 100.0).model()
MODELS = {"quarter car": QUARTER_CAR, "half car": ZHU_HALF_CAR.model()} | {
    "trailer": IMINE_TRAILER.model(),
    "trailer on undamped tyres": replace(
        IMINE_TRAILER, left_tyre_ns_per_m=0.0, right_tyre_ns_per_m=0.0
    ).model(),
}


def observer(model, *without, **how):
    chosen = readings(model, *without)
    how = {"step_s": STEP, "gains": default_gains(model, chosen), "acceleration_sigma": 0.05} | how
    return UnknownInputObserver.of(model, measured=chosen, **how)


def driven(model, seconds):
    """Road, states and wheel accelerations of a road of three waves: what (7) makes of each."""
    times, found = np.arange(0.0, seconds, STEP)[:, None], []
    tyres = model.tyres
    late = 0.1 * np.arange(len(tyres))
    for rate in 2j * np.pi * np.array([1.1, 2.3, 4.7]):
        road = 1e-3 * np.exp(-rate * late)
        force = road * [tyre.stiffness + rate * tyre.damping for tyre in tyres]
        resists = model.mass * rate**2 + model.damping * rate + model.stiffness
        q = np.linalg.solve(resists, model.selection @ force)
        wheels = q[[model.index(tyre.freedom) for tyre in tyres]]
        parts = np.concatenate([road, q, rate * q, rate**2 * wheels])
        found.append((parts * np.exp(rate * times)).imag)
    p, n = len(tyres), len(model.freedoms)
    return np.split(sum(found), [p, p + 2 * n], axis=1)


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_a_smooth_road_and_all_states_are_followed(name):
    model = MODELS[name]
    road, states, accelerations = driven(model, 6.0)
    found = observer(model).estimate(states[:, : len(model.freedoms)], accelerations)
    settled = ~np.isnan(found.road[:, 0])
    assert found.force is None
    assert settled.sum() > 300
    assert np.abs(found.road - road)[settled].max() <= 0.005 * np.abs(road).max()
    error = np.abs(found.states - states)[settled].max(axis=0)
    assert (error <= 0.005 * np.abs(states).max(axis=0)).all()


@pytest.mark.parametrize(
    ("name", "without"),
    [("quarter car", ["body"]), ("half car", ["equipment", "pitch"]), ("trailer", ["chassis"])],
)
def test_states_that_no_sensor_measures_are_estimated(name, without):
    model = MODELS[name]
    road, states, accelerations = driven(model, 25.0)
    chosen = [model.index(reading.freedom) for reading in readings(model, *without)]
    found = observer(model, *without).estimate(states[:, chosen], accelerations)
    settled = ~np.isnan(found.road[:, 0])
    assert settled.sum() > 300
    for freedom in map(model.index, without):
        for place in (freedom, freedom + len(model.freedoms)):
            error = np.abs(found.states - states)[settled, place].max()
            assert error <= 0.01 * np.abs(states[:, place]).max()
    assert np.abs(found.road - road)[settled].max() <= 0.005 * np.abs(road).max()


@FEW
@given(seed=SEEDS, name=st.sampled_from(sorted(MODELS)))
def test_an_error_of_the_start_goes_as_the_error_matrix_says(seed, name):
    model = MODELS[name]
    first = np.random.default_rng(seed).normal(size=len(model.freedoms))
    y = np.zeros((50, first.size))
    y[0] = first
    watch = observer(model, degree=1)
    # At rest in truth and displaced in the observer: the estimate is the error.
    error = watch.estimate(y, np.zeros((50, len(model.tyres)))).states
    own = watch.error_matrix[: 2 * first.size, : 2 * first.size]
    for k in (5, 20, 49):
        expected = expm((k - 1) * STEP * own) @ error[1]
        scale = np.abs(error[1]).max()
        assert np.abs(error[k] - expected).max() <= 1e-9 * scale


@FEW
@given(seed=SEEDS, name=st.sampled_from(sorted(MODELS)), lost=st.sets(st.integers(0, 199)))
def test_parts_of_any_length_give_the_same_bits(seed, name, lost):
    model, rng = MODELS[name], np.random.default_rng(seed)
    y, a = rng.normal(size=(200, len(model.freedoms))), rng.normal(size=(200, len(model.tyres)))
    y[list(lost), 0] = np.nan
    watch = observer(model, gains=default_gains(model, readings(model), 20.0, 15.0))
    whole, memory, parts = watch.estimate(y, a), watch.begin(), []
    for part in np.split(np.arange(200), np.sort(rng.integers(0, 200, 5))):
        parts.append(copy.copy(watch.advance(memory, y[part], a[part])))
    for field in ("road", "road_sigma", "states", "states_sigma"):
        joined = np.concatenate([getattr(part, field) for part in parts])
        np.testing.assert_array_equal(joined, getattr(whole, field))


@pytest.mark.parametrize("which", ["a displacement", "an acceleration", "all"])
def test_what_is_absent_is_told_until_its_error_has_decayed(which):
    model = MODELS["trailer"]
    road, states, accelerations = driven(model, 10.0)
    y, a = states[:, :5].copy(), accelerations.copy()
    begin, end = 500, 520
    if which != "an acceleration":
        y[begin:end, 0 if which == "a displacement" else slice(None)] = np.nan
    if which != "a displacement":
        a[begin:end, 1 if which == "an acceleration" else slice(None)] = np.nan
    watch = observer(model)
    found = watch.estimate(y, a)
    silent = np.isnan(found.road).all(axis=1)
    settling = round(watch.settling_s / STEP)
    np.testing.assert_array_equal(silent, np.isnan(found.road).any(axis=1))
    np.testing.assert_array_equal(silent, np.isnan(found.road_sigma[:, 0]))
    np.testing.assert_array_equal(silent, np.isnan(found.states_sigma[:, 0]))
    assert silent[:settling].all()
    assert not silent[settling + 2 : begin].any()
    assert silent[begin : end + settling - 2].all()
    assert not silent[end + settling + 2 :].any()
    assert np.abs(found.road - road)[~silent].max() <= 0.005 * np.abs(road).max()


def test_while_displacements_are_absent_the_accelerations_carry_the_states_on():
    model = MODELS["quarter car"]
    _, states, accelerations = driven(model, 6.0)
    y = states[:, :2].copy()
    y[600:640] = np.nan
    error = np.abs(observer(model).estimate(y, accelerations).states - states)[600:640]
    assert (error.max(axis=0) <= 0.02 * np.abs(states).max(axis=0)).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["quarter car", "trailer on undamped tyres"])
@pytest.mark.parametrize("degree", [1, 3])
def test_sigma_is_the_spread_under_noise_of_the_sensors(name, degree):
    model, rng = MODELS[name], np.random.default_rng(4)
    chosen = readings(model)
    gains = default_gains(model, chosen, 20.0, 5.0)
    watch = observer(model, gains=gains, degree=degree)
    y = rng.normal(0.0, 1e-4, (200_000, len(chosen)))
    found = watch.estimate(y, rng.normal(0.0, 0.05, (y.shape[0], len(model.tyres))))
    for values, sigma in (
        (found.road, found.road_sigma),
        (found.states, found.states_sigma),
    ):
        np.testing.assert_allclose(values[1000:].std(axis=0), sigma[-1], rtol=0.03)


def test_a_suspension_deflection_serves_as_the_reading_of_the_body():
    model = MODELS["quarter car"]
    road, states, accelerations = driven(model, 6.0)
    chosen = [
        Reading(Kind.DISPLACEMENT, "body", 1e-4, minus="wheel"),
        Reading(Kind.DISPLACEMENT, "wheel", 1e-4),
    ]
    watch = UnknownInputObserver.of(model, STEP, default_gains(model, chosen), chosen, 0.05)
    y = np.stack([states[:, 0] - states[:, 1], states[:, 1]], axis=1)
    found = watch.estimate(y, accelerations)
    assert np.nanmax(np.abs(found.road - road)) <= 0.005 * np.abs(road).max()


@pytest.mark.parametrize("damping", [1e-6, 1e-3, 1e-1])
def test_a_tyre_of_little_damping_is_one_of_none(damping):
    rng = np.random.default_rng(3)
    y, a = 1e-3 * rng.normal(size=(600, 5)).cumsum(axis=0), rng.normal(size=(600, 2))
    stiff = replace(IMINE_TRAILER, left_tyre_ns_per_m=damping, right_tyre_ns_per_m=damping)
    found = observer(stiff.model()).estimate(y, a).road
    without = observer(MODELS["trailer on undamped tyres"]).estimate(y, a).road
    # What remains is c/k·u', at most damping/190e3 of the road's rate.
    bound = 1e-7 + damping / 190e3 / STEP * 10.0
    assert np.nanmax(np.abs(found - without)) <= bound * np.nanmax(np.abs(without))


REFUSED = {
    "step_s is 0;": {"step_s": 0.0},
    "step_s is nan;": {"step_s": float("nan")},
    "acceleration_sigma is -1;": {"acceleration_sigma": -1.0},
    "degree is 4;": {"degree": 4},
    r"\(3,\); 2 measured displacements of 2 freedoms need \(4,\) or": {"gains": np.ones(3)},
    "a gain is not a finite number": {"gains": [1.0, np.nan, 1.0, 1.0]},
}


@pytest.mark.parametrize("message", REFUSED)
def test_what_makes_no_observer_is_refused(message):
    with pytest.raises(InputError, match=message) as refusal:
        observer(QUARTER_CAR, **REFUSED[message])
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("y", "a", "message"),
    [
        ((10, 3), (10, 1), r"displacements have the shape \(10, 3\); the observer needs \(10, 2\)"),
        ((10, 2), (9, 1), r"accelerations have the shape \(9, 1\); the observer needs \(10, 1\)"),
        ((10,), (10, 1), r"displacements have the shape \(10,\)"),
        ((), (), r"displacements have the shape \(\)"),
    ],
)
def test_signals_of_another_shape_are_refused(y, a, message):
    with pytest.raises(InputError, match=message):
        observer(QUARTER_CAR).estimate(np.zeros(y), np.zeros(a))


def test_an_infinite_signal_is_refused():
    with pytest.raises(InputError, match="displacements hold an infinite value; give NaN"):
        observer(QUARTER_CAR).estimate(np.full((5, 2), np.inf), np.zeros((5, 1)))
