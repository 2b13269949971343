"""What another program may send, `floatref-live/1`: a hello, samples, and the end of the run.

JSON and Arrow both become the values of this module. Samples are checked here and not by the JSON
Schema, which would take longer than all else; a test holds one to the other.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from floatref.engine.choosing import AUTO
from floatref.errors import InputError
from floatref.files.document import show
from floatref.files.recording_directory import setup_of
from floatref.files.schema import enforce
from floatref.files.sources import name_errors
from floatref.live.bounds import LATE_S
from floatref.values.arrays import FloatArray
from floatref.values.channels import ChannelId, check_unit
from floatref.values.clock import UniformClock
from floatref.values.recording import Setup

FORMAT = "floatref-live/1"
SCHEMA = "floatref-live-1"
LARGEST_BYTES = 16 << 20
"""Largest message in bytes; a second of ten channels at 16 kHz is 3 MB of JSON."""
MOST_FIRST = 10**15
NUMBERS = {int, float, type(None)}


@dataclass(frozen=True)
class Hello:
    """The first message.

    Attributes:
        channels: clock of every channel, None where samples come with times; empty in a hello that
            only goes on with a saved run.
        setup: of the vehicle.
        pipeline, settings, late_s, provisional: as `floatref.start_stream` takes them.
        points_from: number of the first final point that is to be sent again; None for no point.
        token: what the peer was given to be let in.
        document: the message itself, without the token.
    """

    channels: Mapping[ChannelId, UniformClock | None] = field(default_factory=dict)
    setup: Setup = field(default_factory=Setup)
    pipeline: str = AUTO
    settings: Mapping[str, Any] = field(default_factory=dict)
    late_s: float = LATE_S
    provisional: bool = True
    points_from: int | None = None
    token: str = ""
    document: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Piece:
    """Successive samples of one channel, NaN for missing ones, shape (N,).

    Attributes:
        values: in the unit of the channel.
        times_s: their times in s, shape (N,), for a channel without a rate.
        first: number of the first of them; None if they follow those of the message before.
    """

    values: FloatArray
    times_s: FloatArray | None = None
    first: int | None = None

    @property
    def pushed(self) -> FloatArray | tuple[FloatArray, FloatArray]:
        """What a stream is given of it."""
        return self.values if self.times_s is None else (self.times_s, self.values)


@dataclass(frozen=True, eq=False)
class Samples:
    """Samples of some channels by name, such as "left.height"."""

    channels: Mapping[str, Piece]


@dataclass(frozen=True)
class Finish:
    """The run is complete."""


Message = Hello | Samples | Finish


class Sent(NamedTuple):
    """A message, and where in the input it is, such as "line 3"."""

    where: str
    message: Message


def read_message(document: Any, where: str) -> Message:
    """Return the message in a JSON ``document``; InputError naming ``where``, field and value."""
    kind = document.get("kind") if isinstance(document, dict) else None
    if kind == "samples":
        with name_errors(where):
            return Samples(_read_pieces(document.get("channels")))
    enforce(document, SCHEMA, where)
    return Finish() if kind == "finish" else read_hello(document, where)


def read_hello(document: Mapping[str, Any], where: str) -> Hello:
    """Return the hello in ``document``; InputError naming ``where``, field and value."""
    enforce(document, SCHEMA, where)
    given = {k: document[k] for k in ("pipeline", "settings", "provisional") if k in document}
    with name_errors(where):
        return Hello(
            channels=_read_channels(document.get("channels", [])),
            setup=setup_of(document.get("setup", {})),
            late_s=float(document.get("late_s", LATE_S)),
            points_from=document.get("points_from"),
            token=document.get("token", ""),
            document={k: v for k, v in document.items() if k not in ("token", "points_from")},
            **given,
        )


def _read_channels(entries: list[Any]) -> dict[ChannelId, UniformClock | None]:
    found: dict[ChannelId, UniformClock | None] = {}
    for number, entry in enumerate(entries):
        name = ChannelId(entry["name"], entry.get("track"))
        with name_errors(f"channels[{number}]"):
            check_unit(name, entry["unit"])
            if name in found:
                raise InputError(f"channel {name}: given twice; give each channel once")
            found[name] = None
            if "rate_hz" in entry:
                found[name] = UniformClock.of(entry["rate_hz"], float(entry.get("start_s", 0.0)))
    return found


def _read_pieces(channels: Any) -> dict[str, Piece]:
    if not isinstance(channels, dict):
        raise InputError(f"channels is {show(channels)}; expected an object of samples by channel")
    return {name: _read_piece(f"channels.{name}", given) for name, given in channels.items()}


def _read_piece(where: str, given: Any) -> Piece:
    if not isinstance(given, dict):
        raise InputError(f"{where} is {show(given)}; expected an object with values")
    times = given.get("times_s")
    if "times_s" in given:
        times = read_numbers(f"{where}.times_s", times, missing=False)
    return Piece(
        read_numbers(f"{where}.values", given.get("values")),
        times,
        _read_first(f"{where}.first", given["first"]) if "first" in given else None,
    )


def _read_first(where: str, given: Any) -> int:
    whole = isinstance(given, int) and not isinstance(given, bool)
    whole = whole or (isinstance(given, float) and given.is_integer())
    if not whole or not 0 <= given <= MOST_FIRST:
        raise InputError(f"{where} is {show(given)}; expected the number of a sample, from 0 on")
    return int(given)


def read_numbers(where: str, given: Any, missing: bool = True) -> FloatArray:
    """Return the list ``given`` as an array, null as NaN where values may be ``missing``."""
    if not isinstance(given, list):
        raise InputError(f"{where} is {show(given)}; expected a list of numbers")
    kinds = set(map(type, given))
    allowed = NUMBERS if missing else NUMBERS - {type(None)}
    if not kinds <= allowed:
        at = next(n for n, each in enumerate(given) if type(each) not in allowed)
        what = "a number, or null for a missing sample" if missing else "a number"
        raise InputError(f"{where}[{at}] is {show(given[at])}; expected {what}")
    return np.array(given, dtype=np.float64)
