"""What drifts, and what is known before, has the 1-σ that the page says."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.road_slope import priors
from floatref_reference.road_slope.constants import Constants
from floatref_reference.road_slope.held import Held
from floatref_reference.road_slope.symbols import Stretch
from floatref_reference.road_slope.unknowns import Unknowns, by_name, start
from floatref_reference.road_slope.wheels import road_points

C = Constants(interval_s=0.1, spacing_m=1.0)
G = C.gravity
Stopping = Callable[..., Stretch]
STEP = np.array([0, 1, -1.0])


def still(stretch: Stretch) -> Unknowns:
    return by_name(start(stretch), road_points(stretch).number, len(stretch.readings.place))


def flat(K: int) -> Held:
    return Held(np.ones(1), np.zeros(K), np.full(K - 1, 1e-3))


def test_steps_of_bias_offset_and_moment(stopping: Stopping) -> None:
    stretch, at_1, root = stopping(C), np.eye(30)[1], np.sqrt(0.1)
    x = still(stretch)._replace(bias=at_1, offset=at_1, moment=at_1)
    assert priors.bias_rows(x, stretch)[:3] == pytest.approx(STEP / (1e-4 * root))
    assert priors.offset_rows(x, stretch, flat(30))[:3] == pytest.approx(STEP / (2e-4 * root))
    assert priors.moment_rows(x, stretch, flat(30))[:3] == pytest.approx(STEP / (0.02 * root))


def test_the_first_of_each(stopping: Stopping) -> None:
    stretch, one = stopping(C), np.ones(30)
    x = still(stretch)._replace(bias=0.06 * one, offset=3 * one, moment=0.5 * one)
    kinds = (priors.bias_rows(x, stretch), priors.offset_rows(x, stretch, flat(30)))
    kinds = (*kinds, priors.moment_rows(x, stretch, flat(30)))
    for rows, first in zip(kinds, (2, 3, 5), strict=True):
        assert rows == pytest.approx([first, *np.zeros(29)])


def test_a_cut_gives_them_its_time(stopping: Stopping) -> None:
    stretch = stopping(C, cut=25)
    over = 1.0 * (np.arange(30) >= 25)
    x, root = still(stretch)._replace(bias=over, offset=over, moment=over), np.sqrt(30.1)
    assert priors.bias_rows(x, stretch)[25] == pytest.approx(1 / (1e-4 * root))
    board = np.sqrt(((2e-4 * root) ** 2 + 1e-6) / 2)
    assert priors.offset_rows(x, stretch, flat(30))[25] == pytest.approx(1 / board)
    assert priors.moment_rows(x, stretch, flat(30))[25] == pytest.approx(1 / (0.02 * root))


@settings(deadline=None, max_examples=25)
@given(k=st.integers(0, 28), bend=st.floats(-0.1, 0.1))
def test_a_road_that_turns_under_the_wheels_frees_the_moment(
    stopping: Stopping, k: int, bend: float
) -> None:
    """By three tenths of what its slope changes the force along the road by."""
    stretch = stopping(C)
    held = flat(30)._replace(beta=bend * (np.arange(30) > k))
    sigma = [priors.moment_sigma(stretch, held, i) for i in range(29)]
    expected = np.full(29, 0.02 * np.sqrt(0.1))
    expected[k] = np.hypot(expected[k], 0.3 * G * bend)
    assert sigma == pytest.approx(expected)


def test_somebody_may_board_after_a_second(stopping: Stopping) -> None:
    """It stops at node 20: the tenth step behind is the first; a cut counts by its time."""
    stretch, walk = stopping(C, K=40), 4e-8 * 0.1
    held = flat(40)._replace(stepped=1e-3 * np.arange(39))
    times = priors.standing_for(stretch)
    assert times == pytest.approx(np.where(np.arange(39) < 20, 0, 0.1 * (np.arange(39) - 19)))
    k = np.arange(39)
    expected = np.where(k < 29, walk, (walk + (1e-3 * k) ** 2) / 2)
    assert priors.offset_sigma(stretch, held) ** 2 == pytest.approx(expected)
    with_cut = priors.standing_for(stopping(C, K=40, cut=22))
    assert list(np.flatnonzero(with_cut >= 1)) == [*range(21, 39)]
    slow = stretch._replace(readings=stretch.readings._replace(speed=0.02 * np.ones(40)))
    assert not priors.standing_for(slow).any()


def test_a_vehicle_that_moves_again_begins_anew(stopping: Stopping) -> None:
    stretch = stopping(C, K=40)
    stretch.readings.speed[30] = 1.0
    times = priors.standing_for(stretch)
    assert times[[28, 29, 30, 31, 38]] == pytest.approx([0.9, 0, 0, 0.1, 0.8])


@given(k=st.integers(0, 18))
def test_a_step_costs_the_logarithm_of_its_size(stopping: Stopping, k: int) -> None:
    """Of steps far over the walk, the held variance is half their square: a misfit of √2."""
    stretch = stopping(C, K=20, speed=0.0)
    step = 0.05 * (np.arange(20) > k)
    x = still(stretch)._replace(offset=step)
    held = flat(20)._replace(stepped=np.diff(step))
    boarded = 0.1 * (k + 1) > 0.99
    expected = np.sqrt(2) if boarded else 0.05 / (2e-4 * np.sqrt(0.1))
    assert priors.offset_rows(x, stretch, held)[k + 1] == pytest.approx(expected, rel=1e-5)


def test_heave_and_nod_grow_with_speed(stopping: Stopping) -> None:
    """From 4 m/s to rest."""
    stretch, one = stopping(C), np.ones(30)
    x = still(stretch)._replace(heave=one, nod=one)
    heave, nod = priors.heave_rows(x, stretch), priors.nod_rows(x, stretch)
    assert (heave[0], heave[29]) == pytest.approx((1 / 57e-6, 1 / 5e-6))
    assert (nod[0], nod[29]) == pytest.approx((1 / 33e-6, 1 / 5e-6))


def test_constants_have_their_deviations() -> None:
    omega = 2 * np.pi * 1.6
    stiff, damped = omega**2 * 0.81 / 2, 0.3 * omega * 0.81
    logs = np.log([2 * stiff, stiff / 2, 3 * damped, damped, 1.8])
    vector = np.array([2.0, *np.zeros(10), 0.013, 0.04, 0.1, *logs])
    expected = [2, 2, 2, -2, np.log(2) / 0.6, -np.log(2) / 0.6, np.log(3) / 0.8, 0]
    rows = priors.prior_rows(by_name(vector, 2, 1), C)
    assert rows == pytest.approx([*expected, np.log(2) / 0.15])
