"""Runs of a device that was never there: what it gave out is written down."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.checks.streams.stream_check import StreamCase
from floatref_conformance.devices.streams.answers import Latency, Path, Points, Started
from floatref_conformance.devices.streams.transcript import Given, Transcript
from floatref_conformance.proving_ground.scenario import Scenario

SPEED_MPS, END_S, INTERVAL_M = 20.0, 100.0, 0.25
LATENCY = Latency(travelled_m=200.0, then_s=2.0, longest_s=60.0, provisional_s=3.0)


def road(places_m):
    """Return a road of waves from 2 to 30 m, in m."""
    waves = np.geomspace(2.0, 30.0, 9)
    return sum(2e-4 * w * np.sin(2 * np.pi * places_m / w + w) for w in waves)


def drive(dwell=()):
    """Return the times and distances of a drive at `SPEED_MPS` that stands between two times."""
    times = np.arange(0.0, END_S, 0.01)
    speed = np.full(times.size, SPEED_MPS)
    if dwell:
        speed[(times > dwell[0]) & (times < dwell[1])] = 0.0
    return times, np.concatenate(([0.0], np.cumsum(speed[:-1]) * 0.01))


def recording_of(distance_m):
    clock = UniformClock.of(100.0)
    return Recording((Channel.of("distance", distance_m, clock),), Setup())


def points(first, elevation, state="final", valid=None, name="left"):
    z = np.array(elevation, dtype=float)
    flags = np.isfinite(z) if valid is None else np.array(valid)
    return Points(state, first, INTERVAL_M, {name: Path(z, flags)})


def steadily(state="final", after_s=12.0, piece_m=50.0, error=1.0, length_m=SPEED_MPS * END_S):
    """Return points of every ``piece_m``, given out ``after_s`` behind their passing."""
    given = []
    for k in range(int(length_m / piece_m)):
        places = k * piece_m + INTERVAL_M * np.arange(int(piece_m / INTERVAL_M))
        at_s = (k + 1) * piece_m / SPEED_MPS + after_s
        first = round(k * piece_m / INTERVAL_M)
        given.append(Given(points(first, error * road(places), state), at_s))
    return given


@dataclass
class MadeUp:
    """Runs with what was given out, as a check asks for them."""

    plain: Transcript
    recut: Transcript | None = None
    changed: Transcript | None = None
    long: Transcript | None = None
    moment_s: float = 70.0
    recording: Recording = field(default_factory=lambda: recording_of(drive()[1]))
    case: StreamCase = field(default_factory=lambda: StreamCase("made-up", Scenario(), steady=True))

    @property
    def truth(self):
        places = INTERVAL_M * np.arange(int(SPEED_MPS * END_S / INTERVAL_M) + 1)
        return Profile(INTERVAL_M, (ProfileTrack.of("left", road(places)),))


@pytest.fixture
def transcript():
    """Return a maker of transcripts of what was given out."""

    def make(given=None, latency=LATENCY, tolerance_m=0.0, memory=()):
        mine = sorted(steadily() if given is None else given, key=lambda each: each.until_s)
        return Transcript(Started(latency, tolerance_m), list(mine), list(memory))

    return make


@pytest.fixture
def fails():
    """Return a function that returns the quantities that are beyond their limits."""

    def beyond(check, runs):
        return [m.quantity for m in check.judge(runs) if not m.within("nominal")]

    return beyond
