"""A recording written in any format comes back: its samples, and when they were taken."""

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref import Channel, InputError, NativeFile, Recording, StampedClock, UniformClock
from floatref.engine.plugins import plugins
from floatref_adapters.formats.arrow.adapter import ArrowIpc, Parquet
from floatref_adapters.formats.csv_table.adapter import CsvTable
from floatref_adapters.formats.hdf5.adapter import Hdf5
from floatref_adapters.formats.hdf5.dataset_rows import native_file
from floatref_adapters.formats.mdf4.adapter import Mdf4
from floatref_adapters.formats.tdms.adapter import Tdms
from floatref_adapters.testing import WRITERS
from floatref_adapters.testing.csv_table import write_csv


class Hdf5Here(Hdf5):
    """The adapter without its process apart, which starts too slowly for many examples."""

    def streams(self, source: Path, options: Mapping[str, str]) -> NativeFile:
        return native_file(source, options)


READERS = {
    ".parquet": Parquet(),
    ".arrow": ArrowIpc(),
    ".h5": Hdf5Here(),
    ".mf4": Mdf4(),
    ".tdms": Tdms(),
}
DESCRIBED = (".parquet", ".arrow", ".h5")
"""Formats that hold who made the device."""
LETTERS = {".mf4": "aß中 .#2", ".tdms": "aß中 .'/#2"}
"""Of names of wheel paths, where a format holds more than all of them do."""
NAMES = ("height", "distance", "vertical_specific_force", "gnss_height", "pitch_rate")
samples = st.floats(-1e9, 1e9) | st.just(np.nan) | st.floats(-1e-9, 1e-9)

rates = st.sampled_from([Fraction(16000), Fraction(3240), Fraction(48000, 7), Fraction(20)])
starts = st.sampled_from([0.0, 0.1, -3.7, 12.345678901234567, 1e5])
few = settings(deadline=None, max_examples=40)


@st.composite
def clocks(draw: st.DrawFn, count: int) -> UniformClock | StampedClock:
    """Draw a clock of ``count`` samples."""
    if draw(st.booleans()):
        return UniformClock(draw(rates), draw(starts))
    steps = draw(st.lists(st.integers(1, 10**6), min_size=count, max_size=count))
    return StampedClock.of(draw(starts) + np.cumsum(steps) / 1e6)


@st.composite
def recordings(
    draw: st.DrawFn, suffix: str = ".csv", samples: st.SearchStrategy[float] = samples
) -> Recording:
    """Draw channels on up to three clocks and of several lengths, with names of the format."""
    letters = LETTERS.get(suffix, "abXY09_- .äß[")
    tracks = st.none() | st.text(letters, min_size=1, max_size=4).filter(lambda t: t == t.strip())
    ids = draw(
        st.lists(st.tuples(st.sampled_from(NAMES), tracks), min_size=1, max_size=5, unique=True)
    )
    shared = [
        (n, draw(clocks(n))) for n in draw(st.lists(st.integers(2, 9), min_size=1, max_size=3))
    ]
    channels = []
    for name, track in ids:
        count, clock = draw(st.sampled_from(shared))
        values = draw(st.lists(samples, min_size=count, max_size=count))
        channels.append(Channel.of(name, values, clock, track))
    return Recording(tuple(channels), vendor="Maker", model="Mk 2")


def found(native: NativeFile) -> dict[str, tuple[np.ndarray, np.ndarray, str]]:
    """Return samples, times in s and unit of every column."""
    columns = {}
    for stream in native.streams:
        pieces = list(stream.read([c.name for c in stream.columns]))
        clock = stream.clock
        start = clock.first_tick * clock.tick_s
        for column in stream.columns:
            values = np.concatenate([piece.values[column.name] for piece in pieces])
            assert values.size == stream.count
            if clock.rate is not None:
                times = UniformClock(clock.rate, float(start)).times(values.size)
            else:
                ticks = np.concatenate([piece.ticks for piece in pieces])
                tick_s = clock.tick_s
                times = ticks.astype(np.float64) * tick_s.numerator / tick_s.denominator
            columns[column.name] = (values, times, column.unit)
    return columns


def written(
    folder: Path, suffix: str, recording: Recording, quanta: Mapping[str, float] | None = None
) -> NativeFile:
    path = folder / f"run{suffix}"
    WRITERS[suffix](recording, path, quanta)
    reader = READERS.get(suffix, CsvTable())
    assert reader.recognises(path)
    return reader.streams(path, {})


@pytest.mark.slow
@few
@pytest.mark.parametrize("suffix", READERS)
@given(data=st.data())
def test_samples_and_times_come_back_exactly(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, data: st.DataObject
) -> None:
    recording = data.draw(recordings(suffix))
    native = written(tmp_path_factory.mktemp("run"), suffix, recording)
    named = ("Maker", "Mk 2") if suffix in DESCRIBED else ("", "")
    assert (native.vendor, native.model, native.warnings) == (*named, ())
    columns = found(native)
    assert set(columns) == {str(channel.id) for channel in recording.channels}
    for channel in recording.channels:
        values, times, unit = columns[str(channel.id)]
        np.testing.assert_array_equal(values, channel.values)
        np.testing.assert_array_equal(times, channel.times_s)
        assert unit == channel.unit


@pytest.mark.slow
@few
@pytest.mark.parametrize("suffix", [*READERS, ".csv"])
@given(data=st.data(), quantum=st.sampled_from([1e-3, 0.25, 2.0**-12, 10.0]))
def test_samples_come_back_within_half_their_quantum(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, data: st.DataObject, quantum: float
) -> None:
    # TDMS has no mark of missing samples among integers.
    held = st.floats(-1e9, 1e9) if suffix == ".tdms" else samples
    recording = data.draw(recordings(suffix, held))
    quanta = {str(recording.channels[0].id): quantum}
    columns = found(written(tmp_path_factory.mktemp("run"), suffix, recording, quanta))
    channel = recording.channels[0]
    values = columns[str(channel.id)][0]
    if suffix == ".csv":
        values, expected = values[~np.isnan(values)], channel.values[~np.isnan(channel.values)]
    else:
        expected = channel.values
    room = quantum / 2 + 4 * np.spacing(np.nanmax(np.abs(expected), initial=0.0))
    np.testing.assert_array_equal(np.isnan(values), np.isnan(expected))
    there = ~np.isnan(expected)
    assert (np.abs(values - expected)[there] <= room).all()


@pytest.mark.slow
@few
@given(recording=recordings())
def test_a_table_has_every_sample_at_its_time(
    tmp_path_factory: pytest.TempPathFactory, recording: Recording
) -> None:
    native = written(tmp_path_factory.mktemp("run"), ".csv", recording)
    columns = found(native)
    for channel in recording.channels:
        values, times, _ = columns[str(channel.id)]
        there, here = ~np.isnan(values), ~np.isnan(channel.values)
        np.testing.assert_array_equal(values[there], channel.values[here])
        # Nine decimals, and a float64 of a time near 1e5 s.
        np.testing.assert_allclose(times[there], channel.times_s[here], rtol=0, atol=5.2e-10)
    every = np.concatenate([np.round(c.times_s, 9) for c in recording.channels])
    assert native.streams[0].count <= np.unique(every).size + 1


@pytest.mark.slow
def test_times_of_a_rate_with_finite_decimals_are_exact(tmp_path: Path) -> None:
    clock = UniformClock(Fraction(16000), 0.5)
    channel = Channel.of("height", np.arange(100_000.0), clock)
    (stream,) = written(tmp_path, ".csv", Recording((channel,))).streams
    assert stream.clock.tick_s == Fraction(1, 10**7)
    ticks = np.concatenate([rows.ticks for rows in stream.read([])])
    np.testing.assert_array_equal(ticks, 5_000_000 + 625 * np.arange(100_000))


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [*READERS, ".csv"])
def test_a_long_channel_comes_in_pieces_of_bounded_size(tmp_path: Path, suffix: str) -> None:
    rng = np.random.default_rng(3)
    values = rng.normal(size=300_000)
    clock = UniformClock.of(16000.0)
    short = Channel.of("distance", np.arange(70_000.0), clock)
    recording = Recording((Channel.of("height", values, clock, "left"), short))
    native = written(tmp_path, suffix, recording)
    if suffix == ".h5":
        native = Hdf5().streams(tmp_path / "run.h5", {})
    for stream in native.streams:
        for column in stream.columns:
            pieces = [rows.values[column.name] for rows in stream.read([column.name])]
            assert max(piece.nbytes for piece in pieces) <= 1 << 22
            whole = np.concatenate(pieces)
            if column.name == "left.height":
                np.testing.assert_array_equal(whole, values)
            else:
                np.testing.assert_array_equal(whole[:70_000], np.arange(70_000.0))
                assert np.isnan(whole[70_000:]).all()


@pytest.mark.parametrize("suffix", list(WRITERS))
def test_what_cannot_be_written_leaves_the_file_as_it_was(tmp_path: Path, suffix: str) -> None:
    channel = Channel.of("height", np.arange(3.0), UniformClock.of(10.0))
    path = tmp_path / f"run{suffix}"
    path.write_text("mine")
    for quanta in ({"heigth": 0.1}, {"height": -1.0}, {"height": float("nan")}):
        with pytest.raises(InputError, match="quantum of heig"):
            WRITERS[suffix](Recording((channel,)), path, quanta)
    assert path.read_text() == "mine"
    with pytest.raises(InputError, match="cannot be written"):
        WRITERS[suffix](Recording((channel,)), tmp_path / "none" / "run", None)
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


def test_samples_within_a_nanosecond_are_no_rows_of_a_table(tmp_path: Path) -> None:
    channel = Channel.of("height", np.arange(3.0), StampedClock.of([0.0, 1.0, 1.0 + 1e-10]))
    with pytest.raises(InputError, match="channel height: samples closer than"):
        write_csv(Recording((channel,)), tmp_path / "run.csv")


def test_a_name_that_a_format_has_not_is_refused(tmp_path: Path) -> None:
    for track, suffix in (("a/b", ".h5"), ("a\nb", ".csv")):
        channel = Channel.of("height", np.arange(3.0), UniformClock.of(10.0), track)
        with pytest.raises(InputError, match="no such name; rename the wheel path"):
            WRITERS[suffix](Recording((channel,)), tmp_path / f"run{suffix}", None)
    assert not list(tmp_path.iterdir())


def test_missing_samples_are_not_written_as_integers_of_tdms(tmp_path: Path) -> None:
    channel = Channel.of("height", np.array([1.0, np.nan]), UniformClock.of(10.0))
    with pytest.raises(ValueError, match="missing samples cannot be stored in integers"):
        WRITERS[".tdms"](Recording((channel,)), tmp_path / "a.tdms", {"height": 0.001})


@pytest.mark.parametrize("adapter", [*READERS.values(), CsvTable()], ids=lambda a: a.name)
def test_floatref_finds_the_adapter_through_its_entry_point(adapter: Parquet) -> None:
    assert plugins().adapters()[adapter.name].summary == adapter.summary
