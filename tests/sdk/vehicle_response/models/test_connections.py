"""Laws of every model: the energy of springs and dampers, and the lift with the road."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import Connection, Freedom, Tyre, connect

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=25)


@laws
@given(seed=SEEDS)
def test_springs_and_dampers_store_and_take_the_energy_of_their_lengthening(seed):
    rng = np.random.default_rng(seed)
    rows, k, c = rng.normal(size=(4, 3)), rng.uniform(0, 9, 4), rng.uniform(0, 9, 4)
    parts = [Connection(tuple(r), *kc) for *kc, r in zip(k, c, rows, strict=True)]
    freedoms = [(Freedom(name, name, name), 1.0) for name in "abc"]
    model = connect("drawn", freedoms, [Tyre("b", 5.0, 2.0)], parts)
    q = rng.normal(size=3)
    stored = k @ (rows @ q) ** 2 + 5.0 * q[1] ** 2
    np.testing.assert_allclose(q @ model.stiffness @ q, stored, rtol=1e-12)
    taken = c @ (rows @ q) ** 2 + 2.0 * q[1] ** 2
    np.testing.assert_allclose(q @ model.damping @ q, taken, rtol=1e-12)


@laws
@given(seed=SEEDS)
def test_a_vehicle_rises_with_the_road(seed, drawn_parameters):
    for parameters in drawn_parameters(seed):
        model = parameters.model()
        lifted = np.array([0.0 if f.angular else 1.0 for f in model.freedoms])
        stiffness = [tyre.stiffness for tyre in model.tyres]
        damping = [tyre.damping for tyre in model.tyres]
        for matrix, tyres in ((model.stiffness, stiffness), (model.damping, damping)):
            force = model.selection @ tyres
            scale = np.abs(matrix).max()
            np.testing.assert_allclose(matrix @ lifted, force, atol=1e-12 * scale)


@pytest.mark.parametrize("row", [(), (1.0,), (1.0, -1.0, 0.0)])
def test_a_row_has_a_number_for_each_freedom(row):
    freedoms = [(Freedom(name, name, name), 1.0) for name in "ab"]
    with pytest.raises(InputError, match=r"^model drawn: .* give a number for each of a, b$"):
        connect("drawn", freedoms, [Tyre("b", 5.0)], [Connection(row, 1.0)])
