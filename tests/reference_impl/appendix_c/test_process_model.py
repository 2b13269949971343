"""The matrices of the process model are its derivatives."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_c.process_model import matrix_a, matrix_q, matrix_w
from floatref_reference.chapter_6.section_6_3_6_system import f

Vector = npt.NDArray[np.float64]
ANGLE = st.floats(-1.2, 1.2)
STATES = st.tuples(
    st.floats(-10, 10),
    st.floats(-3, 3),
    ANGLE,
    ANGLE,
    st.floats(-0.5, 0.5),
    st.floats(-0.1, 0.1),
    st.floats(-0.1, 0.1),
).map(np.array)
INPUTS = st.tuples(*[st.floats(-20, 20)] * 3, *[st.floats(-2, 2)] * 3).map(np.array)


def central_differences(g: Callable[[Vector], Vector], at: Vector) -> Vector:
    step = 1e-5
    columns = [(g(at + e) - g(at - e)) / (2 * step) for e in step * np.eye(len(at))]
    return np.array(columns).T


@pytest.mark.slow
@pytest.mark.cites("(C.2)", "(C.3)", "(C.4)", "(6.11)", "(6.18)")
@settings(deadline=None, max_examples=100)
@given(x=STATES, u=INPUTS, dt=st.floats(0.1, 1.0))
def test_a_differentiates_the_state(x: Vector, u: Vector, dt: float) -> None:
    expected = central_differences(lambda changed: f(changed, u, dt), x)
    assert matrix_a(x, u, dt) == pytest.approx(expected, abs=5e-8)


@pytest.mark.slow
@pytest.mark.cites("(C.6)", "(6.12)", "(6.21)")
@settings(deadline=None, max_examples=100)
@given(x=STATES, u=INPUTS, dt=st.floats(0.1, 1.0))
def test_w_differentiates_the_noise(x: Vector, u: Vector, dt: float) -> None:
    expected = central_differences(lambda w: f(x, u, dt, w), np.zeros(7))
    assert matrix_w(x, dt) == pytest.approx(expected, abs=5e-8)


@pytest.mark.cites("(C.5)", "(6.4)")
@settings(deadline=None, max_examples=20)
@given(sigma=st.lists(st.floats(0, 10), min_size=7, max_size=7), seed=st.integers(0, 99))
def test_q_is_the_variance_of_the_noise_in_any_direction(sigma: list[float], seed: int) -> None:
    direction = np.random.default_rng(seed).normal(size=7)
    independent = sum((s * d) ** 2 for s, d in zip(sigma, direction, strict=True))
    assert direction @ matrix_q(sigma) @ direction == pytest.approx(independent)
