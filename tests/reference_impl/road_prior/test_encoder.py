"""Acceleration along the road from distance: exact for parabolas, and without phase."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_reference.road_prior.encoder import acceleration, inputs, weights


@given(dt=st.floats(0.001, 0.1))
def test_the_weights_show_neither_place_nor_speed(dt):
    w = weights(dt)
    t = dt * (np.arange(w.size) - w.size // 2)
    assert abs(w.sum()) < 1e-9 * np.abs(w).sum()
    assert w @ t == pytest.approx(0.0, abs=1e-9 * np.abs(w * t).sum())
    assert w @ t**2 == pytest.approx(2.0)


@pytest.mark.slow
@given(a=st.floats(-5, 5), v=st.floats(0, 30), rate=st.sampled_from([60, 200, 500]))
def test_a_constant_acceleration_is_found_within_the_run(a, v, rate):
    t = np.arange(2 * rate) / rate
    found, reach = acceleration(v * t + a * t**2 / 2, 1 / rate), weights(1 / rate).size // 2
    np.testing.assert_allclose(found[reach:-reach], a, atol=1e-6)


def test_at_either_end_the_distances_go_on_turned_about_the_last():
    """A parabola turned about its end has no curvature there."""
    t = np.arange(200) / 100
    found = acceleration(t**2, 0.01)
    assert abs(found[[0, -1]]).max() < 1e-9
    np.testing.assert_allclose(found, found[::-1], atol=1e-9)


def test_the_response_settles_at_the_acceleration():
    t = np.arange(1500) / 100
    a_x, product = inputs(t**2, 0.01)
    assert product[700] == pytest.approx(a_x[700] ** 2, rel=1e-6)


def test_a_run_shorter_than_the_weights_is_refused():
    with pytest.raises(ValueError, match="12 to either side"):
        acceleration(np.zeros(12), 0.01)
