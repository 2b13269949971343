"""A simulated loop of ten minutes that is driven again and again, for measuring a live stream."""

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from kind_drives import KIND

import floatref
from floatref.values.clock import StampedClock
from floatref.values.recording import Channel
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

PUSH_S = 0.01
LOOP = Scenario(manoeuvre="stop", stops=6, event_at_m=1200.0, stop_spacing_m=1500.0, dwell_s=5.0,
                final_speed_kmh=72.0, length_m=12_000.0, response=False, **KIND)  # fmt: skip
NOMINAL = ("vertical_specific_force", "height", "distance")
GOES_ON = ("distance", "gnss_height", "gnss_latitude", "gnss_longitude")
"""Channels of a place: each lap begins where the one before has ended."""


@dataclass(frozen=True)
class Loop:
    """The loop in memory: its channels, and its length in pieces of `PUSH_S`."""

    recording: floatref.Recording
    pieces: int

    @property
    def clocks(self) -> dict:
        """The clock of every channel, as `start_stream` takes it."""
        return {
            str(c.id): None if isinstance(c.clock, StampedClock) else float(c.clock.rate)
            for c in self.recording.channels
        }

    @property
    def megabytes(self) -> float:
        return sum(c.values.nbytes for c in self.recording.channels) / 1e6

    def pushes(self, seconds: float, push_s: float = PUSH_S) -> Iterator[dict]:
        """Yield pieces of ``push_s``, lap after lap; places and times go on."""
        tracks = [_Track(channel, self.pieces, push_s) for channel in self.recording.channels]
        count = int(self.pieces * PUSH_S / push_s + 1e-9)
        for number in range(round(seconds / push_s)):
            lap, at = divmod(number, count)
            found = {}
            for track in tracks:
                piece = track.piece(lap, at, count * push_s)
                if piece is not None:
                    found[track.name] = piece
            yield found


class _Track:
    """One channel of the loop, in pieces."""

    def __init__(self, channel: Channel, pieces: int, push_s: float) -> None:
        self.name, self.values = str(channel.id), channel.values
        self.times = channel.times_s if isinstance(channel.clock, StampedClock) else None
        self.size = 0 if self.times is not None else round(float(channel.clock.rate) * push_s)
        self.lap_change = 0.0
        if self.times is not None:
            edges = np.arange(int(pieces * PUSH_S / push_s + 1e-9) + 1) * push_s
            self.ends = np.searchsorted(self.times, edges).tolist()
        if channel.id.name in GOES_ON:
            end = pieces * PUSH_S
            last = np.searchsorted(channel.times_s, end)
            step = float(np.nanmean(np.diff(self.values[-1000:])))
            self.lap_change = float(self.values[last - 1] - self.values[0]) + step

    def piece(self, lap: int, at: int, lap_s: float):
        """Return the samples of piece ``at``, None without any."""
        if self.times is None:
            part = self.values[at * self.size : (at + 1) * self.size]
            return part + lap * self.lap_change if lap and self.lap_change else part
        first, end = self.ends[at], self.ends[at + 1]
        if first == end:
            return None
        part = slice(first, end)
        return self.times[part] + lap * lap_s, self.values[part] + lap * self.lap_change


def loop_for(pipeline: str) -> Loop:
    """Return the loop with the channels that ``pipeline`` needs.

    Another process simulates it: it takes 2 GB, which are not the stream's.
    """
    with TemporaryDirectory() as folder:
        path = Path(folder) / "loop"
        subprocess.run([sys.executable, __file__, str(path), pipeline], check=True)
        recording = floatref.read_recording(path)
        channels = tuple(replace(c, values=np.array(c.values)) for c in recording.channels)
        recording = replace(recording, channels=tuple(_own_clock(c) for c in channels))
    spans = [c.span_s[1] for c in recording.channels]
    return Loop(recording, int(min(spans) / PUSH_S))


def _own_clock(channel: Channel) -> Channel:
    if not isinstance(channel.clock, StampedClock):
        return channel
    return replace(channel, clock=StampedClock(np.array(channel.clock.times_s)))


def _simulate(path: str, pipeline: str) -> None:
    made = simulate(LOOP).recording
    if not floatref.pipeline_capabilities(pipeline):
        made = replace(made, channels=tuple(c for c in made.channels if c.id.name in NOMINAL))
    floatref.write_recording(made, Path(path))


if __name__ == "__main__":
    _simulate(*sys.argv[1:])
