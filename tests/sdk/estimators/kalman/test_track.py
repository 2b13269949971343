"""Inputs that are missing: they count as zero, wherever the blocks are cut."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan

RATE, LENGTH = 200, 400
laws = settings(deadline=None, max_examples=10)


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    stage=st.sampled_from([KalmanFilter, KalmanSmoother]),
    lost=st.lists(st.tuples(st.integers(0, LENGTH - 1), st.integers(0, 5)), min_size=1, max_size=4),
    cut=st.integers(0, 2),
)
def test_missing_inputs_count_as_zero(drive, height_of, seed, stage, lost, cut):
    """Also where a block ends with one, or holds nothing else."""
    whole = drive(seed, LENGTH / RATE, RATE)
    gaps, zeros = whole.u.copy(), whole.u.copy()
    for sample, channel in lost:
        gaps[sample, channel] = np.nan
        # The accelerometer's 1 g is taken off before the stage.
        zeros[sample, channel] = 9.80665 if channel == 2 else 0.0
    cuts = sorted({min(sample + cut, LENGTH) for sample, _ in lost} | {lost[0][0]})
    ours = height_of(stage(Plan(), Noise()), replace(whole, u=gaps), cuts)
    np.testing.assert_array_equal(ours, height_of(stage(Plan(), Noise()), replace(whole, u=zeros)))
