"""A channel on the shared grid: samples that are gone are missing ones, wherever they lie."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.screening import slow_series
from floatref.screening.second_sensor.fast_series import FastGrid, series_of
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel

COUNT = 400


@given(
    rate_hz=st.sampled_from([150.0, 1000.0]),
    gone=st.sets(st.integers(0, COUNT - 1)),
    begin=st.integers(0, 20),
    steps=st.integers(1, 30),
    chunk=st.sampled_from([16, 1 << 18]),
)
@settings(deadline=None)
def test_samples_that_are_gone_are_missing(
    rate_hz: float, gone: set[int], begin: int, steps: int, chunk: int
) -> None:
    values, numbers = np.sin(np.arange(COUNT)), np.array(sorted(gone), np.int64)
    without = values.copy()
    without[numbers] = np.nan
    clock, grid = UniformClock.of(rate_hz), FastGrid(0.005 * begin, steps)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(slow_series, "CHUNK", chunk)
        found = series_of(Channel.of("height", values, clock, track="left"), grid, numbers)
        expected = series_of(Channel.of("height", without, clock, track="left"), grid)
    np.testing.assert_array_equal(found, expected)
