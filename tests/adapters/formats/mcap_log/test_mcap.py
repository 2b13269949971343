"""MCAP of recordings: the same samples come back, others see values and times."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from mcap.reader import make_reader
from mcap.writer import Writer
from mcap_protobuf.decoder import DecoderFactory
from tests.adapters.drawn_recordings import NAMES, recordings

from floatref import (
    AxleSetup,
    Channel,
    InputError,
    Recording,
    Setup,
    StampedClock,
    UniformClock,
    read_recording,
    write_recording,
)
from floatref_adapters.formats.mcap_log.adapter import Mcap


def assert_same(found, expected):
    """Compare every bit of samples and times, and all that a recording states."""
    assert [c.id for c in found.channels] == [c.id for c in expected.channels]
    for one, other in zip(found.channels, expected.channels, strict=True):
        assert np.asarray(one.values).tobytes() == np.asarray(other.values).tobytes()
        assert type(one.clock) is type(other.clock)
        if isinstance(other.clock, UniformClock):
            assert one.clock == other.clock
        assert one.times_s.tobytes() == other.times_s.tobytes()
    assert (found.setup, found.vendor, found.model) == (
        expected.setup,
        expected.vendor,
        expected.model,
    )


@pytest.mark.slow
@settings(max_examples=40)
@given(recording=recordings())
def test_what_is_written_is_read_again_bit_by_bit(tmp_path_factory, recording):
    path = tmp_path_factory.getbasetemp() / "law.mcap"
    Mcap().write(recording, path)
    assert Mcap().recognises(path)
    assert_same(Mcap().read(path), recording)


def run(count=5000):
    """Return a recording of two clocks, with a drop-out and axles."""
    noise = np.random.default_rng(3).normal(size=(3, count))
    noise[0, 100:200] = np.nan
    fast, slow = UniformClock.of(1000.0, 10.0), StampedClock.of(10.0 + np.arange(50) * 0.1)
    channels = (
        Channel.of("height", noise[0], fast, "left"),
        Channel.of("gnss_height", np.arange(50.0), slow),
        Channel.of("vertical_specific_force", noise[1], fast, "left"),
    )
    return Recording(channels, Setup(axles=AxleSetup(2.7, 1.1)))


def test_a_decoder_of_protobuf_sees_values_units_and_times_in_order(tmp_path):
    recording = run()
    Mcap().write(recording, tmp_path / "run.mcap")
    heights, heard, last_ns = [], [], {}
    with (tmp_path / "run.mcap").open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        channels = reader.get_summary().channels.values()
        units = {topic.topic: dict(topic.metadata) for topic in channels}
        for _, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
            assert message.log_time >= last_ns.get(channel.topic, 0)
            last_ns[channel.topic] = message.log_time
            heard.append(message.log_time)
            if channel.topic == "/clock_0":
                heights.append((message.log_time, decoded.left_height))
    assert units["/clock_0"] == {
        "unit of left_height": "m",
        "unit of left_vertical_specific_force": "m/s^2",
    }
    assert units["/clock_1"] == {"unit of gnss_height": "m"}
    times, values = zip(*heights, strict=True)
    np.testing.assert_array_equal(values, recording.channels[0].values)
    assert list(times) == [10_000_000_000 + 1_000_000 * k for k in range(5000)]
    # A player that reads as the file goes is never more than a block of a second behind.
    assert (np.maximum.accumulate(heard) - heard).max() <= 1_000_000_000


def memory(count, folder):
    """Return the most memory in bytes that writing ``count`` samples of six channels takes."""
    clock, values = UniformClock.of(16000.0), np.random.default_rng(1).normal(size=count)
    channels = tuple(Channel.of(name, values, clock) for name in NAMES)
    write_recording(Recording(channels), folder / f"run-{count}")
    recording = read_recording(folder / f"run-{count}")
    tracemalloc.start()
    Mcap().write(recording, folder / f"run-{count}.mcap")
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


@pytest.mark.slow
def test_memory_does_not_grow_with_the_recording(tmp_path):
    short, long = memory(50_000, tmp_path), memory(150_000, tmp_path)
    # Its index is 8 bytes for every chunk of a megabyte; the samples would be 4.8 MB more.
    assert long < short + 0.5e6


def damaged(path, change):
    Mcap().write(run(), path)
    path.write_bytes(change(path.read_bytes()))
    return path


def flip(raw):
    middle = len(raw) // 2
    return raw[:middle] + bytes([raw[middle] ^ 0xFF]) + raw[middle + 1 :]


@pytest.mark.parametrize("change", [lambda raw: raw[:3000], lambda raw: raw[:-40], flip])
def test_a_damaged_file_is_one_line(tmp_path, change):
    path = damaged(tmp_path / "run.mcap", change)
    with pytest.raises(InputError, match="copy the complete file again") as caught:
        Mcap().read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def test_a_file_of_another_program_is_refused(tmp_path):
    path = tmp_path / "other.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        writer.finish()
    with pytest.raises(InputError, match=r"other.mcap: has no recording of floatref; convert"):
        Mcap().read(path)


def test_a_file_without_messages_of_a_topic_is_refused(tmp_path):
    Mcap().write(run(), tmp_path / "run.mcap")
    with (tmp_path / "run.mcap").open("rb") as stream:
        (metadata,) = make_reader(stream).iter_metadata()
    with (tmp_path / "cut.mcap").open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        writer.add_metadata(metadata.name, metadata.metadata)
        writer.finish()
    with pytest.raises(InputError, match="topic /clock_0: 0 of 5000 messages"):
        Mcap().read(tmp_path / "cut.mcap")
