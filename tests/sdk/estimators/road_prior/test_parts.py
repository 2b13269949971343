"""What comes out in parts: no step between them, and what the whole run tells but for its level."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from floatref.estimators.road_prior import RoadPriorSmoother
from floatref.values.channels import ChannelId

RATE = 100
HEIGHT = ChannelId("floating_reference_height", "left")


@pytest.mark.slow
@settings(deadline=None, max_examples=5)
@given(seed=st.integers(0, 2**32 - 1))
def test_parts_follow_one_another_without_a_step(drive, through, seed):
    drawn = drive(seed, 120.0, RATE)
    parts = RoadPriorSmoother(waiting_s=8.0, tolerance_m=1e-3)
    early = through(parts, drawn, range(100, 12000, 100))
    whole = through(RoadPriorSmoother(tolerance_m=0.0), drawn)
    off = early[HEIGHT] - whole[HEIGHT]
    assume(np.ptp(off) > 1e-3)
    # A level of metres per kilometre: the high-pass leaves nothing of it.
    assert np.abs(np.diff(off)).max() < np.ptp(off) / 200
