"""The runs of one drive on one device that streams, each made once and shared by the checks."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from floatref.values.clock import UniformClock
from floatref.values.profile import Profile
from floatref.values.recording import Channel, Recording
from floatref_conformance.checks.streams.stream_check import StreamCase
from floatref_conformance.devices.streams.live_session import LiveCommand, LiveSession
from floatref_conformance.devices.streams.pieces import Piece, cut, drawn_cuts, even_cuts
from floatref_conformance.devices.streams.questions import say_hello
from floatref_conformance.devices.streams.transcript import Transcript
from floatref_conformance.errors import DeviceError

SHARE = 0.7
"""Of the drive, up to which two runs are the same."""
AFTER_S = 15.0
"""Time in s that the changed run goes on: longer than what may be on its way to a device."""
FACTOR = 1.5
"""Of what accelerometers and lasers measure after that moment, from its value there."""
UNCHANGED = ("distance", "wheel_distance", "optical_distance", "wheel_speed", "gnss_")
"""Beginnings of the names of channels that stay as they are."""
LONG_PIECE_S = 1.0
EVERY = 10
"""Pieces of a long run between two looks at the memory."""


@dataclass
class StreamRuns:
    """The runs of ``case`` on the device of ``command``; ``recording`` and ``truth`` are its own.

    A run that ends with a fault of the device ends so every time it is asked for.
    """

    case: StreamCase
    recording: Recording
    truth: Profile
    command: LiveCommand
    seed: int = 0
    _faults: dict[str, DeviceError] = field(default_factory=dict)

    @cached_property
    def moment_s(self) -> float:
        """Recorded time in s up to which two runs are the same, at the end of a piece."""
        cuts = even_cuts(self.recording)
        return cuts[int(SHARE * len(cuts))]

    @cached_property
    def plain(self) -> Transcript:
        """What came of even pieces."""
        return self._once("plain", lambda: cut(self.recording, even_cuts(self.recording)))

    @cached_property
    def recut(self) -> Transcript:
        """What came of drawn pieces, the channels by turns."""
        cuts = drawn_cuts(self.recording, self.seed)
        return self._once("recut", lambda: cut(self.recording, cuts, by_turns=True))

    @cached_property
    def changed(self) -> Transcript:
        """What came of other samples after the moment."""
        other = change_after(self.recording, self.moment_s)
        cuts = [at for at in even_cuts(other) if at <= self.moment_s + AFTER_S]
        return self._once("changed", lambda: cut(other, cuts))

    @cached_property
    def long(self) -> Transcript:
        """What came of all repeats."""
        return self._once("long", self._repeat, EVERY)

    def _repeat(self) -> Iterable[Piece]:
        whole = repeat(self.recording, self.case.repeats)
        return cut(whole, even_cuts(whole, LONG_PIECE_S))

    def _once(self, name: str, pieces: Callable[[], Iterable[Piece]], every: int = 0) -> Transcript:
        if name in self._faults:
            raise self._faults[name]
        try:
            return self._run(pieces(), every)
        except DeviceError as fault:
            self._faults[name] = fault
            raise

    def _run(self, pieces: Iterable[Piece], every: int) -> Transcript:
        session = LiveSession(self.command, say_hello(self.recording))
        try:
            for number, piece in enumerate(pieces):
                session.push(piece)
                if every and number % every == 0:
                    session.look_at_memory(piece.until_s)
            return session.finish()
        finally:
            session.kill()


def change_after(recording: Recording, moment_s: float) -> Recording:
    """Return ``recording`` with other samples after ``moment_s``, except distance and receiver."""
    return replace(recording, channels=tuple(_change(c, moment_s) for c in recording.channels))


def _change(channel: Channel, moment_s: float) -> Channel:
    if channel.id.name.startswith(UNCHANGED):
        return channel
    later = channel.times_s > moment_s + 1e-9
    known = channel.values[~later & np.isfinite(channel.values)]
    middle = known[-1] if known.size else 0.0
    return replace(
        channel, values=np.where(later, middle + FACTOR * (channel.values - middle), channel.values)
    )


def repeat(recording: Recording, count: int) -> Recording:
    """Return ``recording`` driven ``count`` times; distances go on from one to the next."""
    return replace(recording, channels=tuple(_repeat(c, count) for c in recording.channels))


def _repeat(channel: Channel, count: int) -> Channel:
    if not isinstance(channel.clock, UniformClock):
        raise DeviceError(f"channel {channel.id} has no rate and cannot be repeated")
    values = channel.values[:-1]
    if channel.id.name.endswith("distance"):
        step_m = float(channel.values[-1] - channel.values[0])
        return replace(channel, values=np.concatenate([values + k * step_m for k in range(count)]))
    return replace(channel, values=np.tile(values, count))
