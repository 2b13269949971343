"""Gains of the observer: the poles that the default puts, the paper's counting, and refusals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import IMINE_TRAILER, Kind, Reading, default_gains
from floatref.vehicle_response.estimators.gains import gain_matrix, output_matrix
from floatref.vehicle_response.estimators.unknown_inputs import observer_equations

TRAILER = IMINE_TRAILER.model()
ALL = [Reading(Kind.DISPLACEMENT, freedom.name, 1e-4) for freedom in TRAILER.freedoms]


@settings(deadline=None, max_examples=25)
@given(position_hz=st.floats(0.5, 50.0), ratio=st.floats(0.01, 0.99))
def test_a_wheel_has_its_poles_at_the_two_frequencies(position_hz, ratio):
    gains = default_gains(TRAILER, ALL, position_hz, ratio * position_hz)
    gain = gain_matrix(TRAILER, ALL, gains)
    error = observer_equations(TRAILER, gain, output_matrix(TRAILER, ALL)).error
    wheel = error[np.ix_([0, 5], [0, 5])]
    poles = -2 * np.pi * position_hz * np.array([1.0, ratio])
    np.testing.assert_allclose(np.sort(np.linalg.eigvals(wheel).real), poles, rtol=1e-6)
    # Nothing else acts on a wheel's error.
    assert not np.delete(error[[0, 5]], [0, 5], axis=1).any()


def test_the_vector_counts_displacements_first_and_then_velocities():
    matrix = gain_matrix(TRAILER, ALL, np.arange(1.0, 11.0))
    np.testing.assert_array_equal(matrix[:5], np.diag(np.arange(1.0, 6.0)))
    np.testing.assert_array_equal(matrix[5:], np.diag(np.arange(6.0, 11.0)))


def test_a_choice_of_readings_corrects_their_own_freedoms():
    matrix = gain_matrix(TRAILER, [ALL[3], ALL[1]], [1.0, 2.0, 3.0, 4.0])
    expected = np.zeros((10, 2))
    expected[[3, 1, 8, 6], [0, 1, 0, 1]] = [1.0, 2.0, 3.0, 4.0]
    np.testing.assert_array_equal(matrix, expected)


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_whole_matrix_is_taken_as_it_is(seed):
    given_matrix = np.random.default_rng(seed).normal(size=(10, 5))
    np.testing.assert_array_equal(gain_matrix(TRAILER, ALL, given_matrix), given_matrix)


@pytest.mark.parametrize("hertz", [0.0, -1.0, float("nan"), float("inf")])
def test_a_frequency_that_is_none_is_refused(hertz):
    with pytest.raises(InputError, match=f"position_hz is {hertz:g}; give one above zero"):
        default_gains(TRAILER, ALL, hertz)


def test_a_reading_of_another_kind_or_none_is_refused():
    with pytest.raises(InputError, match="not by the velocity of the roll; give the displacement"):
        output_matrix(TRAILER, [*ALL, Reading(Kind.VELOCITY, "roll", 1e-3)])
    with pytest.raises(InputError, match="measures no displacement; give one of every freedom"):
        output_matrix(TRAILER, [])
    with pytest.raises(InputError, match="no freedom 'hitch'; it has left wheel"):
        default_gains(TRAILER, [Reading(Kind.DISPLACEMENT, "hitch", 1e-3)])
