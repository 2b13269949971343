"""From nodes to samples: cubics of corrections, lines of 1-sigma."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.smoothing import segment
from floatref.estimators.smoothing.nodes import CORRECTION
from floatref.values.arrays import new_record

STEP = 0.01
laws = settings(deadline=None, max_examples=30)
SEEDS = st.integers(0, 2**32 - 1)


def value_and_slope(cubic, sample):
    return np.polyval(cubic, sample * STEP), np.polyval(np.polyder(cubic), sample * STEP)


@laws
@given(seed=SEEDS, spans=st.lists(st.integers(1, 9), min_size=1, max_size=6), data=st.data())
def test_between_nodes_a_correction_is_the_cubic_of_its_ends(seed, spans, data):
    """A correction that is one in every sub-block, with jumps at nodes, comes out exactly.

    The samples may be given in two pieces.
    """
    rng = np.random.default_rng(seed)
    begin, cubics = 3, rng.normal(size=(len(spans) + 1, 4))
    ends = begin + np.cumsum(spans)
    near = [value_and_slope(cubics[k], end) for k, end in enumerate(ends)]
    far = [value_and_slope(cubics[k + 1], end) for k, end in enumerate(ends)]
    start = new_record(CORRECTION)
    start.far_height, start.far_velocity = value_and_slope(cubics[0], begin)
    height = rng.normal(size=ends[-1] - begin)
    filled = height.copy()
    corrections = np.array([(*n, *f) for n, f in zip(near, far, strict=True)], CORRECTION)
    cut = data.draw(st.integers(0, height.size))
    for first, part in ((begin + 1, filled[:cut]), (begin + 1 + cut, filled[cut:])):
        segment.interpolate(begin, start, ends, corrections, first, STEP, part)
    samples = np.arange(begin + 1, ends[-1] + 1)
    which = np.searchsorted(ends, samples, "right")
    expected = [np.polyval(cubics[k], i * STEP) for k, i in zip(which, samples, strict=True)]
    np.testing.assert_allclose(filled - height, expected, atol=1e-12)


@laws
@given(
    places=st.sets(st.integers(0, 60), min_size=1, max_size=8),
    first=st.integers(0, 60),
    count=st.integers(0, 70),
    seed=SEEDS,
)
def test_a_ramp_is_the_line_through_its_values_and_level_beyond(places, first, count, seed):
    at = np.array(sorted(places))
    values = np.random.default_rng(seed).normal(size=at.size)
    line = np.empty(count)
    segment.ramp(at, values, first, line)
    np.testing.assert_allclose(line, np.interp(first + np.arange(count), at, values), atol=1e-12)
