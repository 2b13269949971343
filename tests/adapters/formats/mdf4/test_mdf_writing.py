"""MDF 4 that is written: asammdf, and our adapter through a drafted map, give the samples back."""

import numpy as np
import pytest
from asammdf import MDF
from hypothesis import given, settings
from tests.adapters.drawn_recordings import recordings

from floatref import Channel, Recording, StampedClock, UniformClock, read_native
from floatref.engine.recordings.readers import native_of, reader_of
from floatref.mapping.draft.drafting import draft_map
from floatref_adapters.formats.mdf4 import mdf_writing
from floatref_adapters.formats.mdf4.mdf_writing import Mf4Recording


def run(rate=16000.0, start_s=2.5):
    """Return a recording of two clocks with a drop-out."""
    noise = np.random.default_rng(3).normal(size=(3, 3000))
    noise[0, 100:200] = np.nan
    fast, slow = UniformClock.of(rate, start_s), StampedClock.of(2.5 + np.arange(5) * 0.03)
    return Recording(
        (
            Channel.of("height", noise[0], fast, "left"),
            Channel.of("vertical_specific_force", noise[1], fast, "left"),
            Channel.of("distance", np.arange(3000) * 0.001, fast),
            Channel.of("gnss_height", [1.0, 2.0, np.nan, 4.0, 5.0], slow),
        )
    )


def mapped(path):
    """Return the recording in ``path`` through a drafted map."""
    reader = reader_of(path, None)
    with native_of(reader, path, {}) as native:
        chart = path.with_suffix(".toml")
        chart.write_text(draft_map(native, path, reader.name), encoding="utf-8")
    return read_native(path, chart).recording


@pytest.mark.parametrize("divided", [False, True])
@pytest.mark.parametrize("rate", [16000.0, 1000.0 / 3.0, 44.1])
def test_a_drafted_map_reads_the_same_samples_and_clocks(tmp_path, monkeypatch, rate, divided):
    if divided:
        monkeypatch.setattr(mdf_writing, "LARGEST", 1)
    recording = run(rate)
    Mf4Recording().write(recording, tmp_path / "run.mf4")
    found = mapped(tmp_path / "run.mf4")
    assert {c.id for c in found.channels} == {c.id for c in recording.channels}
    for channel in recording.channels:
        back = found.channel(*channel.id)
        uniform = isinstance(channel.clock, UniformClock)
        # A map leaves out the missing ones of samples that have times of their own.
        there = slice(None) if uniform else ~np.isnan(channel.values)
        np.testing.assert_array_equal(back.values, channel.values[there])
        np.testing.assert_allclose(back.times_s, channel.times_s[there], rtol=0, atol=1e-12)
        assert not uniform or back.clock.rate == channel.clock.rate


@settings(max_examples=20)
@given(recording=recordings())
def test_what_is_written_is_read_again_by_asammdf(tmp_path_factory, recording):
    path = tmp_path_factory.getbasetemp() / "law.mf4"
    Mf4Recording().write(recording, path)
    with MDF(path) as mdf:
        for channel in recording.channels:
            signal = mdf.get(str(channel.id))
            np.testing.assert_array_equal(signal.samples, channel.values)
            far = np.abs(channel.times_s).max()
            np.testing.assert_allclose(signal.timestamps, channel.times_s, rtol=0, atol=1e-15 * far)


def test_asammdf_shows_names_units_and_times(tmp_path):
    recording = run()
    Mf4Recording().write(recording, tmp_path / "run.mf4")
    with MDF(tmp_path / "run.mf4") as mdf:
        for channel in recording.channels:
            signal = mdf.get(str(channel.id))
            assert signal.unit == ("" if channel.unit == "1" else channel.unit)
            np.testing.assert_array_equal(signal.samples, channel.values)
            np.testing.assert_allclose(signal.timestamps, channel.times_s, rtol=0, atol=1e-12)


def test_a_name_of_another_suffix_is_kept(tmp_path):
    Mf4Recording().write(run(), tmp_path / "run.bin")
    assert [path.name for path in tmp_path.iterdir()] == ["run.bin"]
