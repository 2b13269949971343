"""A topic for every clock of a recording: its messages, as protobuf has them, all of one size.

A message is one sample of every channel of that clock, a field of type double each. Fields are
written whether they are zero or not, so that a block of messages is one structured array.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floatref import Channel, InputError, UniformClock
from floatref_adapters.shared.numbered_names import number_repeats
from floatref_adapters.shared.refusals import library

PACKAGE = "floatref"
TIME_FIELD = "time_s"
"""Field with the exact time of a sample whose clock is not uniform, in s."""
DOUBLE = 1
"""Wire type of protobuf of a field of eight bytes."""
ONE_BYTE = 16
"""Number of the first field whose tag needs two bytes."""
MOST_FIELDS = 2047
"""Number of the last field whose tag needs no more."""

Messages = NDArray[np.void]


@dataclass(frozen=True)
class Topic:
    """The channels of one clock: ``fields`` are their names in the messages.

    ``names`` are the channels as ``left.height``; ``rate`` in Hz as a fraction and ``start_s`` are
    of a uniform clock, None and 0 of another.
    """

    name: str
    names: tuple[str, ...]
    fields: tuple[str, ...]
    units: tuple[str, ...]
    count: int
    rate: Fraction | None
    start_s: float

    @classmethod
    def of(cls, number: int, channels: Sequence[Channel]) -> "Topic":
        """Return the topic of ``channels``, which share the clock with ``number`` in the file."""
        clock = channels[0].clock
        names = [str(channel.id) for channel in channels]
        if len(names) >= MOST_FIELDS:
            raise InputError(f"{len(names)} channels on one clock; MCAP holds {MOST_FIELDS - 1}")
        numbered = number_repeats(list(map(_field, names)))
        uniform = clock if isinstance(clock, UniformClock) else None
        return cls(
            f"/clock_{number}",
            tuple(names),
            tuple(name.replace(" #", "_no_") for name in numbered),
            tuple(channel.unit for channel in channels),
            int(channels[0].values.size),
            None if uniform is None else uniform.rate,
            0.0 if uniform is None else uniform.start_s,
        )

    @property
    def columns(self) -> tuple[str, ...]:
        """All fields of a message, in the order of their numbers."""
        return self.fields if self.rate is not None else (TIME_FIELD, *self.fields)

    @property
    def dtype(self) -> np.dtype[np.void]:
        """A message as bytes: for each field its tag, then the value."""
        parts: list[tuple[str, Any]] = []
        for number, name in enumerate(self.columns, 1):
            parts += [(f"tag {name}", "u1" if number < ONE_BYTE else "<u2"), (name, "<f8")]
        return np.dtype(parts)

    def empty(self, count: int) -> Messages:
        """Return ``count`` messages with all tags and no values."""
        messages = np.zeros(count, self.dtype)
        for number, name in enumerate(self.columns, 1):
            messages[f"tag {name}"] = _tag(number)
        return messages

    def schema(self) -> tuple[str, bytes]:
        """Return the name of the message's type, and its description as a FileDescriptorSet."""
        descriptor = library("google.protobuf.descriptor_pb2", "writing MCAP")
        kind = self.name.strip("/").title().replace("_", "")
        described = descriptor.FileDescriptorSet()
        file = described.file.add(name=f"{PACKAGE}/{kind}.proto", package=PACKAGE, syntax="proto3")
        message = file.message_type.add(name=kind)
        for number, name in enumerate(self.columns, 1):
            field = descriptor.FieldDescriptorProto
            message.field.add(
                name=name, number=number, type=field.TYPE_DOUBLE, label=field.LABEL_OPTIONAL
            )
        return f"{PACKAGE}.{kind}", described.SerializeToString()

    def describe(self) -> dict[str, Any]:
        """Return the topic in plain JSON values; `topic_of` makes it again."""
        return {
            "topic": self.name,
            "channels": list(self.names),
            "fields": list(self.fields),
            "units": list(self.units),
            "count": self.count,
            "rate_hz": None if self.rate is None else str(self.rate),
            "start_s": self.start_s,
        }


def topic_of(entry: Mapping[str, Any]) -> Topic:
    """Return the topic of ``entry``; KeyError, TypeError or ValueError for anything else."""
    rate = entry["rate_hz"]
    return Topic(
        str(entry["topic"]),
        tuple(map(str, entry["channels"])),
        tuple(map(str, entry["fields"])),
        tuple(map(str, entry["units"])),
        int(entry["count"]),
        None if rate is None else Fraction(rate),
        float(entry["start_s"]),
    )


def _field(name: str) -> str:
    """Return ``name`` as an identifier of protobuf."""
    plain = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
    return plain if plain and not plain[0].isdigit() and plain != TIME_FIELD else f"c_{plain}"


def _tag(number: int) -> int:
    """Return the tag of field ``number`` as the integer whose bytes it is, a varint."""
    key = number << 3 | DOUBLE
    return key if number < ONE_BYTE else (key & 0x7F) | 0x80 | (key >> 7) << 8
