"""Runs of identical samples, however the signal is cut."""

from itertools import groupby, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import holds
from floatref.values.arrays import new_record, new_records

laws = settings(deadline=None, max_examples=150)


def found_in(x, least, outside, piece):
    """The runs that the kernel finds in pieces, of which the undone rest is given again."""
    memory, found, low = new_record(holds.RUN), [], 0
    while True:
        part = x[low : low + piece]
        runs = new_records(part.size // least + 2, holds.RUN)
        count, done = holds.find_runs(part, low, least, outside, memory, runs)
        found += [list(run) for run in runs[:count].tolist()]
        if low + part.size == x.size:
            break
        low += done
    return found + ([list(memory.tolist())] if memory.length > 0 else [])


def by_groups(x):
    """First index, length and value of every run, one sample at a time."""
    first = 0
    for value, group in groupby(x, key=lambda v: None if v != v else v):
        length = len(list(group))
        if value is not None:
            yield [first, length, value]
        first += length


samples = st.lists(
    st.tuples(st.sampled_from([0.0, 0.5, 3.0, np.nan]), st.integers(1, 12)),
    min_size=1,
    max_size=20,
).map(lambda runs: np.concatenate([np.full(length, value) for value, length in runs]))


@laws
@given(x=samples, least=st.integers(2, 6), more=st.integers(0, 30))
def test_runs_are_those_of_the_signal_in_any_pieces(x, least, more):
    expected = [run for run in by_groups(x) if run[1] >= least]
    every = np.array([np.inf, -np.inf])
    assert found_in(x, least, every, 2 * least + more) == expected
    ends = np.array([0.0, 3.0])
    extreme = [run for run in expected if run[2] in ends]
    assert found_in(x, least, ends, 2 * least + more) == extreme


@pytest.mark.slow
@laws
@given(x=samples, over=st.sampled_from([0.0, 0.5, 2.5]), data=st.data())
def test_every_run_is_counted_in_any_pieces(x, over, data):
    cuts = data.draw(st.sets(st.integers(0, x.size), max_size=5))
    memory, held = holds.new_count(), np.zeros(8, np.int64)
    for a, b in pairwise([0, *sorted(cuts), x.size]):
        holds.count_runs(x[a:b], over, memory, held)
    holds.count_runs(np.array([np.nan]), over, memory, held)
    after = [*x, np.nan]
    lengths = [n for first, n, v in by_groups(x) if not abs(after[first + n] - v) <= over]
    expected = [sum(min(length, 7) == n for length in lengths) for n in range(8)]
    assert held.tolist() == expected
    assert memory.in_long == sum(length for length in lengths if length >= 7)
    steps = np.abs(np.diff(x))
    steps = steps[steps > 0]
    assert memory.quantum == (steps.min() if steps.size else np.inf)
