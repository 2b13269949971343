"""Segments that are closed before the run ends are what they would be at its end."""

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from floatref.estimators.kalman import KalmanSmoother, Noise, Plan
from floatref.measures import high_pass
from floatref.values.block import join_blocks
from floatref.values.channels import ChannelId

pytestmark = pytest.mark.slow

RATE, SEGMENT = 50, 256
HEIGHT = ChannelId("floating_reference_height", "left")
SIGMA = ChannelId("elevation_sigma", "left")
laws = settings(deadline=None, max_examples=2, phases=[Phase.generate])


def run(drive, stage):
    """Return what comes out, and how many segments were kept behind each."""
    stage.start(drive.header)
    out, kept = [], []
    for block in drive.blocks(range(SEGMENT, len(drive.u), SEGMENT)):
        out.append(stage.push(block))
        kept.append(len(stage.memory["backlog"].lines["left"].segments))
    out += stage.finish()
    return join_blocks([block for block in out if len(block)]), kept


def over_distance(drive, samples):
    place, first = np.unique(drive.distance, return_index=True)
    return np.interp(np.arange(0.0, place[-1], 0.5), place, samples[first])


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    begin=st.floats(30.0, 60.0),
    lasts=st.floats(2.0, 40.0),
    lost=st.integers(0, 900),
    plan=st.sampled_from([Plan(), Plan(reflects=False)]),
)
def test_waiting_for_the_end_would_change_less_than_ten_micrometres(
    drive, seed, begin, lasts, lost, plan
):
    """Of what the filter over distance leaves, on a drive with a stop and an outage."""
    stops = [(begin, begin + lasts), (begin + lasts + 30.0, begin + lasts + 34.0), (200, 206)]
    drawn = drive(seed, 300.0, RATE, stops).without(slice(800 + lost, 860 + lost))
    early, kept = run(drawn, KalmanSmoother(plan, Noise()))
    late, all_kept = run(drawn, KalmanSmoother(plan, Noise(), tolerance_m=0.0))
    assert max(kept) < max(all_kept) == len(all_kept) - 1
    change = high_pass(over_distance(drawn, early[HEIGHT] - late[HEIGHT]), 0.5)
    assert np.abs(change).max() < 1e-5
    np.testing.assert_allclose(early[SIGMA], late[SIGMA], rtol=0.02)


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("tolerance_m", [3e-6, 1e-5])
def test_the_bound_alone_holds_what_comes_later_to_it(drive, seed, tolerance_m):
    """Without a time that is waited in any case, and with a stop that is longer than the lag."""
    drawn = drive(seed, 200.0, RATE, [(60.0, 110.0), (400.0, 410.0)])
    early, kept = run(drawn, KalmanSmoother(Plan(), Noise(), 105.91, tolerance_m, 0.0))
    late, all_kept = run(drawn, KalmanSmoother(Plan(), Noise(), tolerance_m=0.0))
    assert max(kept) < max(all_kept)
    change = high_pass(over_distance(drawn, early[HEIGHT] - late[HEIGHT]), 0.5)
    assert np.abs(change).max() < 5.0 * tolerance_m


@pytest.mark.parametrize("plan", [Plan(), Plan(gnss=False, attitude=False)])
def test_what_is_kept_does_not_grow_with_the_run(drive, plan):
    stops = [(40.0 + 120.0 * k, 50.0 + 120.0 * k) for k in range(6)]
    _, kept = run(drive(3, 720.0, RATE, stops), KalmanSmoother(plan, Noise()))
    assert max(kept) * SEGMENT / RATE < 400.0
