"""The joint input-state filter and the denoising are those of the literal reference."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import Freedom, Hold, Kind, Reading, Tyre
from floatref.vehicle_response.estimators.joint_filter import JointInputState
from floatref.vehicle_response.models.connections import Connection, connect
from floatref.vehicle_response.stages.denoising import remove_noise
from floatref_reference.zhu_2021.section_3_discretization import first_order_system, system
from floatref_reference.zhu_2021.section_3_joint_estimation import joint_input_state
from floatref_reference.zhu_2021.section_3_state_space import output_matrices, state_space
from floatref_reference.zhu_2021.section_5_singular_spectrum import denoise
from floatref_reference.zhu_2021.symbols import Structure

laws = settings(deadline=None, max_examples=15)
SEEDS = st.integers(0, 2**32 - 1)
LITERAL = 1e-9
STEP = 0.005


def chain(rng, masses, tyres):
    """Masses one on the other; a tyre is below the first and, if there are two, on the last."""
    freedoms = [Freedom(f"mass {i}", f"z{i}", "sprung") for i in range(masses)]
    ends = [freedoms[0].name, freedoms[-1].name][:tyres]
    links = [
        Connection(
            tuple(float(j == i) - float(j == i + 1) for j in range(masses)),
            *10 ** rng.uniform([4, 2], [5, 4]),
        )
        for i in range(masses - 1)
    ]
    return connect(
        "chain",
        list(zip(freedoms, 10 ** rng.uniform(1.5, 3, masses), strict=True)),
        [Tyre(end, stiffness=10 ** rng.uniform(5, 6)) for end in ends],
        [*links, Connection((1.0,) + (0.0,) * (masses - 1), 0.0, 10 ** rng.uniform(2, 4))],
    )


def readings_of(rng, model):
    """What the wheels need, and others at random."""
    wheels = {tyre.freedom for tyre in model.tyres}
    chances = {Kind.ACCELERATION: 0.3, Kind.VELOCITY: 0.3, Kind.DISPLACEMENT: 0.6}
    sigmas = {Kind.ACCELERATION: 0.1, Kind.VELOCITY: 0.01, Kind.DISPLACEMENT: 1e-3}
    found = [
        Reading(kind, freedom.name, sigmas[kind] * rng.uniform(0.5, 2.0))
        for freedom in model.freedoms
        for kind in Kind
        if (kind is not Kind.VELOCITY and freedom.name in wheels) or rng.random() < chances[kind]
    ]
    return [found[at] for at in rng.permutation(len(found))]


def literal(model, readings, hold, noise, start, samples):
    """Forces, road-free states and their variances of the reference."""
    vehicle = Structure(model.mass, model.damping, model.stiffness, model.selection)
    chosen = {kind: np.zeros((len(readings), len(model.freedoms))) for kind in Kind}
    for row, reading in enumerate(readings):
        chosen[reading.kind][row, model.index(reading.freedom)] = 1.0
    a, b = state_space(vehicle)
    kinds = Kind.ACCELERATION, Kind.VELOCITY, Kind.DISPLACEMENT
    g, j = output_matrices(vehicle, *(chosen[kind] for kind in kinds))
    if hold is Hold.FIRST_ORDER:
        discrete, after = first_order_system(a, b, g, j, STEP)
    else:
        discrete, after = system(a, b, g, j, STEP), np.zeros_like(b)
    r = np.diag([reading.sigma**2 for reading in readings])
    estimate = joint_input_state(samples, discrete, noise, r, np.zeros(len(a)), start)
    both = np.hstack([np.eye(len(a)), after])
    turned = estimate.P_XF.transpose(0, 2, 1)
    joint = np.concatenate(
        [np.concatenate([estimate.P, estimate.P_XF], 2), np.concatenate([turned, estimate.P_F], 2)],
        1,
    )
    spread = np.sqrt(np.diagonal(both @ joint @ both.T, axis1=1, axis2=2))
    force_spread = np.sqrt(np.diagonal(estimate.P_F, axis1=1, axis2=2))
    return estimate.F, force_spread, estimate.X + estimate.F @ after.T, spread


@pytest.mark.slow
@pytest.mark.cites("(13) of Zhu", "step (a) of Zhu", "step (b) of Zhu", "step (c) of Zhu")
@laws
@given(seed=SEEDS, masses=st.integers(1, 5), tyres=st.integers(1, 2), hold=st.sampled_from(Hold))
def test_forces_states_and_sigmas_of_drawn_models(seed, masses, tyres, hold):
    rng = np.random.default_rng(seed)
    model = chain(rng, masses, min(tyres, masses))
    readings = readings_of(rng, model)
    root = rng.normal(size=(2, 2 * masses, 2 * masses))
    scale = np.repeat([1e-4, 1e-2], masses)
    noise, start = (scale[:, None] * part @ part.T * scale / masses for part in root)
    samples = rng.normal(size=(60, len(readings))) * [10 * r.sigma for r in readings]
    try:
        rule = JointInputState.of(model, readings, STEP, noise, start, hold)
    except InputError:
        assume(False)
    estimate = rule.estimate(samples)
    found = estimate.force, estimate.force_sigma, estimate.states, estimate.states_sigma
    expected = literal(model, readings, hold, noise, start, samples)
    for ours, theirs in zip(found, expected, strict=True):
        error = np.abs(ours - theirs).max(axis=0)
        assert (error <= LITERAL * np.abs(theirs).max(axis=0)).all()
    np.testing.assert_allclose(
        estimate.road, estimate.force / [t.stiffness for t in model.tyres], rtol=1e-12
    )


@pytest.mark.cites("section 5 of Zhu")
@laws
@given(seed=SEEDS, size=st.integers(24, 80), window=st.integers(2, 12), keep=st.integers(1, 12))
def test_denoising_keeps_the_same_components(seed, size, window, keep):
    keep = min(keep, window)
    samples = np.random.default_rng(seed).standard_normal(size).cumsum()
    trajectory = np.lib.stride_tricks.sliding_window_view(samples, window)
    values = np.append(np.linalg.svd(trajectory, compute_uv=False) ** 2, 0.0)
    # Which of two equal components comes first is rounding.
    assume(keep == window or values[keep - 1] - values[keep] > 1e-3 * values[0])
    found, expected = remove_noise(samples, window, components=keep), denoise(samples, window, keep)
    assert np.abs(found - expected).max() <= LITERAL * np.abs(expected).max()


@pytest.mark.slow
@pytest.mark.parametrize("hold", Hold)
def test_most_drawn_models_can_be_estimated(hold):
    """What the law above leaves out is the exception."""
    able = 0
    for seed in range(40):
        rng = np.random.default_rng(seed)
        model = chain(rng, 1 + seed % 5, min(1 + seed % 2, 1 + seed % 5))
        readings, start = readings_of(rng, model), np.ones(2 * (1 + seed % 5))
        try:
            JointInputState.of(model, readings, STEP, start, start, hold)
        except InputError:
            continue
        able += 1
    assert able > 20
