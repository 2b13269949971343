"""The matrices of the measurement model are its derivatives, with any lever arm."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_c.measurement_model import matrix_h, matrix_r
from floatref_reference.chapter_6.section_6_3_6_system import h

Vector = npt.NDArray[np.float64]
ANGLE = st.floats(-1.2, 1.2)
RATE = st.floats(-2, 2)
STATES = st.tuples(st.floats(-10, 10), RATE, ANGLE, ANGLE, RATE, RATE, RATE).map(np.array)
INPUTS = st.tuples(*[RATE] * 6).map(np.array)
LEVERS = st.tuples(*[st.floats(-3, 3)] * 3).map(np.array)


@pytest.mark.slow
@pytest.mark.cites("(C.7)", "(C.8)", "(C.9)", "(6.14)")
@settings(deadline=None, max_examples=100)
@given(x=STATES, u=INPUTS, lever=LEVERS)
def test_h_differentiates_the_state(x: Vector, u: Vector, lever: Vector) -> None:
    step = 1e-5
    columns = [(h(x + e, u, lever) - h(x - e, u, lever)) / (2 * step) for e in step * np.eye(7)]
    assert matrix_h(x, u, lever) == pytest.approx(np.array(columns).T, abs=5e-8)


@pytest.mark.cites("(C.8)", "(C.9)")
@settings(deadline=None, max_examples=20)
@given(x=STATES, u=INPUTS, l_x=st.floats(-3, 3), lever=LEVERS)
def test_antenna_forward_adds_only_to_height_and_velocity(
    x: Vector, u: Vector, l_x: float, lever: Vector
) -> None:
    printed = matrix_h(x, u, [0, lever[1], lever[2]])
    added = matrix_h(x, u, [l_x, lever[1], lever[2]]) - printed
    alone = matrix_h(x, u, [l_x, 0, 0]) - matrix_h(x, u, [0, 0, 0])
    assert added == pytest.approx(alone, abs=1e-13)
    assert not added[2:].any()
    assert not added[:, [0, 1, 4, 5]].any()


@pytest.mark.cites("(C.10)", "(6.15)")
@settings(deadline=None, max_examples=20)
@given(sigma=st.lists(st.floats(0, 10), min_size=4, max_size=4), seed=st.integers(0, 99))
def test_r_is_the_variance_of_the_noise_in_any_direction(sigma: list[float], seed: int) -> None:
    """V is the identity: the noise is added to what is measured."""
    direction = np.random.default_rng(seed).normal(size=4)
    independent = sum((s * d) ** 2 for s, d in zip(sigma, direction, strict=True))
    assert direction @ matrix_r(sigma) @ direction == pytest.approx(independent)
    noise = np.asarray(sigma) * direction
    quiet = h(np.zeros(7), np.zeros(6), np.zeros(3))
    assert h(np.zeros(7), np.zeros(6), np.zeros(3), noise) - quiet == pytest.approx(noise)
