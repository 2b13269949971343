"""Runs of identical samples, however the signal is cut."""

from itertools import groupby, pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import holds


def in_chunks(x, least, cuts):
    """The runs that the kernel finds, those it counts, and its memory."""
    memory = np.array([0.0, np.nan, 0.0, 0.0, np.inf, np.inf, -np.inf])
    held, found = np.zeros(holds.LONGEST, np.int64), []
    edges = [0, *sorted(cuts), x.size]
    parts = [(a, x[a:b]) for a, b in pairwise(edges)]
    for first, part in [*parts, (x.size, np.array([np.nan]))]:
        runs = np.empty((part.size // least + 1, 4))
        count = holds.find_runs(part, first, least, memory, held, runs)
        found += runs[:count].tolist()
    return found, held, memory


def by_groups(x):
    """First index, length, value and the larger step of every run, one sample at a time."""
    first = 0
    for value, group in groupby(x, key=lambda v: None if v != v else v):
        length = len(list(group))
        if value is not None:
            around = [x[k] if 0 <= k < x.size else np.nan for k in (first - 1, first + length)]
            steps = [1e300 if v != v else abs(v - value) for v in around]
            yield [first, length, value, max(steps)]
        first += length


samples = st.lists(st.sampled_from([0.0, 0.5, 3.0, np.nan]), min_size=1, max_size=80)


@settings(deadline=None, max_examples=150)
@given(values=samples, least=st.integers(1, 5), data=st.data())
def test_runs_are_those_of_the_signal_in_any_chunks(values, least, data):
    x = np.array(values)
    cuts = data.draw(st.sets(st.integers(0, x.size), max_size=5))
    found, held, memory = in_chunks(x, least, cuts)
    expected = list(by_groups(x))
    assert found == [run for run in expected if run[1] >= least]
    for length in {run[1] for run in expected}:
        assert held[length] == sum(run[1] for run in expected if run[1] == length)
    known = x[~np.isnan(x)]
    steps = np.abs(np.diff(x))
    steps = steps[steps > 0]
    assert memory[4] == (steps.min() if steps.size else np.inf)
    if known.size:
        assert memory[5:].tolist() == [known.min(), known.max()]


def test_very_long_runs_are_counted_together():
    _, held, _ = in_chunks(np.zeros(3 * holds.LONGEST), 3, {7})
    assert held[-1] == held.sum() == 3 * holds.LONGEST
