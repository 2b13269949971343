"""Memory: it may be as large as it likes in the first half, and does not grow in the second."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref_conformance.checks.streams.memory import MemoryCheck
from floatref_conformance.checks.streams.stream_check import StreamCase
from floatref_conformance.errors import DeviceError, DeviceSkipped
from floatref_conformance.proving_ground.scenario import Scenario

from .conftest import END_S, LATENCY, MadeUp

CHECK = MemoryCheck()
REPEATS = 12
RATE = 100.0
"""Samples a second of the recording."""
AT_S = np.arange(0.0, REPEATS * END_S, 10.0)


def runs(transcript, memory, latency=LATENCY):
    long = transcript(latency=latency, memory=zip(AT_S.tolist(), memory, strict=True))
    case = StreamCase("long", Scenario(), repeats=REPEATS)
    return MadeUp(transcript(), long=long, case=case)


@pytest.mark.parametrize(("kept_bytes", "found"), [(0, 0), (1.5, 0), (4, 1), (8, 1), (32, 1)])
def test_a_device_that_keeps_samples_of_four_bytes_or_more_fails(
    fails, transcript, kept_bytes, found
):
    memory = 5e7 + kept_bytes * RATE * AT_S
    assert len(fails(CHECK, runs(transcript, memory))) == found


@given(block=st.integers(0, 10**8), at_s=st.floats(0.0, REPEATS * END_S), seed=st.integers(0, 99))
def test_windows_that_fill_and_empty_and_one_block_of_the_allocator_are_no_growth(
    block, at_s, seed
):
    # Hypothesis draws no fixtures.
    from floatref_conformance.devices.streams.answers import Started
    from floatref_conformance.devices.streams.transcript import Transcript

    saw = RATE * 8 * np.mod(AT_S, 90.0) + np.random.default_rng(seed).uniform(0, 1e3, AT_S.size)
    memory = 5e7 + saw + np.where(at_s <= AT_S, block, 0)
    long = Transcript(Started(LATENCY, 0.0), memory_bytes=list(zip(AT_S, memory, strict=True)))
    long.given.extend(_points())
    case = StreamCase("long", Scenario(), repeats=REPEATS)
    (measured,) = CHECK.judge(MadeUp(long, long=long, case=case))
    assert measured.within("nominal")


def _points():
    from .conftest import steadily

    return steadily(length_m=100.0)


def test_growth_in_the_first_half_is_allowed(fails, transcript):
    memory = 5e7 + 32 * RATE * np.minimum(AT_S, REPEATS * END_S / 2)
    assert fails(CHECK, runs(transcript, memory)) == []


def test_a_window_longer_than_the_first_half_is_refused(transcript):
    long = replace(LATENCY, longest_s=REPEATS * END_S)
    with pytest.raises(DeviceError, match="longest_s"):
        CHECK.judge(runs(transcript, np.full(AT_S.size, 5e7), long))


def test_where_memory_is_not_known_the_check_says_so(transcript):
    case = StreamCase("long", Scenario(), repeats=REPEATS)
    with pytest.raises(DeviceSkipped, match="not known here"):
        CHECK.judge(MadeUp(transcript(), long=transcript(), case=case))
