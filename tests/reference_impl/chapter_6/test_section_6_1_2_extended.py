"""The extended filter is the linear one where the model is linear."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6 import section_6_1_1_linear as linear
from floatref_reference.chapter_6.section_6_1_2_extended import (
    measurement_update,
    predicted_covariance,
)


@pytest.mark.cites("(6.8)", "(6.9)", "(6.10)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999), nn=st.integers(1, 5))
def test_noise_enters_through_its_jacobian(seed: int, nn: int) -> None:
    """A x + W w is a linear system in (x, w), whose transition is [A W]."""
    rng = np.random.default_rng(seed)
    A, W, sigma = rng.normal(size=(3, 3)), rng.normal(size=(3, nn)), rng.uniform(0.1, 2, nn)
    root = rng.normal(size=(3, 3))
    P, Q = root @ root.T, np.diag(sigma**2)
    both = np.block([[P, np.zeros((3, nn))], [np.zeros((nn, 3)), Q]])
    joint = np.hstack([A, W])
    assert predicted_covariance(P, A, W, Q) == pytest.approx(joint @ both @ joint.T)


@pytest.mark.cites("(6.13)")
@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 999), offset=st.floats(-5, 5))
def test_correction_by_a_linear_measurement_is_the_linear_one(seed: int, offset: float) -> None:
    """A known offset in h moves y along with it; V scales the noise."""
    rng = np.random.default_rng(seed)
    root, H, V = rng.normal(size=(3, 3)), rng.normal(size=(2, 3)), rng.normal(size=(2, 2))
    P, R = root @ root.T + np.eye(3), np.diag(rng.uniform(0.1, 2, 2))
    x, y = rng.normal(size=3), rng.normal(size=2)
    x_linear, P_linear = linear.measurement_update(x, P, y, H, V @ R @ V.T)
    found = measurement_update(x, P, y + offset, H @ x + offset, H, R, V)
    assert found[0] == pytest.approx(x_linear)
    assert found[1] == pytest.approx(P_linear)
