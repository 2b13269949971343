"""Errors of the joint input-state filter average to zero and are as large as its sigmas say."""

import numpy as np
import pytest

from floatref.vehicle_response import ZHU_HALF_CAR, Hold, Kind, QuarterCar, Reading
from floatref.vehicle_response.estimators.disturbance import disturbance_of, hold_error_of
from floatref.vehicle_response.estimators.joint_filter import JointInputState

STEP, RUNS, COUNT = 0.005, 60, 120
MODELS = {
    "quarter-car": QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3).model(),
    "damped tyre": QuarterCar(700.0, 75.0, 45e3, 3300.0, 320e3, 2000.0).model(),
    "half car": ZHU_HALF_CAR.model(),
}


def normalised_errors(model, hold):
    """Errors of forces, states and roads over their sigmas, (runs, samples, p + 2n + p)."""
    size = 2 * len(model.freedoms)
    sizes = {Kind.ACCELERATION: 0.2, Kind.VELOCITY: 0.01, Kind.DISPLACEMENT: 1e-3}
    readings = [Reading(k, f.name, s) for k, s in sizes.items() for f in model.freedoms]
    densities = {f.name: 20.0 for f in model.freedoms}
    noise = disturbance_of(model, STEP, densities) + hold_error_of(model, STEP, 10.0, "E", hold)
    start = np.repeat([1e-4, 1e-2], size // 2)
    rule = JointInputState.of(model, readings, STEP, noise, start, hold)
    system, scaled = rule.system, []
    whole = len(rule.initial)
    root = np.zeros((whole, size))
    root[:size] = np.linalg.cholesky(noise + 1e-20 * np.eye(size))
    for run in range(RUNS):
        rng = np.random.default_rng(run)
        force = 5e3 * rng.normal(size=(COUNT, len(model.tyres)))
        xi, states = np.sqrt(np.diag(rule.initial)) * rng.normal(size=whole), []
        for f in force:
            states.append(xi + system.after @ f)
            xi = system.transition @ xi + system.influence @ f + root @ rng.normal(size=size)
        states = np.array(states)
        samples = states @ system.output.T + force @ system.direct.T
        samples += np.sqrt(system.variance) * rng.normal(size=samples.shape)
        estimate = rule.estimate(samples)
        # The road under a tyre with damping is a state behind the model's own.
        roads = states[:, size:] if whole > size else force / [t.stiffness for t in model.tyres]
        errors = (
            (estimate.force - force) / estimate.force_sigma,
            (estimate.states - states[:, :size]) / estimate.states_sigma,
            (estimate.road - roads) / estimate.road_sigma,
        )
        scaled.append(np.hstack(errors))
    return np.array(scaled)


@pytest.mark.slow
@pytest.mark.parametrize("hold", Hold)
@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
def test_errors_have_the_mean_zero_and_the_spread_that_is_told(model, hold):
    errors = normalised_errors(model, hold)
    # Over so many runs a mean has the sigma 1/√60, a mean square √(2/60); runs are independent,
    # samples of a run are not. Five of these sigmas, for some tens of columns.
    assert np.abs(errors.mean(axis=0))[[0, 5, -1]].max() <= 5 / np.sqrt(RUNS)
    assert np.abs(np.mean(errors**2, axis=0)[[0, 5, -1]] - 1.0).max() <= 6 * np.sqrt(2 / RUNS)
    assert np.abs(np.mean(errors**2, axis=(0, 1)) - 1.0).max() <= 0.2
    within = np.mean(np.abs(errors) < 1.96, axis=(0, 1))
    assert np.abs(within - 0.95).max() <= 0.03
