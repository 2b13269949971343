"""Forces, road and states of any model: what is exact, what is missing, what is refused."""

import copy

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.vehicle_response import ZHU_HALF_CAR, Hold, Kind, QuarterCar, Reading, output_matrices
from floatref.vehicle_response.estimators.disturbance import hold_error_of
from floatref.vehicle_response.estimators.joint_filter import JointInputState

FEW = settings(deadline=None, max_examples=12)
SEEDS = st.integers(0, 2**32 - 1)
STEP = 0.005
CORNER = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3)
MOTIONS = Kind.ACCELERATION, Kind.DISPLACEMENT


def all_read(model, sigma=1.0, without=()):
    names = [f.name for f in model.freedoms if f.name not in without]
    return [Reading(kind, name, sigma) for kind in MOTIONS for name in names]


def driven(model, readings, seed, hold, count=300):
    """Forces that hold as they should, states and exact readings, from rest."""
    system = JointInputState.of(
        model, readings, STEP, np.zeros(2 * len(model.freedoms)), start(model), hold
    ).system
    rng = np.random.default_rng(seed)
    force = 1e3 * rng.normal(size=(count, len(model.tyres))).cumsum(axis=0)
    xi, states = -system.after @ force[0], []
    for f in force:
        states.append(xi + system.after @ f)
        xi = system.transition @ xi + system.influence @ f
    states = np.array(states)
    return force, states, states @ system.output.T + force @ system.direct.T


def start(model, variance=0.0):
    return np.full(2 * len(model.freedoms), variance)


@pytest.mark.slow
@FEW
@given(seed=SEEDS, hold=st.sampled_from(Hold))
@pytest.mark.parametrize("model", [CORNER.model(), ZHU_HALF_CAR.model()], ids=lambda m: m.name)
def test_without_noise_all_is_exact_from_any_start(model, seed, hold):
    readings = all_read(model)
    force, states, samples = driven(model, readings, seed, hold)
    found = JointInputState.of(model, readings, STEP, start(model), start(model, 1e4), hold)
    estimate = found.estimate(samples)
    late = slice(200, None)
    np.testing.assert_allclose(estimate.force[late], force[late], atol=1e-4 * np.abs(force).max())
    scale = np.abs(states).max(axis=0)
    np.testing.assert_allclose(estimate.states[late] / scale, states[late] / scale, atol=1e-4)
    np.testing.assert_allclose(estimate.road, estimate.force / [t.stiffness for t in model.tyres])


@pytest.mark.slow
@FEW
@given(seed=SEEDS, hold=st.sampled_from(Hold), cuts=st.lists(st.integers(0, 300), max_size=5))
def test_any_split_gives_the_same_bits(seed, hold, cuts):
    model = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, 150.0).model()
    readings = all_read(model)
    _, _, samples = driven(CORNER.model(), readings, seed, hold)
    samples[np.random.default_rng(seed).random(samples.shape) < 0.1] = np.nan
    rule = JointInputState.of(model, readings, STEP, start(model, 1e-6), start(model, 1e-2), hold)
    whole, memory, parts = rule.estimate(samples), rule.begin(), []
    for part in np.split(samples, sorted(cuts)):
        memory = copy.deepcopy(memory)
        parts.append(rule.advance(memory, part))
    for name in ("road", "road_sigma", "states", "states_sigma", "force", "force_sigma"):
        joined = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_array_equal(joined, getattr(whole, name))


@pytest.mark.slow
@pytest.mark.parametrize("columns", [[1], [0, 1, 2, 3]], ids=["wheel", "all"])
def test_without_what_tells_the_force_there_is_no_road_and_no_claim(columns):
    """In a gap, and behind it, errors are as large as the standard deviations say."""
    model = CORNER.model()
    sigma = 1e-3
    readings, gap = all_read(model, sigma), slice(100, 160)
    rule = JointInputState.of(model, readings, STEP, start(model, 1e-10), start(model, 1e-6))
    normalised = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        force, states, samples = driven(model, readings, seed, Hold.ZERO_ORDER)
        assert np.abs(force).max() < 3 * 0.1 * 320e3
        samples += sigma * rng.normal(size=samples.shape)
        samples[gap, columns] = np.nan
        found = rule.estimate(samples)
        missing = np.zeros(300, dtype=bool)
        missing[gap] = True
        for values in (found.road, found.road_sigma, found.force, found.force_sigma):
            np.testing.assert_array_equal(np.isnan(values[:, 0]), missing)
        normalised.append((found.states - states) / found.states_sigma)
    squares = np.mean(np.square(normalised), axis=(0, 2))
    assert squares[gap].max() < 1.3
    assert squares[160:190].max() < 1.6
    assert found.states_sigma[150, 0] > 10 * found.states_sigma[90, 0]


@pytest.mark.slow
@pytest.mark.parametrize("hold", Hold)
def test_equipment_that_carries_no_sensor_is_told(hold):
    """5 % of noise on the readings of all else: its height within 8 %, its acceleration 15 %."""
    model = ZHU_HALF_CAR.model()
    readings = all_read(model, without=["equipment"])
    force, states, samples = driven(model, readings, 5, Hold.FIRST_ORDER, 2000)
    own = [Reading(kind, "equipment", 1.0) for kind in MOTIONS]
    output, direct = output_matrices(model, own)
    sigmas = 0.05 * np.sqrt(np.mean(samples**2, axis=0))
    noisy = samples + sigmas * np.random.default_rng(6).normal(size=samples.shape)
    known = [Reading(r.kind, r.freedom, s) for r, s in zip(readings, sigmas, strict=True)]
    noise = hold_error_of(model, STEP, 10.0, "C", hold)
    estimate = JointInputState.of(model, known, STEP, noise, start(model, 5e-5), hold).estimate(
        noisy
    )
    found = estimate.states @ output.T + estimate.force @ direct.T
    right = states @ output.T + force @ direct.T
    error = np.linalg.norm(found - right, axis=0) / np.linalg.norm(right, axis=0)
    assert error[1] < 0.08
    assert error[0] < 0.15


@pytest.mark.slow
@FEW
@given(damping=st.floats(1.0, 2000.0), wave_hz=st.floats(0.5, 8.0))
def test_a_tyre_with_damping_tells_the_road_and_not_its_force(damping, wave_hz):
    model = QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, damping).model()
    readings, time = all_read(model, 1e-5), np.arange(0.0, 4.0, 1e-3)
    wave = 2j * np.pi * wave_hz
    force = (320e3 + damping * wave) * 0.01
    a, b, c = (wave**2 * model.mass, wave * model.damping, model.stiffness)
    q = np.linalg.solve(a + b + c, model.selection @ [force])
    samples = np.real(np.exp(wave * time)[:, None] * np.concatenate((wave**2 * q, q)))
    rule = JointInputState.of(
        model, readings, 1e-3, start(model, 1e-12), start(model, 1e-2), Hold.FIRST_ORDER
    )
    found, road = rule.estimate(samples), 0.01 * np.cos(wave.imag * time)
    assert np.abs(found.road[2000:, 0] - road[2000:]).max() < 1e-4
    np.testing.assert_array_less(0.0, found.road_sigma)


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"step_s": 0.0}, "time step of 0 s"),
        ({"step_s": np.nan}, "time step of nan s"),
        ({"disturbance": np.zeros((3, 4))}, r"disturbance has the shape \(3, 4\); 4 states need"),
        ({"initial": np.zeros(3)}, r"initial covariance has the shape \(3,\)"),
        ({"initial": np.full(4, np.nan)}, "initial covariance holds what is no finite number"),
        ({"initial": np.full(4, -1.0)}, "initial covariance is no covariance"),
        ({"initial": np.full(4, -1e-15)}, "initial covariance is no covariance"),
        ({"disturbance": np.tri(4)}, "disturbance is no covariance; give a symmetric"),
        ({"disturbance": np.ones((4, 4)) - np.eye(4)}, "disturbance is no covariance"),
        ({"readings": []}, "readings"),
        ({"readings": [Reading(Kind.DISPLACEMENT, "wheel", 1.0)]}, "acceleration of the wheel"),
        ({"readings": [Reading(Kind.ACCELERATION, "wheel", 1.0)]}, "displacement of the"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(changed, says):
    model = CORNER.model()
    zero = start(model)
    given = {"readings": all_read(model), "step_s": STEP, "disturbance": zero, "initial": zero}
    with pytest.raises(InputError, match=says) as raised:
        JointInputState.of(model, **{**given, **changed})
    assert "\n" not in str(raised.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("samples", "says"),
    [
        (np.zeros((9, 3)), r"samples of the shape \(9, 3\); 4 readings need \(N, 4\)"),
        (np.zeros(4), r"samples of the shape \(4,\)"),
        (
            np.full((9, 4), np.nan),
            "no sample of 9 has .* acceleration of the body, acceleration of",
        ),
        (np.zeros((0, 4)), "no sample of 0 has"),
    ],
)
def test_samples_that_tell_nothing_are_refused_in_one_line(samples, says):
    model = CORNER.model()
    rule = JointInputState.of(model, all_read(model), STEP, start(model), start(model))
    with pytest.raises(InputError, match=says) as raised:
        rule.estimate(samples)
    assert "\n" not in str(raised.value)


def test_a_covariance_beyond_all_numbers_is_refused_with_what_to_do():
    model = CORNER.model()
    rule = JointInputState.of(model, all_read(model), STEP, start(model), start(model, 1e308))
    with pytest.raises(
        InputError, match=r"no longer finite and positive at sample 0 of 5; .* smaller"
    ):
        rule.estimate(np.full((5, 4), np.nan))


@pytest.mark.parametrize("variance", [1e12, 1e15])
def test_a_covariance_that_rounding_spoils_is_refused_and_makes_no_gap(variance):
    model = ZHU_HALF_CAR.model()
    rule = JointInputState.of(
        model, all_read(model, 1e-3), STEP, start(model), start(model, variance)
    )
    with pytest.raises(
        InputError, match=r"finite and positive at sample \d+ of 50; give a smaller"
    ):
        rule.estimate(np.zeros((50, 10)))
