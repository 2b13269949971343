"""How far an encoder has been, at knots, however the signal is cut."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening.damage import encoder_progress
from floatref.values.arrays import new_records


def in_chunks(x, apart, cuts, times):
    """Knots, stretches behind and depths that the kernel finds in pieces of ``x``."""
    progress = encoder_progress.new_progress()
    knots, behind, depths = [], [], []
    for a, b in pairwise([0, *sorted(cuts), x.size]):
        rows = new_records(b - a, encoder_progress.KNOT)
        spans, deep = np.empty((b - a, 2), np.int64), np.empty(b - a)
        found, back = encoder_progress.follow(
            x[a : b + 1], b - a, a, times[a:b], apart, progress, rows, spans, deep
        )
        knots += list(rows[:found])
        behind += [n for first, end in spans[:back].tolist() for n in range(first, end)]
        depths += deep[:back].tolist()
    return knots, behind, depths, float(progress.far)


def ahead(x):
    """Samples farther than all before, and those less far; one at a time."""
    far, lead, back = -np.inf, [], []
    for n, value in enumerate(x):
        if value > far:
            lead.append(n)
            far = value
        elif value < far:
            back.append(n)
    return lead, back


samples = st.lists(st.sampled_from([0.0, 1.0, 2.0, 4.0, 5.0, np.nan]), min_size=1, max_size=80)


@pytest.mark.slow
@settings(deadline=None, max_examples=150)
@given(values=samples, apart=st.sampled_from([1.0, 4.0]), data=st.data())
def test_knots_are_those_of_the_signal_in_any_chunks(values, apart, data):
    x = np.array(values)
    cuts = data.draw(st.sets(st.integers(0, x.size), max_size=5))
    times = data.draw(st.sampled_from([np.empty(0), np.arange(x.size, dtype=float)]))
    knots, behind, depths, far = in_chunks(x, apart, cuts, times)
    lead, back = ahead(x)
    assert behind == back
    assert sum(depths) <= 5.0 * len(back)
    if not lead:
        assert knots == []
        return
    assert far == x[lead[-1]]
    assert [row["at"] for row in knots] == at_least_apart(lead, apart)
    for before, row in pairwise(knots):
        way = [n for n in lead if before["at"] <= n <= row["at"]]
        steps = [(x[b] - x[a], a, b) for a, b in pairwise(way)]
        assert row["steps"] == len(steps)
        _, front, to = max(steps, key=lambda step: step[0])
        assert (row["step"], row["front"]) == (to, front)
        assert row["before_step"] == max(n for n in range(to) if x[n] == x[n])
        assert row["after_gap"] - row["gap"] == max(b - a for _, a, b in steps)
        assert (row["gap"], row["after_gap"]) in [(a, b) for _, a, b in steps]
        assert row["since"] == way[-2]


def at_least_apart(lead, apart):
    found = lead[:1]
    for n in lead[1:]:
        if n - found[-1] >= apart:
            found.append(n)
    return found


@settings(deadline=None, max_examples=60)
@given(
    at=st.integers(60, 140),
    height=st.floats(7.0, 1e3),
    step=st.integers(0, 1),
    cut=st.integers(0, 200),
)
def test_what_comes_back_at_once_is_no_way_ahead(at, height, step, cut):
    x = step * np.arange(200.0) + np.arange(200) // 50
    clean, _, _, _ = in_chunks(np.delete(x, at), 25.0, set(), np.delete(np.arange(200.0), at))
    x[at] += height
    knots, behind, depths, far = in_chunks(x, 25.0, {cut}, np.empty(0))
    assert behind == [at]
    assert depths == [x[at] - x[at - 1]]
    assert far == x[-1]
    assert len(knots) == len(clean)
