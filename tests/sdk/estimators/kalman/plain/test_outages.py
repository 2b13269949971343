"""What stands in for GNSS that is lost, or was never there."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import Noise, Plan

# A drive that has been shrunk fails for the same reason, after minutes.
laws = settings(deadline=None, max_examples=5, phases=[Phase.explicit, Phase.generate])
SEEDS = st.integers(0, 2**32 - 1)
STOP = (1.2, 2.1)


@pytest.mark.slow
@pytest.mark.cites("(6.65)", "(6.66)")
@laws
@given(seed=SEEDS, plan=st.sampled_from([Plan(gnss=False), Plan(), Plan(reflects=False)]))
def test_without_any_gnss_constants_are_observed(drive, assert_same, seed, plan):
    """A plan with GNSS waits half a second for it."""
    drawn = drive(seed, 2.5, 400, STOP)
    drawn = drawn.without(slice(None)) if plan.gnss else drawn
    assert_same(drawn, Noise(), plan)


@pytest.mark.slow
@laws
@given(
    seed=SEEDS,
    outages=st.lists(
        st.tuples(st.sampled_from([0, 2, 15, 33, 55]), st.integers(3, 20)), min_size=1, max_size=3
    ),
    plan=st.builds(Plan, attitude=st.booleans(), reflects=st.booleans()),
)
def test_constants_stand_in_for_gnss_that_is_lost(drive, assert_same, seed, outages, plan):
    """Heights are held where each outage begins; afterwards GNSS may be told from another datum."""
    drawn = drive(seed, 4.0, 400, STOP)
    lost = np.concatenate([np.arange(a, min(a + n, drawn.at.size)) for a, n in outages])
    assert_same(drawn.without(np.unique(lost)), Noise(), plan)
