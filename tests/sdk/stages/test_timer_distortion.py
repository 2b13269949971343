"""The adjusted time step keeps its two limits however long the stop."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.stages.timer_distortion import DistortTimer, adjusted_time_step
from floatref.values.block import Axis, Block, Header
from floatref.values.channels import ChannelId

LIMIT = 0.0014205


def printed(step, limit, sharpness):
    """(5.8) as printed, in extended precision."""
    ratio = np.longdouble(step) / np.longdouble(limit)
    beta = np.longdouble(sharpness)
    return limit * (1 + ratio - (1 + ratio**beta) ** (1 / beta))


@pytest.mark.cites("(5.8)")
@settings(deadline=None, max_examples=60)
@given(ratio=st.floats(1e-3, 50.0), sharpness=st.floats(2.0, 60.0))
def test_it_is_the_printed_step(ratio, sharpness):
    found = adjusted_time_step(np.array([LIMIT * ratio]), LIMIT, sharpness)[0]
    assert found == pytest.approx(float(printed(LIMIT * ratio, LIMIT, sharpness)), rel=1e-12)


@pytest.mark.cites("(5.8)")
def test_its_limits_are_the_step_itself_and_the_limit():
    steps = np.array([0.0, 1e-300, 1e-5, 1.0, 1e4, 1e12])
    with np.errstate(over="raise", invalid="raise"):
        found = adjusted_time_step(steps, LIMIT)
    np.testing.assert_array_equal(found[:3], steps[:3])
    assert found[3:] == pytest.approx([LIMIT] * 3, rel=1e-15)


@settings(deadline=None, max_examples=40)
@given(
    steps=st.lists(st.floats(0.0, 100.0), min_size=2, max_size=20), sharpness=st.floats(2.0, 50.0)
)
def test_it_grows_with_the_step_and_never_beyond_it_or_the_limit(steps, sharpness):
    steps = np.sort(steps)
    found = adjusted_time_step(steps, LIMIT, sharpness)
    assert (np.diff(found) >= -1e-15 * LIMIT).all()
    assert (found <= np.minimum(steps, LIMIT) * (1 + 1e-15)).all()


@pytest.mark.parametrize(
    ("limit", "sharpness", "message"),
    [
        (0.0, 25.0, "limit 0.0 s: give it above zero"),
        (-1.0, 25.0, "limit -1.0 s: give it above zero"),
        (1.0, float("nan"), "timer_sharpness nan: give it at 2 or above"),
        (1.0, 1.0, "timer_sharpness 1: give it at 2 or above"),
    ],
)
def test_numbers_that_limit_nothing_or_all_are_refused(limit, sharpness, message):
    with pytest.raises(InputError, match=message):
        adjusted_time_step(np.ones(2), limit, sharpness)


def test_the_step_as_it_was_is_kept_and_stays_its_owners():
    step = ChannelId("time_step")
    stage, given = DistortTimer(), np.array([0.0, 0.01, 3.0])
    stage.start(Header(Axis.DISTANCE, 0.05, 0.0, Fraction(10), frozenset({step}), ("main",)))
    out = stage.push(Block(0, {step: given}))
    assert given.flags.writeable
    kept = out[ChannelId("true_time_step")]
    np.testing.assert_array_equal(kept, given)
    assert not kept.flags.writeable
