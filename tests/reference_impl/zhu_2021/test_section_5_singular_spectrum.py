"""Singular spectrum analysis: what it keeps is a series, what it drops is noise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.zhu_2021.section_5_singular_spectrum import (
    decomposition,
    denoise,
    diagonal_averaging,
    embedding,
    grouping,
)

SEEDS = st.integers(0, 9999)


@settings(deadline=None, max_examples=20)
@given(seed=SEEDS, N=st.integers(4, 40), data=st.data())
def test_averaging_the_diagonals_undoes_the_embedding(seed: int, N: int, data) -> None:
    x = np.random.default_rng(seed).normal(size=N)
    X = embedding(x, data.draw(st.integers(2, N // 2)))
    assert diagonal_averaging(X) == pytest.approx(x)


@settings(deadline=None, max_examples=20)
@given(seed=SEEDS, L=st.integers(2, 12))
def test_eigenvalues_are_the_energy_of_their_components(seed: int, L: int) -> None:
    X = embedding(np.random.default_rng(seed).normal(size=30), L)
    lambdas, U = decomposition(X)
    assert (np.diff(lambdas) <= 0).all()
    for i in range(L):
        assert np.sum(grouping(X, U, [i]) ** 2) == pytest.approx(lambdas[i], abs=1e-9)
    assert grouping(X, U, list(range(L))) == pytest.approx(X)


@pytest.mark.cites("section 5 of Zhu")
@settings(deadline=None, max_examples=20)
@given(seed=SEEDS, f=st.floats(0.05, 0.45))
def test_a_sine_has_two_components(seed: int, f: float) -> None:
    phase = np.random.default_rng(seed).uniform(0, 7)
    x = np.sin(2 * np.pi * f * np.arange(80) + phase)
    assert denoise(x, 20, 2) == pytest.approx(x, abs=1e-6)


@pytest.mark.cites("section 5 of Zhu")
def test_noise_is_taken_off() -> None:
    rng = np.random.default_rng(5)
    x = np.sin(2 * np.pi * 0.03 * np.arange(300))
    noisy = x + 0.5 * rng.normal(size=300)
    left = denoise(noisy, 60, 2) - x
    assert np.sum(left**2) < 0.1 * np.sum((noisy - x) ** 2)


@pytest.mark.parametrize(("L", "r"), [(1, 1), (16, 1), (10, 0), (10, 11)])
def test_windows_and_components_that_do_not_fit_are_refused(L: int, r: int) -> None:
    with pytest.raises(ValueError, match=r"does not fit|cannot be retained"):
        denoise(np.zeros(30), L, r)
