"""Recordings of any clocks, and whether a file of a format holds them."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st

from floatref import Channel, Recording, StampedClock, UniformClock
from floatref_adapters.testing.whole_reading import read_whole

SAMPLES = st.none() | st.floats(-1e6, 1e6)
NAMES = st.sampled_from(["height", "vertical_specific_force", "distance"])
RATES = st.builds(Fraction, st.integers(1, 50_000), st.integers(1, 40))


@st.composite
def drawn(
    draw: st.DrawFn,
    tracks: st.SearchStrategy[str],
    samples: st.SearchStrategy[float | None] = SAMPLES,
) -> Recording:
    channels = []
    for track in draw(st.lists(tracks, unique=True, min_size=1, max_size=3)):
        count = draw(st.integers(1, 9))
        clock: UniformClock | StampedClock
        clock = UniformClock(draw(RATES), draw(st.floats(-1e6, 1e6)))
        if draw(st.booleans()):
            steps = draw(st.lists(st.floats(1e-3, 10), min_size=count, max_size=count))
            clock = StampedClock.of(np.cumsum(steps))
        for name in draw(st.sets(NAMES, min_size=1)):
            values = draw(st.lists(samples, min_size=count, max_size=count))
            channels.append(Channel.of(name, np.array(values, float), clock, track))
    return Recording(tuple(channels))


@pytest.fixture(scope="session")
def recordings() -> Callable[..., st.SearchStrategy[Recording]]:
    """Draw channels of several clocks, uniform and stamped, some on one clock, for some tracks."""
    return drawn


@pytest.fixture(scope="session")
def check_round_trip() -> Callable[..., None]:
    """Assert that a file, read by an adapter, holds a recording, each value within so much."""

    def check(
        adapter: Any, recording: Recording, path: Path, within: Callable[[Channel], float]
    ) -> None:
        native, numbers = read_whole(adapter, path)
        pairs = list(zip(native.streams, numbers, strict=True))
        found = {column.name: (s, column, n) for s, n in pairs for column in s.columns}
        assert sum(len(s.columns) for s in native.streams) == len(recording.channels)
        for channel in recording.channels:
            stream, column, (values, ticks) = found[str(channel.id)]
            assert column.unit == channel.unit
            assert stream.count == channel.values.size
            np.testing.assert_allclose(
                values[column.name], channel.values, rtol=0, atol=within(channel)
            )
            if isinstance(channel.clock, StampedClock):
                assert stream.clock.rate is None
                np.testing.assert_array_equal(ticks, channel.clock.times_s)
            else:
                assert stream.clock.rate == channel.clock.rate
                first = stream.clock.first_tick * stream.clock.tick_s
                assert float(first) == channel.clock.start_s

    return check
