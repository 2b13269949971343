"""Readings in words, what they are of forces, and those of nothing."""

import numpy as np
import pytest

from floatref.errors import InputError
from floatref.vehicle_response import ZHU_HALF_CAR, Kind, Reading, output_matrices


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


KINDS = [Kind.DISPLACEMENT, Kind.VELOCITY, Kind.ACCELERATION]


def test_only_accelerations_of_wheels_feel_their_forces_at_once():
    model = ZHU_HALF_CAR.model()
    _, direct = output_matrices(
        model, [Reading(k, f.name, 1.0) for k in KINDS for f in model.freedoms]
    )
    felt = np.argwhere(direct)
    np.testing.assert_array_equal(felt, [[12, 0], [13, 1]])
    np.testing.assert_allclose(direct[[12, 13], [0, 1]], 1 / 170.0)


def test_readings_of_nothing_are_refused():
    model = ZHU_HALF_CAR.model()
    with pytest.raises(InputError, match="half-car-with-equipment: no readings; give those"):
        output_matrices(model, [])
    with pytest.raises(InputError, match="no freedom 'roll'; it has equipment, body"):
        output_matrices(model, [Reading(Kind.VELOCITY, "roll", 1.0)])
    with pytest.raises(InputError, match="no freedom 'roof'"):
        output_matrices(model, [Reading(Kind.VELOCITY, "body", 1.0, minus="roof")])
