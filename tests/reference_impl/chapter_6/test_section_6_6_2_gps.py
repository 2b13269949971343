"""GPS is observed where it has a reading, with the uncertainty it was given."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_reference.appendix_c.measurement_model import matrix_r
from floatref_reference.chapter_6.section_6_4_4_tuning import SIGMA_GPS
from floatref_reference.chapter_6.section_6_6_2_gps import gps_observations

X = np.zeros(7)


@settings(deadline=None, max_examples=20)
@given(steps=st.sets(st.integers(0, 50), max_size=10), seed=st.integers(0, 99))
def test_readings_come_at_their_steps_and_nowhere_else(steps: set[int], seed: int) -> None:
    ordered = sorted(steps)
    y = np.random.default_rng(seed).normal(size=(len(ordered), 4))
    observe = gps_observations(ordered, y)
    expected = dict(zip(ordered, y, strict=True))
    for k in range(51):
        found = observe(k, X)
        assert (found is None) == (k not in steps)
        if found is not None:
            assert (found[0] == expected[k]).all()
            assert np.diag(found[1]) == pytest.approx(matrix_r(SIGMA_GPS))


def test_every_reading_can_have_its_own_uncertainty() -> None:
    sigma = np.arange(1.0, 9.0).reshape(2, 4)
    observe = gps_observations([3, 7], np.zeros((2, 4)), sigma)
    assert [observe(k, X)[1].tolist() for k in (3, 7)] == (sigma**2).tolist()
