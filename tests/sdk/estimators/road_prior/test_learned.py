"""What brakes tell of lean and tilt, how they are pooled, and where the next run begins."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.models.road_prior_values import LEAN, STATES, TILT
from floatref.estimators.road_prior import RoadPrior, RoadPriorSmoother
from floatref.estimators.road_prior.learned import Brake, pool
from floatref.values.channels import ChannelId

HEIGHT = ChannelId("floating_reference_height", "left")
C = RoadPrior(lean_expected_rad=0.004, tilt_expected=-0.002)
START = np.array([C.lean_expected_rad, C.tilt_expected])
PRIOR = np.diag(np.square([C.lean_sigma_rad, C.tilt_sigma]))
laws = settings(deadline=None, max_examples=20)
SEEDS = st.integers(0, 2**32 - 1)
VALUES = st.floats(-0.02, 0.02)


def readings(rng, coefficients, count, sigma):
    """Return readings of sums of both coefficients, what they are sums of, and their noise."""
    rows = rng.normal(size=(count, 2))
    return rows, rows @ coefficients + sigma * rng.normal(size=count), sigma


def posterior(rows, said, sigma):
    """Return the brake that has told so, from Bayes' theorem."""
    covariance = np.linalg.inv(np.linalg.inv(PRIOR) + rows.T @ rows / sigma**2)
    information = np.linalg.solve(PRIOR, START) + rows.T @ said / sigma**2
    return Brake(covariance @ information, covariance)


@laws
@given(seed=SEEDS, coefficients=st.tuples(VALUES, VALUES), brakes=st.integers(1, 5))
def test_brakes_of_one_vehicle_tell_what_all_their_readings_tell_at_once(
    seed, coefficients, brakes
):
    rng = np.random.default_rng(seed)
    parts = [readings(rng, np.array(coefficients), 6, 1e-3) for _ in range(brakes)]
    found = pool([posterior(*part) for part in parts], C)
    whole = posterior(np.vstack([p[0] for p in parts]), np.concatenate([p[1] for p in parts]), 1e-3)
    given_ = found["lean_expected_rad"], found["tilt_expected"]
    np.testing.assert_allclose(given_, whole.estimate, rtol=1e-6, atol=1e-12)
    least = np.sqrt(np.diag(whole.covariance))
    assert found["lean_sigma_rad"] >= least[0] * (1 - 1e-9)
    assert found["tilt_sigma"] >= least[1] * (1 - 1e-9)


@pytest.mark.slow
@laws
@given(seed=SEEDS)
def test_the_sigma_is_that_of_brakes_which_differ(seed):
    """Each has a coefficient of its own; no reading is much in doubt."""
    rng = np.random.default_rng(seed)
    own = rng.normal(0.0, [2e-3, 5e-4], (400, 2))
    found = pool([posterior(*readings(rng, each, 8, 1e-5)) for each in own], C)
    assert found["lean_sigma_rad"] == pytest.approx(2e-3, rel=0.2)
    assert found["tilt_sigma"] == pytest.approx(5e-4, rel=0.2)


def test_without_brakes_nothing_is_told(drive, through):
    assert pool([], C) == {}
    stage = RoadPriorSmoother()
    through(stage, drive(1, 10.0, 100))
    assert stage.list_learned() == {}


def leaning(drive, seed, lean, tilt, rate=200):
    """Return a drive with stops on a flat road, by a body that leans and tilts in them."""
    drawn = drive(seed, 24.0, rate, (6.0, 8.0))
    along, response = drawn.excitation(C)
    noise = 1e-3 * np.random.default_rng(seed).normal(size=along.size)
    a = lean * along + tilt * along * response + noise
    return replace(drawn, a=a, h=np.full(a.size, 0.3))


@settings(deadline=None, max_examples=5)
@given(seed=SEEDS, lean=st.floats(-0.02, 0.02), tilt=st.floats(-0.01, 0.01))
def test_a_run_learns_the_lean_and_the_tilt_that_it_had(drive, through, seed, lean, tilt):
    stage = RoadPriorSmoother()
    drawn = leaning(drive, seed, lean, tilt)
    through(stage, drawn, range(500, drawn.a.size, 500))
    found = stage.list_learned()
    assert abs(found["lean_expected_rad"] - lean) < 4 * found["lean_sigma_rad"] < 0.02
    assert abs(found["tilt_expected"] - tilt) < 4 * found["tilt_sigma"] < 0.01


@settings(deadline=None, max_examples=5)
@given(seed=SEEDS, cuts=st.sets(st.integers(1, 4799), max_size=9))
def test_what_is_learned_does_not_depend_on_the_blocks(drive, through, seed, cuts):
    drawn, found = leaning(drive, seed, 0.01, -0.005), []
    for cut in (cuts, ()):
        stage = RoadPriorSmoother()
        through(stage, drawn, cut)
        found.append(stage.list_learned())
    assert found[0] == found[1]


@settings(deadline=None, max_examples=5)
@given(seed=SEEDS, begin=st.floats(4.5, 10.4))
def test_what_is_expected_is_the_same_as_that_much_less_acceleration(drive, through, seed, begin):
    """(1.5): r'' = a - κ u; expecting κ is expecting nothing where κ u is taken off first."""
    drawn = drive(seed, 18.0, 200, (begin, begin + 0.5))
    along, response = drawn.excitation(C)
    less = drawn.a - START[0] * along - START[1] * along * response
    ours = through(RoadPriorSmoother(C, tolerance_m=0.0), drawn)[HEIGHT]
    plain = replace(C, lean_expected_rad=0.0, tilt_expected=0.0)
    other = through(RoadPriorSmoother(plain, tolerance_m=0.0), replace(drawn, a=less))[HEIGHT]
    np.testing.assert_allclose(ours, other, rtol=0, atol=1e-6)


def test_what_is_known_already_is_not_learned():
    constants = replace(C, tilt_sigma=1e-9)
    covariance = np.diag(np.square([1e-3, 1e-9]))
    brakes = [Brake(np.array([lean, C.tilt_expected]), covariance) for lean in (0.01, 0.012)]
    found = pool(brakes, constants)
    assert found["tilt_expected"] == pytest.approx(C.tilt_expected)
    assert found["tilt_sigma"] == pytest.approx(1e-9)
    assert found["lean_expected_rad"] == pytest.approx(0.011, abs=1e-4)


def test_brakes_of_a_run_are_kept_one_after_the_other(drive, through):
    """Over 4 s of constant speed they begin anew, so that each tells its own."""
    one, other = leaning(drive, 1, 0.015, -0.006), leaning(drive, 2, 0.005, -0.006)
    stage = RoadPriorSmoother()
    through(stage, one.followed_by(other))
    brakes = stage.memory["filters"]["left"].all_brakes()
    assert [round(brake.estimate[0], 3) for brake in brakes] == [0.015, 0.005]
    found = stage.list_learned()
    assert found["lean_expected_rad"] == pytest.approx(0.010, abs=1e-3)
    assert found["lean_sigma_rad"] == pytest.approx(0.005, abs=1e-3)


def test_no_spread_makes_less_sure_than_at_the_start():
    """Brakes that contradict one another wildly tell nothing."""
    covariance = np.diag(np.square([1e-4, 1e-4]))
    brakes = [Brake(np.array([lean, C.tilt_expected]), covariance) for lean in (-0.3, 0.3)]
    assert pool(brakes, C)["lean_sigma_rad"] == C.lean_sigma_rad


@pytest.mark.parametrize(("left", "tells"), [(0.49, True), (0.51, False)])
def test_half_of_a_variance_is_what_a_brake_has_to_tell(left, tells):
    x, p, variances = np.zeros(STATES), np.eye(STATES), np.diag(PRIOR)
    p[LEAN, LEAN], p[TILT, TILT] = variances[0], left * variances[1]
    assert Brake.of(x, p).tells(variances) is tells
