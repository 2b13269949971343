"""Where a vehicle is stationary does not depend on how few samples are read."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floatref.measures.clocks.skew_series import STEP_S, find_standing
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel


@given(
    st.sampled_from([1000.0, 1333.3, 4000.0]),
    st.sampled_from([0.0, -3.7, 12.3456]),
    st.integers(0, 2**31),
    st.booleans(),
)
def test_it_is_stationary_where_lines_through_all_samples_are(rate_hz, start_s, seed, gap):
    rng = np.random.default_rng(seed)
    clock = UniformClock.of(rate_hz, start_s)
    stops = np.repeat(rng.integers(0, 2, 12), round(rate_hz))
    values = np.cumsum(stops * rng.uniform(0.0, 2e-2, stops.size))
    if gap:
        values[100:140] = np.nan
    distance = Channel.of("distance", values, clock)
    times = clock.times(values.size)
    known = ~np.isnan(values)
    # The same samples with times of their own, all of which are read.
    whole = Channel.of("distance", values[known], StampedClock.of(times[known]))
    grid = np.arange(start_s - 0.5, times[-1] + 0.5, STEP_S)
    found = find_standing(distance, grid, 0.002, 0.75)
    np.testing.assert_array_equal(found, find_standing(whole, grid, 0.002, 0.75))
