"""Reading an MCAP file of a recording: samples go to disk block by block, and are mapped."""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from floatref import (
    Channel,
    InputError,
    Recording,
    StampedClock,
    UniformClock,
    open_bytes,
    setup_of,
)
from floatref_adapters.formats.mcap_log.mcap_writing import FORMAT, METADATA
from floatref_adapters.formats.mcap_log.topics import TIME_FIELD, Topic, topic_of
from floatref_adapters.shared.refusals import library, prefix_errors

HELD = 1 << 22
"""Bytes of a topic that are held in memory before they are written."""
DAMAGED = "copy the complete file again"

Floats = NDArray[np.float64]


def read_mcap(path: Path) -> Recording:
    """Return the recording in ``path``, which floatref has written.

    Raises InputError in one line naming the file where mcap is missing, for a file of another
    program, and for one that is truncated or damaged.
    """
    reader = library("mcap.reader", "reading MCAP")
    with prefix_errors(path), _explain(), open_bytes(path) as file:
        opened = reader.make_reader(file, validate_crcs=True)
        document = _document(opened)
        topics = [_parse(topic_of, entry) for entry in document["topics"]]
        with _Columns(topics) as columns:
            for _, channel, message in opened.iter_messages(log_time_order=False):
                columns.add(channel.topic, message.data)
            return _recording(document, topics, columns.finish())


@contextmanager
def _explain() -> Iterator[None]:
    """Turn what the library raises into an InputError of one line."""
    try:
        yield
    except InputError:
        raise
    except Exception as error:
        if isinstance(error, OSError) and error.filename is not None:
            raise InputError(f"{error.strerror or error}; make it readable") from error
        # Damaged files raise errors of the library, of its codecs and of struct.
        text = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"cannot be read ({text[:120]}); {DAMAGED}") from error


def _document(opened: Any) -> dict[str, Any]:
    """Return what the file says of its recording; InputError if it is of another program."""
    found = [record for record in opened.iter_metadata() if record.name == METADATA]
    if not found:
        raise InputError(
            "has no recording of floatref; convert its topics to CSV or MF4 with the program that "
            "wrote it, and read that"
        )
    stated = found[0].metadata.get("format", "missing")
    if stated != FORMAT:
        raise InputError(f"format is {stated[:40]}; this version reads {FORMAT}")
    document: dict[str, Any] = _parse(json.loads, found[0].metadata.get("recording", ""))
    for key in ("topics", "order", "device", "setup"):
        if not isinstance(document.get(key), list | dict):
            raise InputError(f"metadata without {key}; {DAMAGED}")
    return document


def _parse(parse: Callable[[Any], Any], value: Any) -> Any:
    try:
        return parse(value)
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise InputError(f"metadata cannot be used ({error!r}); {DAMAGED}") from error


class _Columns:
    """The messages of every topic, on disk in a temporary file for each of their fields.

    A context that closes the files; arrays that are mapped from them outlive it.
    """

    def __init__(self, topics: Sequence[Topic]) -> None:
        self._topics = {topic.name: topic for topic in topics}
        self._held = {topic.name: bytearray() for topic in topics}
        self._files: dict[tuple[str, str], BinaryIO] = {
            (topic.name, field): TemporaryFile()  # noqa: SIM115  # Closed by the context.
            for topic in topics
            for field in topic.columns
        }

    def __enter__(self) -> "_Columns":
        """Return the columns themselves."""
        return self

    def __exit__(self, *raised: object) -> None:
        """Close all files."""
        for file in self._files.values():
            file.close()

    def add(self, topic: str, data: bytes) -> None:
        """Add a message; those of topics that are not the recording's are passed over."""
        held = self._held.get(topic)
        if held is None:
            return
        if len(data) != self._topics[topic].dtype.itemsize:
            raise InputError(f"topic {topic}: a message of {len(data)} bytes; {DAMAGED}")
        held += data
        if len(held) > HELD:
            self._flush(topic)

    def finish(self) -> dict[tuple[str, str], Floats]:
        """Return the values of every field, mapped from disk, by topic and field."""
        for topic in self._topics:
            self._flush(topic)
        return {key: self._map(key, file) for key, file in self._files.items()}

    def _map(self, key: tuple[str, str], file: BinaryIO) -> Floats:
        count = self._topics[key[0]].count
        if file.tell() != 8 * count or count == 0:
            found = file.tell() // 8
            raise InputError(f"topic {key[0]}: {found} of {count} messages; {DAMAGED}")
        file.flush()
        values: Floats = np.memmap(file, dtype="<f8", mode="r", shape=(count,))
        return values

    def _flush(self, topic: str) -> None:
        messages = np.frombuffer(bytes(self._held[topic]), self._topics[topic].dtype)
        expected = self._topics[topic].empty(1)
        for field in self._topics[topic].columns:
            if (messages[f"tag {field}"] != expected[f"tag {field}"]).any():
                raise InputError(f"topic {topic}: fields in another order; {DAMAGED}")
            self._append(topic, field, np.ascontiguousarray(messages[field]).tobytes())
        self._held[topic].clear()

    def _append(self, topic: str, field: str, content: bytes) -> None:
        try:
            self._files[topic, field].write(content)
        except OSError as error:
            reason = error.strerror or error
            raise InputError(f"temporary file: {reason}; set TMPDIR to a disk with room") from error


def _recording(
    document: Mapping[str, Any], topics: Sequence[Topic], columns: Mapping[tuple[str, str], Floats]
) -> Recording:
    found: dict[str, Channel] = {}
    for topic in topics:
        clock: UniformClock | StampedClock
        if topic.rate is None:
            clock = StampedClock(columns[topic.name, TIME_FIELD])
        else:
            clock = UniformClock(topic.rate, topic.start_s)
        for name, field, unit in zip(topic.names, topic.fields, topic.units, strict=True):
            track, _, quantity = name.rpartition(".")
            values = columns[topic.name, field]
            found[name] = Channel.of(quantity, values, clock, track or None, unit)
    missing = [name for name in document["order"] if name not in found]
    if missing:
        raise InputError(f"metadata without channel {missing[0]}; {DAMAGED}")
    device = document["device"]
    return Recording(
        tuple(found[name] for name in document["order"]),
        _parse(setup_of, document["setup"]),
        str(device.get("vendor", "")),
        str(device.get("model", "")),
    )
