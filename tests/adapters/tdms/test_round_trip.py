"""TDMS: what is written comes back on its own clock."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Channel, Recording, UniformClock
from floatref.engine.plugins import plugins
from floatref_adapters.tdms.adapter import Tdms
from floatref_adapters.testing.tdms import write_tdms

Make = Callable[..., st.SearchStrategy[Recording]]
Check = Callable[..., None]
tracks = st.text("aß中 .'/#2", min_size=1, max_size=4)


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(data=st.data())
def test_a_recording_comes_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    recordings: Make,
    check_round_trip: Check,
) -> None:
    recording = data.draw(recordings(tracks))
    path = tmp_path_factory.mktemp("tdms") / "run.dat"
    write_tdms(recording, path)
    assert Tdms().recognises(path)
    check_round_trip(Tdms(), recording, path, lambda _: 0.0)


@settings(deadline=None, max_examples=25)
@given(data=st.data(), quantum=st.sampled_from([1e-6, 0.01, 0.3]))
def test_integers_are_within_half_a_quantum(
    tmp_path_factory: pytest.TempPathFactory,
    data: st.DataObject,
    quantum: float,
    recordings: Make,
    check_round_trip: Check,
) -> None:
    recording = data.draw(recordings(tracks, st.floats(-1e6, 1e6)))
    path = tmp_path_factory.mktemp("tdms") / "run.tdms"
    write_tdms(recording, path, {"height": quantum})
    stored = {"height": quantum / 2 + 4 * np.spacing(1e6)}
    check_round_trip(Tdms(), recording, path, lambda channel: stored.get(channel.id.name, 0.0))


def test_missing_samples_are_not_written_as_integers(tmp_path: Path) -> None:
    channel = Channel.of("height", np.array([1.0, np.nan]), UniformClock.of(10.0))
    with pytest.raises(ValueError, match="missing samples cannot be stored in integers"):
        write_tdms(Recording((channel,)), tmp_path / "a.tdms", {"height": 0.001})


def test_floatref_finds_the_adapter_through_its_entry_point() -> None:
    assert plugins().adapters()["tdms"].summary == Tdms.summary
