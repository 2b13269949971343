"""A toy check and toy devices, so that the judge is tested apart from the proving ground."""

from collections.abc import Callable
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from floatref.files import read_recording, write_profile
from floatref.measures import iri
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.classes import DeviceClass
from floatref_conformance.runner import Plan
from floatref_conformance.verdict import Evidence, Measurement

RATE, SPEED, SECONDS, INTERVAL = 1000.0, 20.0, 3.0, 0.05
CHANNELS = {
    "vertical_specific_force": "left right",
    "height": "left right",
    "longitudinal_specific_force": "left right",
    "pitch_rate": "",
    "gnss_height": "",
    "distance": "",
}


def road(distance, seed):
    return 0.003 * np.sin(2 * np.pi * distance / (15.0 + seed % 7))


@dataclass(frozen=True)
class ToyCase:
    """A road that the height sensor sees directly, since the body hangs still at 1 m."""

    seed: int
    name: str = "toy"

    @property
    def parameters(self):
        return {"seed": self.seed}

    def simulate(self):
        times = np.arange(int(RATE * SECONDS)) / RATE
        samples = {"distance": SPEED * times, "height": 1.0 - road(SPEED * times, self.seed)}
        channels = [
            Channel.of(name, samples.get(name, np.zeros(times.size)), UniformClock.of(RATE), track)
            for name, tracks in CHANNELS.items()
            for track in (tracks.split() or [None])
        ]
        recording = Recording(tuple(channels), Setup(INTERVAL), "telling", "names")
        points = np.arange(int(SPEED * times[-1] / INTERVAL) + 1) * INTERVAL
        tracks = tuple(ProfileTrack.of(t, road(points, self.seed)) for t in recording.tracks)
        return SimpleNamespace(recording=recording, truth=Profile(INTERVAL, tracks))


@dataclass(frozen=True)
class ToyCheck:
    """Limits the difference of IRI between the delivered profile and the truth."""

    id: str = "toy"
    needs: frozenset = frozenset()
    title: str = "a toy"
    clause: str = "Toy 1.2"
    derivation: str = "by hand"
    floor: str = "the road"
    count: int = 2
    skew: float = 0.0
    limits: dict = field(default_factory=dict)

    def cases(self, seed, effort):
        return tuple(ToyCase(100 * seed + n, f"toy-{n + 1}") for n in range(self.count))

    def judge(self, case, profile, simulated):
        limits = dict(zip(DeviceClass, (0.1, 0.05, 0.01), strict=True))
        measured = []
        for truth in simulated.truth.tracks:
            z = stretch(profile, truth.name, 10.0, 50.0)
            value = iri(z, profile.interval_m)
            error = abs(value - iri(stretch(simulated.truth, truth.name, 10.0, 50.0), INTERVAL))
            measured += [
                Measurement("IRI error", truth.name, error, "m/km", limits),
                Measurement(
                    "IRI", truth.name, value + self.skew, "m/km",
                    dict.fromkeys(DeviceClass, 1e9), Evidence(z, profile.interval_m),
                ),
            ]  # fmt: skip
        return tuple(measured)


@dataclass
class FakeDevice:
    """Delivers 1 m minus the height on every point, changed by ``spoil``; keeps what it saw."""

    spoil: Callable = lambda tracks: tracks
    capabilities: tuple = ()
    said: object = None
    interval_m: float = INTERVAL
    seen: list = field(default_factory=list)

    def describe(self):
        if self.said is not None:
            return self.said
        return {
            "name": "fake",
            "version": "1",
            "architecture": "temporal",
            "capabilities": list(self.capabilities),
        }

    def run(self, recording, profile):
        given = read_recording(recording)
        self.seen.append((recording, profile, profile.exists(), given))
        distance = given.channel("distance").values
        points = np.arange(int(distance[-1] / self.interval_m + 1e-9) + 1) * self.interval_m
        tracks = {
            t: 1.0 - np.interp(points, distance, given.channel("height", t).values)
            for t in given.tracks
        }
        made = tuple(ProfileTrack.of(t, z) for t, z in self.spoil(tracks).items())
        write_profile(Profile(self.interval_m, made), profile)


@pytest.fixture
def toy_check():
    return ToyCheck


@pytest.fixture
def fake_device():
    return FakeDevice


@pytest.fixture
def plan():
    """Return a function that plans one toy check on a device; nothing is left out."""

    def make(device, *checks, left_out=(), **settings):
        names = tuple(LeftOut(id_, "not selected", "Toy 1.3") for id_ in left_out)
        return Plan("fake:device", device, checks or (ToyCheck(),), names, **settings)

    return make
