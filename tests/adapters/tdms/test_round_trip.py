"""TDMS: what is written comes back on its own clock."""

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Channel, Recording, StampedClock, UniformClock
from floatref.architectures.plugins import plugins
from floatref_adapters.tdms.adapter import Tdms
from floatref_adapters.testing.reading import read_whole
from floatref_adapters.testing.tdms import write_tdms

samples = st.none() | st.floats(-1e6, 1e6)
names = st.sampled_from(["height", "vertical_specific_force", "distance"])
tracks = st.text("aß中 .'/#2", min_size=1, max_size=4)
rates = st.builds(Fraction, st.integers(1, 50_000), st.integers(1, 40))
read = partial(read_whole, Tdms())


@st.composite
def recordings(draw: st.DrawFn, values: st.SearchStrategy[float | None] = samples) -> Recording:
    """Draw channels of several clocks, uniform and stamped, some on one clock."""
    channels = []
    for track in draw(st.lists(tracks, unique=True, min_size=1, max_size=3)):
        count = draw(st.integers(1, 9))
        clock: UniformClock | StampedClock
        clock = UniformClock(draw(rates), draw(st.floats(-1e6, 1e6)))
        if draw(st.booleans()):
            steps = draw(st.lists(st.floats(1e-3, 10), min_size=count, max_size=count))
            clock = StampedClock.of(np.cumsum(steps))
        for name in draw(st.sets(names, min_size=1)):
            drawn = draw(st.lists(values, min_size=count, max_size=count))
            channels.append(Channel.of(name, np.array(drawn, float), clock, track))
    return Recording(tuple(channels))


def check_round_trip(recording: Recording, path: Path, within: Callable[[Channel], float]) -> None:
    """Assert that ``path`` holds ``recording``, each value ``within`` so much."""
    native, numbers = read(path)
    pairs = list(zip(native.streams, numbers, strict=True))
    found = {column.name: (s, column, n) for s, n in pairs for column in s.columns}
    assert sum(len(s.columns) for s in native.streams) == len(recording.channels)
    for channel in recording.channels:
        stream, column, (values, ticks) = found[str(channel.id)]
        assert column.unit == channel.unit
        np.testing.assert_allclose(
            values[column.name], channel.values, rtol=0, atol=within(channel)
        )
        if isinstance(channel.clock, StampedClock):
            assert stream.clock.rate is None
            np.testing.assert_array_equal(ticks, channel.clock.times_s)
        else:
            assert stream.clock.rate == channel.clock.rate
            assert float(stream.clock.first_tick * stream.clock.tick_s) == channel.clock.start_s


@settings(deadline=None, max_examples=40)
@given(recording=recordings())
def test_a_recording_comes_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory, recording: Recording
) -> None:
    path = tmp_path_factory.mktemp("tdms") / "run.dat"
    write_tdms(recording, path)
    assert Tdms().recognises(path)
    check_round_trip(recording, path, lambda _: 0.0)


@settings(deadline=None, max_examples=25)
@given(recording=recordings(st.floats(-1e6, 1e6)), quantum=st.sampled_from([1e-6, 0.01, 0.3]))
def test_integers_are_within_half_a_quantum(
    tmp_path_factory: pytest.TempPathFactory, recording: Recording, quantum: float
) -> None:
    path = tmp_path_factory.mktemp("tdms") / "run.tdms"
    write_tdms(recording, path, {"height": quantum})
    stored = {"height": quantum / 2 + 4 * np.spacing(1e6)}
    check_round_trip(recording, path, lambda channel: stored.get(channel.id.name, 0.0))


def test_missing_samples_are_not_written_as_integers(tmp_path: Path) -> None:
    channel = Channel.of("height", np.array([1.0, np.nan]), UniformClock.of(10.0))
    with pytest.raises(ValueError, match="missing samples cannot be stored in integers"):
        write_tdms(Recording((channel,)), tmp_path / "a.tdms", {"height": 0.001})


def test_floatref_finds_the_adapter_through_its_entry_point() -> None:
    assert plugins().adapters()["tdms"].summary == Tdms.summary
