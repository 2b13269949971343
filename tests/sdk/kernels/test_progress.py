"""How far an encoder has been, however the signal is cut."""

from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.kernels import progress

samples = st.lists(st.sampled_from([0.0, 0.5, 3.0, np.nan]), min_size=1, max_size=80)


def followed(x, longer):
    """Steps above ``longer``, samples behind, sum of steps and of squares; one sample at a time."""
    far, back, total, squares = [], [], 0.0, 0.0
    for k, value in enumerate(x):
        before = [(v, n) for n, v in enumerate(x[:k]) if v == v]
        if value != value:
            continue
        most = max(v for v, _ in before) if before else -np.inf
        if value < most:
            back.append(k)
        elif k > 0 and x[k - 1] == x[k - 1]:
            total, squares = total + value - most, squares + (value - most) ** 2
            if value - most > longer:
                far.append([k, max(n for v, n in before if v == most)])
    return far, back, total, squares


@settings(deadline=None, max_examples=150)
@given(values=samples, longer=st.sampled_from([0.0, 0.7, 2.6]), data=st.data())
def test_progress_is_that_of_the_signal_in_any_chunks(values, longer, data):
    x = np.array(values)
    cuts = data.draw(st.sets(st.integers(0, x.size), max_size=5))
    memory = np.zeros(progress.PROGRESS)
    memory[0] = -np.inf
    far, back = [], []
    for a, b in pairwise([0, *sorted(cuts), x.size]):
        steps, behind = np.empty((b - a, 2), np.int64), np.empty(b - a, np.int64)
        counts = progress.progress(x[a:b], a, memory, longer, steps, behind)
        far += steps[: counts[0]].tolist()
        back += behind[: counts[1]].tolist()
    assert (far, back, memory[3], memory[4]) == followed(x, longer)
