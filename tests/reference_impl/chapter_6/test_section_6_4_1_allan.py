"""Both formulas of the Allan variance agree, and each kind of noise has its term of (6.53).

The Allan variance is quadratic in the signal, so its mean over noise made of independent pulses is
the sum of what the single pulses have: no sampling is needed.
"""

import math
from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.chapter_6.section_6_4_1_allan import (
    allan_variance,
    allan_variance_of_integral,
    cluster_average,
    differences,
    integrated,
    modelled_variance,
)

Vector = npt.NDArray[np.float64]
N = 40
SIGNALS = st.lists(st.floats(-5, 5), min_size=8, max_size=30)


@pytest.mark.cites("(6.49)", "(6.50)", "(6.51)", "(6.52)")
@settings(deadline=None, max_examples=50)
@given(omega=SIGNALS, dt=st.floats(1e-3, 10), data=st.data())
def test_clusters_and_integral_agree(omega: list[float], dt: float, data: st.DataObject) -> None:
    n = data.draw(st.integers(1, len(omega) // 2))
    theta = integrated(omega, dt)
    expected = allan_variance(omega, n)
    assert allan_variance_of_integral(theta, n, dt) == pytest.approx(expected, rel=1e-12, abs=1e-15)
    clusters = np.array([cluster_average(omega, k, n) for k in range(len(omega) - n + 1)])
    assert dt * n * clusters == pytest.approx(theta[n:] - theta[:-n], rel=1e-12, abs=1e-15)


@pytest.mark.cites("(6.50)")
@settings(deadline=None, max_examples=20)
@given(omega=SIGNALS, offset=st.floats(-5, 5), scale=st.floats(0.1, 5))
def test_bias_does_not_count_and_scale_counts_squared(omega, offset, scale) -> None:
    changed = [offset + scale * value for value in omega]
    expected = scale**2 * float(allan_variance(omega, 2))
    assert float(allan_variance(changed, 2)) == pytest.approx(expected, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("n", [0, 6])
def test_clusters_that_do_not_fit_are_refused(n: int) -> None:
    with pytest.raises(ValueError, match=f"clusters of {n} samples"):
        differences(11, n)


def mean_variance(pulses: Iterator[Vector], n: int) -> float:
    return sum(float(allan_variance(pulse, n)) for pulse in pulses)


@pytest.mark.cites("(6.53)")
@settings(deadline=None, max_examples=10)
@given(n=st.integers(1, N // 2), dt=st.floats(1e-3, 1), N_A=st.floats(1e-3, 1))
def test_white_noise(n: int, dt: float, N_A: float) -> None:
    """A reading is the mean of white noise over dt, of variance N_A²/dt."""
    found = N_A**2 / dt * mean_variance(iter(np.eye(N)), n)
    assert found == pytest.approx(float(modelled_variance(n * dt, N_A=N_A)))


@pytest.mark.cites("(6.53)")
@settings(deadline=None, max_examples=10)
@given(n=st.integers(1, N // 2), dt=st.floats(1e-3, 1), K_A=st.floats(1e-3, 1))
def test_random_walk(n: int, dt: float, K_A: float) -> None:
    """Steps of variance K_A² dt; the walk in continuous time differs by 1/(2n²)."""
    found = K_A**2 * dt * mean_variance((np.tri(N)[:, j] for j in range(N)), n)
    expected = float(modelled_variance(n * dt, K_A=K_A)) * (1 + 1 / (2 * n**2))
    assert found == pytest.approx(expected)


@pytest.mark.cites("(6.53)")
@settings(deadline=None, max_examples=10)
@given(n=st.integers(1, N // 2), dt=st.floats(1e-3, 1), R_A=st.floats(1e-3, 1))
def test_ramp(n: int, dt: float, R_A: float) -> None:
    found = float(allan_variance(R_A * dt * np.arange(N), n))
    assert found == pytest.approx(float(modelled_variance(n * dt, R_A=R_A)))


@pytest.mark.cites("(6.53)")
@settings(deadline=None, max_examples=10)
@given(n=st.integers(1, N // 2), dt=st.floats(1e-3, 1), Q_A=st.floats(1e-3, 1))
def test_quantization(n: int, dt: float, Q_A: float) -> None:
    """The angle itself has independent errors of variance Q_A²."""
    found = sum(float(allan_variance_of_integral(e, n, dt)) for e in Q_A * np.eye(N + 1))
    assert found == pytest.approx(float(modelled_variance(n * dt, Q_A=Q_A)))


def seen_through_clusters(density: Callable[[Vector], Vector], tau: float) -> float:
    """Integrate 4 S(f) sin⁴(πfτ)/(πfτ)² over f, for a two-sided density S in cycles."""
    u = np.geomspace(1e-6, 400, 400_001)
    values = 4 * density(u / (math.pi * tau)) * np.sin(u) ** 4 / u**2 / (math.pi * tau)
    return float(np.sum((values[1:] + values[:-1]) / 2 * np.diff(u)))


@pytest.mark.cites("(6.53)")
@settings(deadline=None, max_examples=5)
@given(tau=st.floats(0.1, 100), B_A=st.floats(1e-3, 1))
def test_bias_instability(tau: float, B_A: float) -> None:
    """Flicker noise of density B_A²/(2πf) has the same variance at every cluster time."""
    found = seen_through_clusters(lambda f: B_A**2 / (2 * math.pi * f), tau)
    assert found == pytest.approx(float(modelled_variance(tau, B_A=B_A)), rel=1e-4)


@pytest.mark.cites("(6.53)")
@settings(deadline=None, max_examples=20)
@given(coefficients=st.lists(st.floats(0, 1), min_size=5, max_size=5), tau=st.floats(0.1, 100))
def test_independent_noises_add(coefficients: list[float], tau: float) -> None:
    alone = sum(float(modelled_variance(tau, *c)) for c in np.diag(coefficients))
    assert float(modelled_variance(tau, *coefficients)) == pytest.approx(alone)
