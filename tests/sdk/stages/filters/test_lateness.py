"""A filter's delay taken off: the channel comes from later on, all else as it was."""

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.errors import InputError
from floatref.stages.filters.butterworth import low_pass_b3
from floatref.stages.filters.lateness import Advance
from floatref.values.arrays import Flag
from floatref.values.block import Axis
from floatref.values.channels import ChannelId
from floatref_conformance.testing import StageLaws, Stream
from floatref_conformance.testing.streams import LENGTH, STEP

UP, RANGE = ChannelId("vertical_acceleration", "left"), ChannelId("height", "left")


def stream(samples, delay_s):
    return Stream(lambda: Advance(UP.name, delay_s), samples, ("left",))


@settings(deadline=None, max_examples=20)
@given(count=st.integers(0, LENGTH + 20), seed=st.integers(0, 99))
def test_the_channel_comes_from_so_many_samples_later(count, seed):
    rng = np.random.default_rng(seed)
    samples = {c: rng.standard_normal(LENGTH) for c in (UP, RANGE)}
    out = stream(samples, count * STEP).run(cuts=[17, 100])
    later = np.minimum(np.arange(LENGTH) + count, LENGTH - 1)
    np.testing.assert_array_equal(out[UP], samples[UP][later])
    np.testing.assert_array_equal(out[RANGE], samples[RANGE])


def test_a_flag_goes_with_its_sample():
    samples = {c: np.zeros(LENGTH) for c in (UP, RANGE)}
    marks = np.zeros(LENGTH, np.uint8)
    marks[60] = Flag.MISSING
    drawn = Stream(lambda: Advance(UP.name, 5 * STEP), samples, ("left",), flags={UP: marks})
    np.testing.assert_array_equal(np.flatnonzero(drawn.run().flags[UP]), [55])


def test_the_delay_of_a_low_pass_is_taken_off():
    """A wave far below the cut-off comes out where it was; without, 2 over that frequency late."""
    cutoff, times = 10.0, np.arange(LENGTH) * STEP
    wave = np.sin(2 * np.pi * 0.9 * times)
    samples = dict.fromkeys((UP, RANGE), wave)
    filtered = dict(samples)
    for stage in low_pass_b3(UP.name, cutoff):
        filtered[UP] = Stream(lambda stage=stage: stage, filtered, ("left",)).run()[UP]
    out = stream(filtered, 1.0 / (pi * cutoff)).run()[UP]
    inner = slice(60, -10)
    assert np.abs(filtered[UP] - wave)[inner].max() > 0.15
    assert np.abs(out - wave)[inner].max() < 0.02


def test_it_works_in_time_alone():
    drawn = Stream(lambda: Advance(UP.name, 0.1), {UP: np.zeros(9)}, ("left",), Axis.DISTANCE)
    with pytest.raises(InputError, match="the stream is not on the time axis"):
        drawn.run()


class TestAdvance(StageLaws):
    reads = ("vertical_acceleration", "height")

    def make(self):
        return Advance("vertical_acceleration", 0.07)
