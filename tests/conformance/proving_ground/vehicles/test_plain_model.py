"""Laws of a linear model of a paper: energy, rest on a lifted road, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref_conformance.proving_ground.roads.road import flat_road
from floatref_conformance.proving_ground.vehicles.linear_models import QUARTER_CAR, ZHU_HALF_CAR
from floatref_conformance.proving_ground.vehicles.parameter_sets import LINEAR_MODELS, find_vehicle
from floatref_conformance.proving_ground.vehicles.plain_model import PlainModel
from floatref_conformance.proving_ground.vehicles.response import Response, equilibrium

every_model = pytest.mark.parametrize("name", sorted(LINEAR_MODELS))


def energy(model: PlainModel, states: np.ndarray) -> np.ndarray:
    size = len(model.coordinates)
    q, v = states[:, :size], states[:, size : 2 * size]
    return 0.5 * np.einsum("ki,ij,kj->k", q, model.stiffness(), q) + 0.5 * v**2 @ model.masses()


@settings(deadline=None, max_examples=10)
@given(seed=st.integers(0, 10**6), name=st.sampled_from(sorted(LINEAR_MODELS)))
def test_free_decay_loses_energy_and_keeps_it_without_dampers(seed: int, name: str) -> None:
    model, rng, count = LINEAR_MODELS[name], np.random.default_rng(seed), 4000
    size = len(model.coordinates)
    undamped = replace(
        model,
        paper_damping=np.zeros((size, size)),
        tyres=tuple(replace(tyre, damping=0.0) for tyre in model.tyres),
    )
    start = np.zeros(22)
    start[: 2 * size] = 0.01 * rng.standard_normal(2 * size)
    kept = {}
    for which in (model, undamped):
        response = Response.of(which, flat_road(10.0), 1 / 8000, np.zeros(2))
        response.vector[:] = start
        states = np.empty((count, 22))
        response.advance(np.zeros(count), np.zeros((2, count)), np.arange(count), states)
        kept[which] = energy(which, np.vstack([start, states]))
    assert np.ptp(kept[undamped]) < 1e-9 * kept[undamped][0]
    assert np.all(np.diff(kept[model]) <= 1e-12 * kept[model][0])
    assert kept[model][-1] < kept[model][0] * (1 - 1e-4)


@every_model
def test_a_lifted_road_lifts_wheels_and_axles_by_as_much(name: str) -> None:
    """The trailer's chassis turns about its axle, for no hitch holds it; its axle rises."""
    model = LINEAR_MODELS[name]
    rest = equilibrium(model, np.array([*4 * [0.02], 0.0, 0.0]))
    heights = [i for i, c in enumerate(model.coordinates) if c.channel not in ("pitch", "roll")]
    if name == "imine-trailer":
        heave, pitch, roll = (rest[i] for i in (2, 4, 3))
        assert heave + 0.6 * pitch == pytest.approx(0.02, abs=1e-12)
        assert roll == pytest.approx(0.0, abs=1e-12)
        heights = [0, 1]
    assert rest[heights] == pytest.approx(np.full(len(heights), 0.02), abs=1e-12)
    moment = rest @ (model.masses() * _free(model))
    assert moment == pytest.approx(0.0, abs=1e-9)


def _free(model: PlainModel) -> np.ndarray:
    """Return the motion without a spring; zeros if there is none."""
    values, vectors = np.linalg.eigh(model.stiffness())
    return vectors[:, 0] if values[0] < 1e-6 else np.zeros(values.size)


def test_models_that_do_not_fit_are_refused() -> None:
    crooked = ZHU_HALF_CAR.paper_stiffness.copy()
    crooked[0, 1] *= 2
    with pytest.raises(InputError, match="vehicle zhu-half-car: a matrix is not symmetric"):
        replace(ZHU_HALF_CAR, paper_stiffness=crooked)
    with pytest.raises(InputError, match="more than 7 freedoms or 4 tyres"):
        replace(QUARTER_CAR, tyres=5 * QUARTER_CAR.tyres)
    with pytest.raises(InputError, match="did you mean zhu-half-car"):
        find_vehicle("zhu-halfcar")
