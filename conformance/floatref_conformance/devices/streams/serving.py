"""The device's side of a stream, for streams that are Python objects.

It reads `hello`, `samples`, `sync` and `finish`, and answers with what the stream gives out.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any, Protocol

import numpy as np

from floatref.errors import FloatrefError
from floatref.files.recording_directory import setup_of
from floatref.values.clock import UniformClock
from floatref.values.profile import ProfileTrack
from floatref.values.recording import Setup
from floatref_conformance.devices.streams.questions import FORMAT, plain

LONGEST_PIECE = 20_000
"""Most points in one answer: a line of a megabyte or two."""


class Gives(Protocol):
    """Points of a stream, such as those of floatref."""

    @property
    def state(self) -> str:
        """Either final or provisional."""

    @property
    def first(self) -> int:
        """The number of the first point, which lies at its number times the interval."""

    @property
    def interval_m(self) -> float:
        """Distance between points in m."""

    @property
    def tracks(self) -> Sequence[ProfileTrack]:
        """The points of every wheel path."""


class Stream(Protocol):
    """What a Python device gives for a run; a stream of floatref is one."""

    @property
    def latency(self) -> Any:
        """A dataclass: travelled_m, then_s, longest_s, standing_s and provisional_s."""

    def push(self, samples: Mapping[str, Any]) -> None:
        """Take samples by the name of their channel: values, or (times in s, values)."""

    def ready(self, wait: bool = False) -> Sequence[Gives]:
        """Return the points made since the last call; with ``wait``, of all that was pushed."""

    def finish(self) -> Sequence[Gives]:
        """End the run and return the remaining points."""


Clocks = Mapping[str, UniformClock | None]
"""The clock of every channel by its name; None for samples that come with their times."""
OpenStream = Callable[[Setup, Clocks], Stream]
Answer = Callable[[Mapping[str, Any]], None]


def serve_stream(
    open_stream: OpenStream, messages: Iterable[Mapping[str, Any]], answer: Answer
) -> None:
    """Answer ``messages`` until `finish`, with one stream that ``open_stream`` makes.

    An error of floatref is answered as `refused`; any other is raised.
    """
    stream: Stream | None = None
    try:
        for message in messages:
            if message["kind"] == "hello":
                stream = open_stream(setup_of(message.get("setup", {})), _clocks(message))
                latency = asdict(stream.latency)
                answer({"kind": "started", "format": FORMAT, "latency": latency})
            elif stream is not None and not _obey(stream, message, answer):
                return
    except FloatrefError as error:
        answer({"kind": "refused", "text": " ".join(str(error).split())})


def _clocks(hello: Mapping[str, Any]) -> dict[str, UniformClock | None]:
    clocks: dict[str, UniformClock | None] = {}
    for entry in hello["channels"]:
        name = ".".join(part for part in (entry.get("track"), entry["name"]) if part)
        rate = entry.get("rate_hz")
        clocks[name] = None if rate is None else UniformClock.of(rate, entry.get("start_s", 0.0))
    return clocks


def _obey(stream: Stream, message: Mapping[str, Any], answer: Answer) -> bool:
    """Do what ``message`` asks; return whether the run goes on."""
    kind = message["kind"]
    if kind == "samples":
        stream.push({name: _samples(part) for name, part in message["channels"].items()})
    elif kind == "sync":
        _give(stream.ready(wait=True), answer)
        answer({"kind": "synced", "number": message["number"]})
    elif kind == "finish":
        _give(stream.finish(), answer)
        answer({"kind": "finished"})
        return False
    return True


def _samples(part: Mapping[str, Any]) -> Any:
    values = np.array(part["values"], dtype=np.float64)
    return (np.array(part["times_s"]), values) if "times_s" in part else values


def _give(made: Iterable[Gives], answer: Answer) -> None:
    for points in made:
        count = points.tracks[0].elevation.size
        for begin in range(0, count, LONGEST_PIECE):
            here = slice(begin, begin + LONGEST_PIECE)
            answer(
                {
                    "kind": "points",
                    "state": str(points.state),
                    "first": points.first + begin,
                    "interval_m": points.interval_m,
                    "tracks": {track.name: _path(track, here) for track in points.tracks},
                }
            )


def _path(track: ProfileTrack, here: slice) -> dict[str, Any]:
    path = {"elevation": plain(track.elevation[here]), "valid": track.valid[here].tolist()}
    if track.sigma is not None:
        path["sigma"] = plain(track.sigma[here])
    return path
