"""From flags to validity."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.architectures import validity
from floatref.architectures.validity import valid_points
from floatref.values.arrays import Flag


@settings(deadline=None, max_examples=60)
@given(
    flags=st.lists(st.sampled_from([0, 0, 0, 0, 1, 2, 3]), max_size=40),
    reach=st.integers(0, 12),
    piece=st.integers(1, 50),
)
def test_a_point_is_valid_without_flags_and_far_from_drift(flags, reach, piece):
    drift = [k for k, flag in enumerate(flags) if flag & Flag.DRIFT]
    expected = [
        flag == 0 and all(abs(k - other) > reach for other in drift) for k, flag in enumerate(flags)
    ]
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(validity, "PIECE", piece)
        assert valid_points(np.array(flags, np.uint8), reach).tolist() == expected
