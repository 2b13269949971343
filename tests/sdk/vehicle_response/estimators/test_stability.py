"""Gains are judged by the eigenvalues of the error matrix; a refusal says what to raise."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.sdk.vehicle_response.estimators.observers import readings

from floatref.errors import InputError
from floatref.vehicle_response import (
    IMINE_TRAILER,
    ZHU_HALF_CAR,
    QuarterCar,
    UnknownInputObserver,
    default_gains,
)

FEW = settings(deadline=None, max_examples=25)
SEEDS = st.integers(0, 2**32 - 1)
MODELS = {
    "quarter car": QuarterCar(350.0, 40.0, 20e3, 1500.0, 200e3).model(),
    "half car": ZHU_HALF_CAR.model(),
    "trailer": IMINE_TRAILER.model(),
}
NAMES = st.sampled_from(sorted(MODELS))


def observer(model, gains, *without):
    return UnknownInputObserver.of(model, 0.005, gains, readings(model, *without), 0.05)


@pytest.mark.cites("(15) of Imine")
@FEW
@given(seed=SEEDS, name=NAMES)
def test_positive_gains_on_every_freedom_are_stable_and_their_time_is_told(seed, name):
    model, rng = MODELS[name], np.random.default_rng(seed)
    gains = rng.uniform(0.5, 50.0, 2 * len(model.freedoms))
    watch = observer(model, gains)
    slowest = np.linalg.eigvals(watch.error_matrix).real.max()
    assert slowest < 0
    assert watch.settling_s == pytest.approx(-10.0 / slowest, rel=1e-6)


@FEW
@given(seed=SEEDS, name=NAMES)
def test_who_raises_the_named_gain_again_and_again_comes_to_a_stable_observer(seed, name):
    model, rng = MODELS[name], np.random.default_rng(seed)
    gains = rng.uniform(-20.0, 40.0, 2 * len(model.freedoms))
    for _ in range(200):
        try:
            observer(model, gains)
        except InputError as refusal:
            named = re.search(r"raise g(\d+),", str(refusal))
            gains[int(named.group(1)) - 1] += 10.0
        else:
            return
    pytest.fail(f"still refused with the gains {gains}")


@pytest.mark.parametrize(
    ("name", "gain", "value", "said"),
    [
        ("quarter car", 2, 0.0, r"eigenvalue 0 ± 28\.1j 1/s in the motion of the wheel; raise g2,"),
        (
            "trailer",
            7,
            -1.0,
            "in the motion of the right wheel; raise g7,.* corrects its velocity$",
        ),
        (
            "half car",
            4,
            -60.0,
            "in the motion of the front wheel; raise g4,.* corrects that displacement$",
        ),
    ],
)
def test_one_bad_gain_is_named_with_its_freedom(name, gain, value, said):
    model = MODELS[name]
    gains = default_gains(model, readings(model))
    gains[gain - 1] = value
    with pytest.raises(InputError, match=said) as refusal:
        observer(model, gains)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("name", "without"),
    [
        ("quarter car", ["wheel"]),
        ("half car", ["rear wheel"]),
        ("half car", ["front wheel", "equipment"]),
        ("trailer", ["left wheel"]),
    ],
)
def test_a_wheel_whose_displacement_no_sensor_tells_is_named(name, without):
    model = MODELS[name]
    gains = default_gains(model, readings(model, *without))
    with pytest.raises(
        InputError, match=f"motion of the {without[0]}; .* measure its displacement$"
    ):
        observer(model, gains, *without)


def test_a_chassis_that_no_spring_and_no_sensor_holds_is_named():
    model, without = MODELS["trailer"], ("chassis", "pitch")
    gains = default_gains(model, readings(model, *without))
    with pytest.raises(InputError, match=r"of the (chassis|pitch); .* measure its displacement$"):
        observer(model, gains, *without)
    observer(model, default_gains(model, readings(model, "pitch")), "pitch")
