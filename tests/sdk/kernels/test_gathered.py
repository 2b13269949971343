"""A push is copied as it is, and refused if a sample is infinite."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.kernels.gathered import copy_sound
from floatref.values.arrays import frozen

SAMPLES = st.lists(st.floats(width=32) | st.just(np.nan) | st.just(-np.inf), max_size=40)


@given(SAMPLES, st.integers(0, 9), st.booleans())
def test_samples_lie_behind_one_another_and_only_infinite_ones_are_unsound(samples, start, fixed):
    values = np.array(samples, dtype=np.float64)
    target = np.full(start + values.size + 3, 7.0)
    assert copy_sound(frozen(values) if fixed else values, target, start) is not bool(
        np.isinf(values).any()
    )
    around = [7.0] * start, values.tolist(), [7.0] * 3
    assert np.array_equal(target, np.concatenate(around), equal_nan=True)
