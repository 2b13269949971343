"""What readings are of states and forces, against the motion itself."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import ZHU_HALF_CAR, Kind, Reading, output_matrices, state_space

KINDS = [Kind.DISPLACEMENT, Kind.VELOCITY, Kind.ACCELERATION]


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 2**32 - 1))
def test_readings_are_derivatives_of_freedoms_and_their_differences(seed, drawn_parameters):
    rng = np.random.default_rng(seed)
    for parameters in drawn_parameters(seed):
        model = parameters.model()
        names = [freedom.name for freedom in model.freedoms]
        readings = [Reading(k, n, 0.1) for k in KINDS for n in names]
        readings += [Reading(k, names[1], 0.1, minus=names[0]) for k in KINDS]
        state, force = rng.normal(size=2 * len(names)), 1e3 * rng.normal(size=len(model.tyres))
        output, direct = output_matrices(model, readings)
        a, b = state_space(model)
        q, rate = np.split(state, 2)
        acceleration = (a @ state + b @ force)[len(names) :]
        motion = [q, rate, acceleration]
        wanted = np.concatenate([*motion, [m[1] - m[0] for m in motion]])
        found = output @ state + direct @ force
        np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


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
