"""The laws of the stage protocol, with GNSS readings on their own clock and segments that close."""

from types import MappingProxyType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.estimators.kalman import KalmanFilter, KalmanSmoother, Noise, Plan
from floatref.estimators.kalman.inputs import IMU
from floatref.values.block import Axis, join_blocks
from floatref_conformance.testing import StageLaws

pytestmark = pytest.mark.slow

laws = settings(deadline=None, max_examples=4)
SEEDS = st.integers(0, 2**32 - 1)
RATE = 100
SECONDS = 21.0
LENGTH = round(RATE * SECONDS)
SEGMENT = 4 * RATE
STAGES = {
    "filter": lambda plan: KalmanFilter(plan, Noise()),
    "smoother": lambda plan: KalmanSmoother(plan, Noise(), 20.0, tolerance_m=1e-4, waiting_s=0.0),
}
every_stage = pytest.mark.parametrize("name", STAGES)
PLANS = st.sampled_from([Plan(), Plan(reflects=False), Plan(gnss=False, attitude=False)])
CUTS = st.lists(st.integers(1, LENGTH - 1), max_size=8, unique=True)


def assert_same(one, other):
    assert (one.first, one.values.keys()) == (other.first, other.values.keys())
    assert [event.time_s for event in one.events] == [event.time_s for event in other.events]
    for channel, samples in one.values.items():
        np.testing.assert_array_equal(samples, other[channel], err_msg=str(channel))
    assert one.flags.keys() == other.flags.keys()
    for channel, marks in one.flags.items():
        np.testing.assert_array_equal(marks, other.flags[channel], err_msg=str(channel))


def lacking(drive, seed):
    """Return a drive through an outage and a stop, in which samples of all sensors are missing."""
    drawn = drive(seed, SECONDS, RATE, (9.0, 11.0)).without(slice(40, 60))
    rng = np.random.default_rng(seed)
    drawn.u[rng.uniform(size=drawn.u.shape) < 0.001] = np.nan
    drawn.height[rng.uniform(size=LENGTH) < 0.01] = np.nan
    return drawn


@every_stage
@laws
@given(seed=SEEDS, plan=PLANS, cuts=CUTS, every=st.sampled_from([1, 7, SEGMENT, 1300, LENGTH]))
def test_1_any_split_gives_the_same_bits(drive, through, name, seed, plan, cuts, every):
    """Blocks of one sample, and of more than a segment."""
    drawn = lacking(drive, seed)
    whole = through(STAGES[name](plan), drawn)
    assert_same(through(STAGES[name](plan), drawn, cuts), whole)
    assert_same(through(STAGES[name](plan), drawn, range(every, LENGTH, every)), whole)


@every_stage
@laws
@given(seed=SEEDS, plan=PLANS, at=st.integers(1, 5))
def test_4_saving_and_restoring_changes_nothing(drive, through, name, seed, plan, at):
    drawn = lacking(drive, seed)
    blocks = drawn.blocks(range(350, LENGTH, 350))
    stage, other = STAGES[name](plan), STAGES[name](plan)
    for each in (stage, other):
        each.start(drawn.header)
    out = [stage.push(block) for block in blocks[:at]]
    saved = stage.state()
    for block in blocks[at:]:
        stage.push(block)
    other.restore(saved)
    out += [other.push(block) for block in blocks[at:]]
    out += other.finish()
    assert_same(
        join_blocks([block for block in out if len(block)]), through(STAGES[name](plan), drawn)
    )


@laws
@given(seed=SEEDS)
def test_the_smoother_is_done_with_segments_before_the_run_ends(drive, seed):
    drawn = drive(seed, SECONDS, RATE)
    stage = STAGES["smoother"](Plan())
    stage.start(drawn.header)
    out = [stage.push(block) for block in drawn.blocks(range(50, LENGTH, 50))]
    assert 0 < sum(map(len, out)) < LENGTH
    assert sum(map(len, out)) + sum(map(len, stage.finish())) == LENGTH


@every_stage
@pytest.mark.parametrize("length", [1, 2, 3, SEGMENT, SEGMENT + 1, SEGMENT + 2])
def test_a_run_of_any_length_comes_out_whole(drive, through, name, length):
    out = through(STAGES[name](Plan()), drive(1, length / RATE, RATE))
    assert len(out) == length
    assert all(np.isfinite(samples).all() for samples in out.values.values())


@every_stage
@pytest.mark.parametrize(
    "missing", [*IMU, "vertical_acceleration", "height", "distance", "travel_speed"]
)
def test_a_channel_that_is_not_there_is_named(drive, name, missing):
    header = drive(1, 0.1, RATE).header.without(missing)
    with pytest.raises(
        InputError, match=f"needs channel (left.)?{missing}; add a stage that makes it"
    ):
        STAGES[name](Plan()).start(header)


@every_stage
def test_it_works_in_time_alone(drive, name):
    header = drive(1, 0.1, RATE).header.on_distance(0.05, 0.0)
    assert header.axis is Axis.DISTANCE
    with pytest.raises(InputError, match="the stream is not on the time axis"):
        STAGES[name](Plan()).start(header)


class TestFilter(StageLaws):
    """Two wheel paths, and samples that agree with no drive."""

    reads = ("vertical_acceleration", "height")
    shared = (*IMU, "distance", "travel_speed")
    ranges = MappingProxyType({"travel_speed": (0.03, 1.0)})
    reach = None

    def make(self):
        return KalmanFilter(Plan(), Noise())


class TestSmoother(TestFilter):
    """The same, held back until the readings no longer matter."""

    def make(self):
        return KalmanSmoother(Plan(), Noise())
