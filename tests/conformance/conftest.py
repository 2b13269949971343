"""A toy check and toy devices, so that the judge is tested apart from the proving ground."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from floatref.files import read_recording, write_profile
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref.values.vehicle_setup import VehicleSetup
from floatref_conformance.checks.case import Case
from floatref_conformance.checks.catalogue import LeftOut
from floatref_conformance.checks.evidence import Pair
from floatref_conformance.checks.interface import Taken
from floatref_conformance.checks.scoring import roughness_within
from floatref_conformance.checks.stretches import stretch
from floatref_conformance.classes import DeviceClass
from floatref_conformance.judge.runner import Plan, run
from floatref_conformance.proving_ground.scenario import Scenario

HOSTILE = "<script>alert('x')</script>&amp;\x00\x1b[31m\u202e\ud800\ufffe \U0001f600 ]]>\r\n\"'"
RATE, SPEED, SECONDS, INTERVAL = 1000.0, 20.0, 3.0, 0.05
CHANNELS = {
    "vertical_specific_force": "left right",
    "height": "left right",
    "longitudinal_specific_force": "left right",
    "pitch_rate": "",
    "gnss_height": "",
    "unsprung_specific_force": "left right",
    "unsprung_displacement": "left right",
    "distance": "",
}
VEHICLE = VehicleSetup("quarter-car", {"unsprung_kg": 40.0})


def road(distance, scenario):
    """A sine of 3 mm at the default 1.8 m/km; the seed gives its wavelength."""
    amplitude = scenario.iri_m_per_km / 600.0
    return amplitude * np.sin(2 * np.pi * distance / (15.0 + scenario.seed % 7))


def drive(scenario):
    """Return a recording whose height sensor sees the road: the body hangs still at 1 m.

    The wheel is as stiff as the road, on which it moves up and down.
    """
    times = np.arange(int(RATE * SECONDS)) / RATE
    rolled = road(SPEED * times, scenario)
    samples = {
        "distance": SPEED * times,
        "height": 1.0 - rolled,
        "unsprung_displacement": rolled,
    }
    channels = [
        Channel.of(name, samples.get(name, np.zeros(times.size)), UniformClock.of(RATE), track)
        for name, tracks in CHANNELS.items()
        for track in (tracks.split() or [None])
    ]
    recording = Recording(tuple(channels), Setup(INTERVAL, vehicle=VEHICLE), "telling", "names")
    points = np.arange(int(SPEED * times[-1] / INTERVAL) + 1) * INTERVAL
    tracks = tuple(ProfileTrack.of(t, road(points, scenario)) for t in recording.tracks)
    return Taken(recording, Profile(INTERVAL, tracks), scenario)


@dataclass(frozen=True)
class ToyCheck:
    """Limits the difference of IRI between the delivered profile and the truth.

    Its variation may ask for several ``runs`` of a case. ``skew`` is added to every value.
    """

    id: str = "toy"
    needs: frozenset = frozenset()
    title: str = "a toy"
    clause: str = "Toy 1.2"
    derivation: str = "by hand"
    floor: str = "the road"
    count: int = 2
    skew: float = 0.0
    limits: dict = field(default_factory=dict)

    @property
    def simplest(self):
        return Case(self.id, Scenario())

    def cases(self, seed, effort):
        return tuple(
            Case(self.id, Scenario(seed=100 * seed + n), name=f"{self.id}-{n + 1}")
            for n in range(self.count)
        )

    def strategy(self):
        from hypothesis import strategies as st

        return st.builds(self._drawn, st.integers(0, 2**31), st.integers(10, 60))

    def list_scored(self, case):
        return ((10.0, 50.0),)

    def judge(self, case, bench):
        taken = drive(case.scenario)
        for run_number in range(int(case.variation.get("runs", 1))):
            profile = bench.run(taken, f"run {run_number + 1}")
        return tuple(self._measured(taken.truth, profile, t.name) for t in taken.truth.tracks)

    def _drawn(self, seed, tenths):
        return Case(self.id, Scenario(seed=seed, iri_m_per_km=tenths / 10))

    def _measured(self, truth, profile, track):
        found = stretch(profile, track, 10.0, 50.0)
        true = np.interp(
            10.0 + profile.interval_m * np.arange(found.size),
            truth.distance_m,
            truth.track(track).elevation,
        )
        pair = Pair(true, found, profile.interval_m, np.ones(found.size - 1, dtype=bool))
        either = {c: (0.0, limit) for c, limit in zip(DeviceClass, (0.1, 0.05, 0.01), strict=True)}
        measured = roughness_within(pair, track, "IRI error", either)
        return replace(measured, value=measured.value + self.skew)


@dataclass
class FakeDevice:
    """Delivers 1 m minus the height on every point, changed by ``spoil``; keeps what it saw.

    One of ``architecture`` response delivers the height of its wheels.
    """

    spoil: Callable = lambda tracks: tracks
    capabilities: tuple = ()
    said: object = None
    interval_m: float = INTERVAL
    architecture: str = "temporal"
    seen: list = field(default_factory=list)
    closed: int = 0

    def describe(self):
        if self.said is not None:
            return self.said
        return {
            "name": "fake",
            "version": "1",
            "architecture": self.architecture,
            "capabilities": list(self.capabilities),
        }

    def run(self, recording, profile):
        given = read_recording(recording)
        self.seen.append((recording, profile, profile.exists(), given))
        distance = given.channel("distance").values
        points = np.arange(int(distance[-1] / self.interval_m + 1e-9) + 1) * self.interval_m
        tracks = {t: np.interp(points, distance, self._road(given, t)) for t in given.tracks}
        made = tuple(ProfileTrack.of(t, z) for t, z in self.spoil(tracks).items())
        write_profile(Profile(self.interval_m, made), profile)

    def _road(self, given, track):
        if self.architecture == "response":
            return given.channel("unsprung_displacement", track).values
        return 1.0 - given.channel("height", track).values

    def close(self):
        self.closed += 1


@pytest.fixture
def hostile():
    """Return a text that a hostile device or file may hold."""
    return HOSTILE


@pytest.fixture
def toy_check():
    return ToyCheck


@pytest.fixture
def fake_device():
    return FakeDevice


@pytest.fixture
def clipping(fake_device):
    """A device that saturates: roads beyond 4 mm, 2.4 m/km, lose their tops."""
    return fake_device(lambda t: {name: np.clip(z, -0.004, 0.004) for name, z in t.items()})


@pytest.fixture
def halving(fake_device):
    """A device that delivers half of every elevation."""
    return fake_device(lambda t: {name: 0.5 * z for name, z in t.items()})


@pytest.fixture
def raising(fake_device):
    """Return a function that makes a device which raises ``error`` in the runs ``when`` says."""

    def make(error, when=lambda number: True):
        class Raising(fake_device):
            def run(self, recording, profile):
                super().run(recording, profile)
                if when(len(self.seen)):
                    raise error

        return Raising()

    return make


@pytest.fixture
def plan():
    """Return a function that plans one toy check on a device; nothing is left out."""

    def make(device, *checks, left_out=(), **settings):
        names = tuple(LeftOut(id_, "not selected", "Toy 1.3") for id_ in left_out)
        return Plan("fake:device", device, checks or (ToyCheck(),), names, **settings)

    return make


@pytest.fixture
def events_of():
    """Return a function that runs a plan and returns its events and its result."""

    def make(planned):
        events = []
        result = run(planned, events.append)
        assert events[-1].result is result
        return events, result

    return make


@pytest.fixture
def result_of(events_of):
    return lambda planned: events_of(planned)[1]
