"""Readings in words, and those that tell nothing."""

import pytest

from floatref.errors import InputError
from floatref.vehicle_response import Kind, Reading


def test_a_reading_says_what_it_is_of():
    assert str(Reading(Kind.ACCELERATION, "front wheel", 0.1)) == "acceleration of the front wheel"
    deflection = Reading(Kind.DISPLACEMENT, "body", 1e-3, minus="wheel")
    assert str(deflection) == "displacement of the body against the wheel"


@pytest.mark.parametrize("sigma", [0.0, -1.0, float("nan"), float("inf")])
def test_a_standard_deviation_is_a_number_above_zero(sigma):
    with pytest.raises(InputError, match="velocity of the body: sigma is"):
        Reading(Kind.VELOCITY, "body", sigma)


def test_nothing_is_measured_against_itself():
    with pytest.raises(InputError, match="against itself"):
        Reading(Kind.DISPLACEMENT, "body", 1e-3, minus="body")
