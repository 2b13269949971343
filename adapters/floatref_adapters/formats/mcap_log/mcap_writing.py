"""Writing a recording as MCAP: messages in the order of time, a block of each clock at once."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, InputError, Recording, UniformClock, describe_installation
from floatref_adapters.formats.mcap_log.topics import TIME_FIELD, Topic
from floatref_adapters.shared.clock_groups import group_by_clock
from floatref_adapters.shared.refusals import library

FORMAT = "floatref-mcap/1"
METADATA = "floatref"
"""Name of the record of metadata that describes the recording."""
BLOCK_S = 1.0
"""Time in s that is written of one clock before the next one: players need no more order."""
ROWS = 1 << 14
"""Most samples of a clock that are in memory."""
CHUNK = 1 << 20
NS = 1e9
LATEST_NS = 2**64 - 1
"""Times of MCAP are whole nanoseconds from 0 to here."""


class Stream(NamedTuple):
    """A topic, its channels, and the identity of its channel in the file."""

    topic: Topic
    channels: Sequence[Channel]
    identity: int


def write_mcap(recording: Recording, path: Path) -> None:
    """Write ``recording`` to ``path`` in bounded memory.

    Raises InputError where mcap or protobuf is missing, and for times that MCAP cannot hold.
    """
    groups = group_by_clock(recording)
    origin_s = _origin(groups)
    mcap = library("mcap.writer", "writing MCAP")
    with path.open("wb") as file:
        writer = mcap.Writer(file, chunk_size=CHUNK)
        writer.start(profile="", library="floatref")
        topics = [Topic.of(number, channels) for number, channels in enumerate(groups)]
        document = {
            "origin_s": origin_s,
            **describe_installation(recording),
            "order": [str(channel.id) for channel in recording.channels],
            "topics": [topic.describe() for topic in topics],
        }
        text = json.dumps(document, allow_nan=False)
        writer.add_metadata(METADATA, {"format": FORMAT, "recording": text})
        streams = [_register(writer, *pair) for pair in zip(topics, groups, strict=True)]
        for stream, first, count in _blocks(streams):
            _write_block(writer, stream, first, count, origin_s)
        writer.finish()


def _origin(groups: Sequence[Sequence[Channel]]) -> float:
    """Return the time in s that is 0 in the file: 0 itself, unless times are before it."""
    spans = [channels[0].span_s for channels in groups]
    first, last = min(begin for begin, _ in spans), max(end for _, end in spans)
    origin = 0.0 if first >= 0.0 and last * NS <= LATEST_NS else float(np.floor(first))
    if (last - origin) * NS > LATEST_NS:
        raise InputError(f"the recording lasts {last - first:g} s; MCAP holds 584 years")
    return origin


def _register(writer: Any, topic: Topic, channels: Sequence[Channel]) -> Stream:
    name, schema = topic.schema()
    units = dict(zip((f"unit of {field}" for field in topic.fields), topic.units, strict=True))
    kind = writer.register_schema(name, "protobuf", schema)
    return Stream(topic, channels, writer.register_channel(topic.name, "protobuf", kind, units))


def _blocks(streams: Sequence[Stream]) -> Iterator[tuple[Stream, int, int]]:
    """Yield stretches of samples, first and count, whose first samples are in order of time."""
    done = [0] * len(streams)
    while True:
        waiting = [k for k, stream in enumerate(streams) if done[k] < stream.topic.count]
        if not waiting:
            return
        begins = {k: float(_times(streams[k], done[k], 1)[0]) for k in waiting}
        k = min(waiting, key=begins.__getitem__)
        rows = min(ROWS, streams[k].topic.count - done[k])
        times = _times(streams[k], done[k], rows)
        count = max(int(np.searchsorted(times, begins[k] + BLOCK_S)), 1)
        yield streams[k], done[k], count
        done[k] += count


def _times(stream: Stream, first: int, count: int) -> NDArray[np.float64]:
    return stream.channels[0].clock.times(count, first)


def _write_block(writer: Any, stream: Stream, first: int, count: int, origin_s: float) -> None:
    topic, times = stream.topic, _times(stream, first, count)
    messages = topic.empty(count)
    if not isinstance(stream.channels[0].clock, UniformClock):
        messages[TIME_FIELD] = times
    for field, channel in zip(topic.fields, stream.channels, strict=True):
        messages[field] = channel.values[first : first + count]
    content, size = messages.tobytes(), topic.dtype.itemsize
    # Whole seconds apart from the rest: a float64 of nanoseconds since 1970 is 256 ns off.
    whole = np.floor(times - origin_s)
    rest = np.rint((times - origin_s - whole) * NS)
    stamps = (whole.astype(np.uint64) * np.uint64(1_000_000_000) + rest.astype(np.uint64)).tolist()
    for k, stamp in enumerate(stamps):
        data = content[k * size : (k + 1) * size]
        writer.add_message(stream.identity, stamp, data, stamp, (first + k) % 2**32)
