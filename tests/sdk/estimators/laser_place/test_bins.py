"""What was found of a run in bins does not depend on its blocks, and is let go behind them."""

from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.laser_place.bins import BinsAhead

NAMES = ("raised", "added")


@st.composite
def found_runs(draw):
    """Return bins by name, the samples of each, and the begins of the blocks of a run."""
    size, every = draw(st.integers(1, 60)), draw(st.integers(1, 7))
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    # Zeros for a while, as far from any stop.
    shown = rng.uniform(size=size) < draw(st.sampled_from([0.0, 0.1, 1.0]))
    found = {name: rng.normal(size=size) * shown for name in NAMES}
    samples = size * every + draw(st.integers(0, every - 1))
    cuts = draw(st.lists(st.integers(0, samples), max_size=12))
    return found, every, sorted({0, *cuts, samples})


@given(run=found_runs(), begin=st.integers(-50, 50))
@settings(deadline=None)
def test_blocks_have_the_lines_between_the_middles_of_bins(run, begin):
    """Flat before the first and behind the last, which stay as they are."""
    found, every, edges = run
    ahead = BinsAhead(dict(found), begin, every)
    for low, high in pairwise(edges):
        for name, bins in found.items():
            middles = every * np.arange(bins.size) + 0.5 * (every - 1)
            expected = np.interp(np.arange(low, high), middles, bins)
            values = ahead.at(name, begin + low, high - low)
            np.testing.assert_allclose(values, expected, rtol=1e-12, atol=1e-12)


@given(run=found_runs(), begin=st.integers(-50, 50))
@settings(deadline=None)
def test_a_run_in_blocks_has_the_bits_of_one(run, begin):
    found, every, edges = run
    ahead = BinsAhead(dict(found), begin, every)
    parts = [ahead.at("added", begin + a, b - a) for a, b in pairwise(edges)]
    whole = BinsAhead(dict(found), begin, every).at("added", begin, edges[-1])
    np.testing.assert_array_equal(np.concatenate([np.empty(0), *parts]), whole)


def test_no_more_than_twice_of_what_lies_ahead_is_kept():
    """A 1-hour run in blocks of 10 s: it has shrunk to nothing when its profile is whole."""
    size, every, step = 360_000, 4, 4_000
    ahead = BinsAhead({name: np.ones(size) for name in NAMES}, 0, every)
    for first in range(0, size * every, step):
        for name in NAMES:
            ahead.at(name, first, step)
        left = size - first // every
        for bins in ahead.found.values():
            assert bins.base is None
            assert bins.size <= 2 * left + 4
