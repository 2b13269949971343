"""The NIS by its definition, and by measurements taken one after the other."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.beyond.innovations import (
    chi_square_below,
    innovation,
    mean_nis,
    nis,
    normalized,
)
from floatref_reference.chapter_6.section_6_1_1_linear import measurement_update

SEEDS = st.integers(0, 2**32 - 1)
laws = settings(deadline=None, max_examples=25)


def drawn(seed: int, nm: int):
    """Return x, P, H and R of three states and ``nm`` measurements."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(3, 3))
    P, H = root @ root.T + 0.1 * np.eye(3), rng.normal(size=(nm, 3))
    return rng, rng.normal(size=3), P, H, np.diag(rng.uniform(0.1, 2.0, nm))


@laws
@given(seed=SEEDS, nm=st.integers(1, 4))
def test_nis_is_the_quadratic_form(seed: int, nm: int) -> None:
    rng, x, P, H, R = drawn(seed, nm)
    nu, S = innovation(P, rng.normal(size=nm), H @ x, H, R)
    assert nis(nu, S) == pytest.approx(float(nu @ np.linalg.inv(S) @ nu))


@laws
@given(seed=SEEDS, nm=st.integers(1, 4), missing=st.integers(0, 3))
def test_one_after_the_other_gives_the_same(seed: int, nm: int, missing: int) -> None:
    """(6.7) for one measurement at a time, its row of H alone; a missing one is left out."""
    rng, x, P, H, R = drawn(seed, nm)
    y = rng.normal(size=nm)
    y[missing:][: nm - 1] = np.nan
    nu, S = innovation(P, y, H @ x, H, R)
    found = []
    for i in np.flatnonzero(~np.isnan(y)):
        row, variance = H[i : i + 1], R[i : i + 1, i : i + 1]
        own, spread = innovation(P, y[i : i + 1], row @ x, row, variance)
        found.append(own[0] / math.sqrt(spread[0, 0]))
        x, P = measurement_update(x, P, y[i : i + 1], row, variance)
    assert normalized(nu, S) == pytest.approx(np.array(found), abs=1e-9)


@pytest.mark.slow
def test_of_drawn_states_and_readings_the_mean_is_one() -> None:
    z = []
    for seed in range(2000):
        rng, x, P, H, R = drawn(seed, 2)
        true = rng.multivariate_normal(x, P)
        y = H @ true + rng.multivariate_normal(np.zeros(2), R)
        z.extend(normalized(*innovation(P, y, H @ x, H, R)))
    assert mean_nis(z) == pytest.approx(1.0, abs=4.0 * math.sqrt(2.0 / len(z)))


@pytest.mark.parametrize(
    ("x", "n", "expected"),
    [
        (3.841458821, 1, 0.95),
        (5.991464547, 2, 0.95),
        (1.386294361, 2, 0.5),
        (124.342113, 100, 0.95),
    ],
)
def test_quantiles_in_print(x: float, n: int, expected: float) -> None:
    assert chi_square_below(x, n) == pytest.approx(expected, abs=1e-7)
