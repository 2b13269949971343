"""Fits of the pulses around one, against plain loops, and how probable they are by chance."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.measures.clocks.pulse_pattern import FASTEST_DRIFT, NEIGHBOURS, fit_pattern

few = settings(deadline=None, max_examples=20)
seeds = st.integers(0, 2**32 - 1)
JITTER_S = 0.02


def poisson(rng, count):
    return np.cumsum(rng.exponential(4.0, count))


@few
@given(seed=seeds, own=st.integers(1, 40), base=st.integers(1, 40), data=st.data())
def test_the_share_is_that_of_the_pulses_that_have_one_near(seed, own, base, data) -> None:
    rng = np.random.default_rng(seed)
    own_s, base_s = poisson(rng, own), poisson(rng, base)
    i = data.draw(st.integers(0, own - 1))
    around = own_s[max(i - NEIGHBOURS, 0) : i + NEIGHBOURS + 1]
    expected = []
    for place in base_s:
        near = (
            min(abs(base_s - place - (t - own_s[i])))
            <= JITTER_S + FASTEST_DRIFT * abs(t - own_s[i])
            for t in around
        )
        expected.append(sum(near) / around.size)
    found = fit_pattern(own_s, base_s, i, JITTER_S)
    assert found.share == pytest.approx(expected)


@few
@given(seed=seeds, rate=st.floats(0.05, 5.0))
def test_strangers_have_evidence_as_seldom_as_it_says(seed, rate) -> None:
    """Evidence e of strangers has a probability of exp(-e) at most for either jitter."""
    rng = np.random.default_rng(seed)
    evidence = []
    for _ in range(20):
        own_s, base_s = poisson(rng, 60) / rate, poisson(rng, 120) / rate
        evidence.append(fit_pattern(own_s, base_s, int(rng.integers(60)), 0.005 / rate).evidence)
    found = np.concatenate(evidence)
    for least in (2.0, 4.0, 6.0):
        assert np.mean(found >= least) <= 2.0 * np.exp(-least)


def test_pulses_beyond_the_other_train_are_no_evidence_against() -> None:
    """Six in common are as good at the end of a train as they are alone."""
    rng = np.random.default_rng(5)
    own_s = np.cumsum(rng.uniform(1.0, 7.0, 30))
    alone = fit_pattern(own_s[:6], own_s[:6], 2, JITTER_S).evidence[2]
    assert fit_pattern(own_s, own_s[:6], 2, JITTER_S).evidence[2] == pytest.approx(alone, rel=0.01)
    assert alone > 15.0
