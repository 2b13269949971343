"""What is put into a profile comes out as a feature: scale, lag, motion, the other wheel path."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.resemblance.band_fits import find_lag
from floatref_conformance.resemblance.event_features import list_event
from floatref_conformance.resemblance.road_features import (
    list_gain,
    list_holds,
    list_motion,
    list_pairs,
    list_waves,
)


def values(features):
    return {name: value for name, value, _ in features}


@settings(max_examples=6, deadline=None)
@given(st.floats(-0.5, 2.0), st.floats(-1.5, 1.5))
def test_scale_and_lag_are_found_one_beside_the_other(gain, lag_m):
    def change(x, truth, body):
        return (1 + gain) * np.interp(x - lag_m, x, truth)

    path = MAKE(change)
    if 1 + gain > 0.1:
        found = values(list_gain(path))
        assert found["gain"] == pytest.approx(gain, abs=0.03 * (1 + gain))
        assert found["late"] == pytest.approx(lag_m / 20.0, abs=0.001)
        assert found["left"] < 0.1


@settings(max_examples=6, deadline=None)
@given(st.floats(-1.0, 1.0), st.floats(-0.05, 0.05), st.integers(0, 99))
def test_the_motion_of_the_body_is_found_with_its_delay(share, late_s, seed):
    def change(x, truth, body):
        return truth + share * body + late_s * 20.0 * np.gradient(body, x)

    found = values(list_motion(MAKE(change, seed)))
    assert found["motion"] == pytest.approx(share, abs=1e-6)
    assert found["motion rate"] == pytest.approx(late_s, abs=1e-6)
    assert found["road"] == pytest.approx(0.0, abs=1e-6)
    assert found["strange"] < 1e-6


def test_a_turned_sign_is_a_gain_of_minus_two_in_every_band():
    found = values(list_waves(MAKE(lambda x, truth, body: -truth)))
    assert [found[f"gain {n}"] for n in range(5)] == pytest.approx([-2.0] * 5, abs=0.1)


def test_a_stretched_axis_is_a_lag_that_grows(make_path):
    path = make_path(lambda x, truth, body: np.interp(x / 1.003, x, truth))
    assert values(list_waves(path))["lag grows"] == pytest.approx(0.003 * 400 * 2 / 3, abs=0.1)


def test_the_share_of_the_other_path_is_found(make_path):
    one, other = make_path(lambda x, t, b: t, 1), make_path(lambda x, t, b: t, 2)
    for share in (0.0, 0.5, 1.0):
        mixed = make_path(lambda x, t, b, s=share: (1 - s) * t + s * other.truth, 1)
        assert values(list_pairs([mixed, other]))["other path"] == pytest.approx(share, abs=1e-6)
    assert one.truth.size == other.truth.size


def test_steps_are_holds_and_a_straight_line_at_an_event_lacks_short_waves(make_path):
    held = make_path(lambda x, t, b: t[np.arange(t.size) // 10 * 10])
    assert values(list_holds(held))["same"] == pytest.approx(0.9, abs=0.01)
    near = slice(1700, 2300)

    def straighten(x, truth, body):
        z = truth.copy()
        z[near] = np.linspace(z[near][0], z[near][-1], 600)
        return z

    lacking, whole = (
        values(list_event(make_path(change), (200.0,)))
        for change in (straighten, lambda x, t, b: t)
    )
    assert lacking["short waves"] < -2.0
    assert lacking["straight"] == pytest.approx(60.0, abs=1.0)
    assert whole["short waves"] == pytest.approx(0.0, abs=1e-9)
    assert whole["straight"] < 1.0


@pytest.mark.parametrize("lag_m", [-1.23, 0.0, 0.04, 0.77])
def test_a_lag_has_its_sign(make_path, lag_m):
    path = make_path(lambda x, t, b: np.interp(x - lag_m, x, t))
    assert find_lag(path.found, path.truth, 2.0) == pytest.approx(lag_m, abs=0.02)


@pytest.fixture(autouse=True)
def _made_by_hand(make_path):
    global MAKE
    MAKE = make_path
