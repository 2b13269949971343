"""What the judge writes to a device that streams: one JSON object per line, `floatref-live/1`.

A line is `hello`, `samples`, `sync` or `finish`, by its ``kind``. `sync` is the judge's own: the
device answers it when it has written every point that the samples so far make.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from floatref.files.recording_directory import describe_installation
from floatref.values.arrays import FloatArray
from floatref.values.channels import channel_spec
from floatref.values.clock import UniformClock
from floatref.values.recording import Channel, Recording

FORMAT = "floatref-live/1"


@dataclass(frozen=True, eq=False)
class Part:
    """Successive samples of a channel from number ``first`` on, and their times if it has no rate.

    Shape (N,) each, in SI units and s.
    """

    first: int
    values: FloatArray
    times_s: FloatArray | None = None


Samples = Mapping[str, Part]
"""By the name of a channel its samples."""


def say_hello(recording: Recording) -> dict[str, Any]:
    """Return the message that states setup and channels of ``recording``."""
    setup = describe_installation(recording)["setup"]
    channels = [_channel(channel) for channel in recording.channels]
    return {"kind": "hello", "format": FORMAT, "setup": setup, "channels": channels}


def _channel(channel: Channel) -> dict[str, Any]:
    entry: dict[str, Any] = {"name": channel.id.name}
    if channel.id.track is not None:
        entry["track"] = channel.id.track
    entry["unit"] = channel_spec(channel.id.name).unit
    if isinstance(channel.clock, UniformClock):
        entry |= {"rate_hz": float(channel.clock.rate), "start_s": float(channel.clock.start_s)}
    return entry


def write_samples(samples: Samples) -> bytes:
    """Return the line with ``samples``; a missing one is null."""
    channels = {}
    for name, part in samples.items():
        channels[name] = {"first": part.first, "values": plain(part.values)}
        if part.times_s is not None:
            channels[name]["times_s"] = plain(part.times_s)
    return write({"kind": "samples", "channels": channels})


def write(message: Mapping[str, Any]) -> bytes:
    """Return ``message`` as one line with its end."""
    return json.dumps(message, allow_nan=False).encode("ascii") + b"\n"


def plain(values: FloatArray) -> Sequence[float | None]:
    """Return ``values`` as JSON has them: null for NaN."""
    listed: list[float | None] = values.tolist()
    if np.isnan(values).any():
        return [None if value != value else value for value in listed]
    return listed
