"""Streams that are wrong on purpose, each in its own process, each with one error.

`python -m floatref_conformance.mutants.in_streams NAME` answers one stream by a sound pipeline,
except for the error that its entry in `STREAM_MUTANTS` describes.
"""

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from floatref.errors import InputError
from floatref.values.display.similar_names import suggest
from floatref.values.profile import ProfileTrack
from floatref.values.recording import Setup
from floatref_conformance.devices.builtin import BuiltinDevice
from floatref_conformance.devices.host import stream_alone
from floatref_conformance.devices.streams.serving import Clocks, Stream

PIPELINE = "temporal-matched-hpf"
MODULE = "floatref_conformance.mutants.in_streams"
REVISED_M = 1e-4
"""By how much a final point is revised, in m."""
HELD_S = 60.0
"""Time in s by which final points are held back beyond what is declared."""


@dataclass
class Wrong:
    """A sound stream with an error; by itself it has no error.

    Attributes:
        sound: the stream that does the work.
    """

    sound: Stream

    @property
    def latency(self) -> Any:
        """What the sound stream declares."""
        return self.sound.latency

    def push(self, samples: Mapping[str, Any]) -> None:
        """Pass on the samples."""
        self.sound.push(samples)

    def ready(self, wait: bool = False) -> Sequence[Any]:
        """Return what the sound stream gives."""
        return self.sound.ready(wait)

    def finish(self) -> Sequence[Any]:
        """Return the last points of the sound stream."""
        return self.sound.finish()


@dataclass
class LooksAhead(Wrong):
    """Provisional points hold what the laser measures later, in samples on their way."""

    # The host answers a sync after `AHEAD` further ones: see `messages_ahead`.
    later: list[float] = field(default_factory=list)

    def push(self, samples: Mapping[str, Any]) -> None:
        """Pass on the samples, and note the last height."""
        heights = [v for name, v in samples.items() if name.endswith("height") and len(v)]
        self.later += [float(v[-1]) for v in heights]
        super().push(samples)

    def ready(self, wait: bool = False) -> Sequence[Any]:
        """Return points whose provisional elevations are off by the latest height."""
        shift = self.later[-1] if self.later else 0.0
        return [
            _shifted(p, shift * REVISED_M) if p.state == "provisional" else p
            for p in self.sound.ready(wait)
        ]


@dataclass
class Revises(Wrong):
    """What is final is given out again, a little changed, with the next final points."""

    last: Any = None

    def ready(self, wait: bool = False) -> Sequence[Any]:
        """Return points, behind each final one its revised predecessor."""
        return list(self._revised(self.sound.ready(wait)))

    def _revised(self, made: Sequence[Any]) -> Iterator[Any]:
        for points in made:
            yield points
            if points.state == "final":
                if self.last is not None:
                    yield _shifted(self.last, REVISED_M)
                self.last = points


@dataclass
class Stalls(Wrong):
    """Final points stay in a queue for a minute longer than declared."""

    reached_s: float = 0.0
    held: list[tuple[float, Any]] = field(default_factory=list)
    rates_hz: Mapping[str, float] = field(default_factory=dict)

    def push(self, samples: Mapping[str, Any]) -> None:
        """Pass on the samples, and follow the time by one channel of them."""
        name = next(iter(self.rates_hz))
        self.reached_s += len(samples.get(name, ())) / self.rates_hz[name]
        super().push(samples)

    def ready(self, wait: bool = False) -> Sequence[Any]:
        """Return provisional points, and final ones of a minute ago and the wait for them."""
        made = self.sound.ready(wait)
        due_s = self.reached_s + self.latency.longest_s + HELD_S
        self.held += [(due_s, points) for points in made if points.state == "final"]
        out = [points for points in made if points.state != "final"]
        out += [points for at_s, points in self.held if at_s <= self.reached_s]
        self.held = [each for each in self.held if each[0] > self.reached_s]
        return out

    def finish(self) -> Sequence[Any]:
        """Return all that is held."""
        return [*(points for _, points in self.held), *self.sound.finish()]


@dataclass
class Leaks(Wrong):
    """Every sample that was ever pushed is kept."""

    kept: list[Any] = field(default_factory=list)

    def push(self, samples: Mapping[str, Any]) -> None:
        """Keep the samples, and pass them on."""
        self.kept += [np.array(values) for values in samples.values()]
        super().push(samples)


@dataclass
class DependsOnChunks(Wrong):
    """The heights of each push are smoothed by themselves, so that its ends are not."""

    def push(self, samples: Mapping[str, Any]) -> None:
        """Smooth heights over three samples of this push, and pass them on."""
        super().push({n: _smooth(v) if n.endswith("height") else v for n, v in samples.items()})


def _smooth(values: np.ndarray) -> np.ndarray:
    out = np.array(values)
    out[1:-1] = (values[:-2] + values[1:-1] + values[2:]) / 3.0
    return out


def _shifted(points: Any, by_m: float) -> Any:
    """Return ``points`` with elevations ``by_m`` higher."""
    tracks = (ProfileTrack.of(t.name, t.elevation + by_m, t.valid, t.sigma) for t in points.tracks)
    return replace(points, tracks=tuple(tracks))


AHEAD = 8
"""Syncs that are answered late by the one that looks ahead: 4 s of the judge's pieces."""


def messages_ahead(messages: Iterator[Mapping[str, Any]]) -> Iterator[Mapping[str, Any]]:
    """Yield ``messages`` with each sync behind the samples of `AHEAD` further ones."""
    waiting: list[Mapping[str, Any]] = []
    for message in messages:
        if message["kind"] == "finish":
            yield from waiting
        if message["kind"] != "sync":
            yield message
            continue
        waiting.append(message)
        if len(waiting) > AHEAD:
            yield waiting.pop(0)


@dataclass(frozen=True)
class StreamMutant:
    """A device whose stream is wrong.

    Attributes:
        name: of the device.
        wrong: description of the error, in one line.
        fails: ids of the stream checks that must fail it.
        kind: the stream with the error.
    """

    name: str
    wrong: str
    fails: tuple[str, ...]
    kind: Callable[[Stream], Wrong]

    @property
    def live_argv(self) -> tuple[str, ...]:
        """The command line of a process that answers one stream."""
        return (sys.executable, "-m", MODULE, self.name)

    def describe(self) -> Mapping[str, Any]:
        """Return the description of the sound pipeline, with the mutant's name."""
        return {**BuiltinDevice(PIPELINE).describe(), "name": self.name}

    def run(self, recording: Path, profile: Path) -> None:
        """Process a whole recording without any error."""
        BuiltinDevice(PIPELINE).run(recording, profile)

    def open_stream(self, setup: Setup, clocks: Clocks) -> Stream:
        """Return a stream with the error."""
        made = self.kind(BuiltinDevice(PIPELINE).open_stream(setup, clocks))
        if isinstance(made, Stalls):
            made.rates_hz = {n: float(c.rate) for n, c in clocks.items() if c is not None}
        return made


STREAM_MUTANTS = (
    StreamMutant(
        "stream-looks-ahead",
        "reads on before it answers, and corrects points by what comes later",
        ("live-order",),
        LooksAhead,
    ),
    StreamMutant(
        "stream-revises",
        "gives out final points a second time, a tenth of a millimetre higher",
        ("live-final",),
        Revises,
    ),
    StreamMutant(
        "stream-stalls",
        "holds final points back for a minute longer than it declares",
        ("live-latency",),
        Stalls,
    ),
    StreamMutant("stream-leaks", "keeps every sample that was pushed", ("live-memory",), Leaks),
    StreamMutant(
        "stream-depends-on-chunks",
        "smooths the heights of each piece for itself",
        ("live-chunks",),
        DependsOnChunks,
    ),
)
"""All of them, in the order in which they are listed."""


def stream_mutant(name: str) -> StreamMutant:
    """Return the mutant ``name``; InputError if it is unknown."""
    for mutant in STREAM_MUTANTS:
        if mutant.name == name:
            return mutant
    known = suggest(name, [mutant.name for mutant in STREAM_MUTANTS], "known:")
    raise InputError(f"stream mutant {name}: unknown; {known}")


if __name__ == "__main__":
    chosen = stream_mutant(sys.argv[1])
    stream_alone(chosen.open_stream, messages_ahead if chosen.kind is LooksAhead else iter)
