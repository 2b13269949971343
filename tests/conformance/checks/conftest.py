"""A bench whose device is right, until it is spoilt: what is put in, a check has to read."""

from dataclasses import replace

import numpy as np
import pytest

from floatref.measures import high_pass, iri
from floatref.values.clock import UniformClock
from floatref.values.profile import Profile, ProfileTrack
from floatref.values.recording import Channel, Recording, Setup
from floatref_conformance.checks.interface import Taken
from floatref_conformance.devices.interface import CAPABILITIES
from floatref_conformance.proving_ground.staging import drive_of

INTERVAL_M = 0.025


def road(scenario, length_m):
    """Random slopes, a road of the IRI that the scenario asks for."""
    rng = np.random.default_rng(scenario.seed)
    slopes = rng.standard_normal(int(length_m / INTERVAL_M) + 1)
    smooth = np.convolve(slopes, np.hanning(83) / 40.0, "same")
    elevation = high_pass(np.cumsum(smooth), INTERVAL_M)
    return elevation * scenario.iri_m_per_km / iri(elevation, INTERVAL_M)


class RightBench:
    """Delivers the truth, filtered alike, on the axis that the encoder tells.

    ``spoil`` gets the label of every run and its profile, and returns what is delivered. An
    ``augmented`` device has an inertial unit, a receiver and a
    response, of channels that only fill a place.
    """

    def __init__(self, spoil=lambda label, profile: profile, augmented=False):
        self.spoil, self.augmented = spoil, augmented
        self.labels = []
        self.taken = {}

    def simulate(self, scenario):
        drive = drive_of(scenario)
        rate_hz = scenario.rate_hz
        clock = UniformClock.of(rate_hz)
        times = clock.times(int(drive.duration_s * rate_hz))
        distance = drive.motion(times).distance
        rng = np.random.default_rng(scenario.seed)
        channels = [Channel.of("distance", distance, clock)]
        for track in scenario.tracks:
            force = 9.80665 + 0.3 * rng.standard_normal(times.size)
            height = 0.3 + 0.002 * rng.standard_normal(times.size)
            channels.append(Channel.of("vertical_specific_force", force, clock, track))
            channels.append(Channel.of("height", height, clock, track))
        if self.augmented:
            channels += self._augmented(times[-1], scenario, rng)
        tracks = tuple(
            ProfileTrack.of(t, road(replace(scenario, seed=scenario.seed + n), distance[-1]))
            for n, t in enumerate(scenario.tracks)
        )
        setup = Setup(profile_interval_m=INTERVAL_M)
        taken = Taken(Recording(tuple(channels), setup), Profile(INTERVAL_M, tracks), scenario)
        self.taken[scenario] = taken
        return taken

    def run(self, taken, label=""):
        self.labels.append(label)
        whole = self.taken[taken.scenario].recording.channel("distance")
        encoder = taken.recording.channel("distance")
        known = ~np.isnan(encoder.values)
        farthest = np.maximum.accumulate(encoder.values[known])
        seconds = (
            encoder.times_s[known] - encoder.times_s[0] + whole.times_s[-1] - self._span(encoder)
        )
        shift = taken.truth.start_m
        true = np.interp(seconds, whole.times_s, whole.values)
        points = np.arange(farthest[0], farthest[-1], INTERVAL_M)
        _, first = np.unique(farthest, return_index=True)
        places = np.interp(points, farthest[first], true[first])
        tracks = tuple(
            ProfileTrack.of(
                t.name,
                np.interp(
                    places, taken.truth.distance_m - shift, high_pass(t.elevation, INTERVAL_M)
                ),
            )
            for t in taken.truth.tracks
        )
        return self.spoil(label, Profile(INTERVAL_M, tracks, float(points[0])))

    @staticmethod
    def _augmented(last_s, scenario, rng):
        clock, count = UniformClock.of(1000.0), int(last_s * 1000.0) + 1
        for name in ("unsprung_specific_force", "sprung_specific_force", "suspension_deflection"):
            for track in scenario.tracks:
                yield Channel.of(name, rng.random(count), clock, track)
        rates = {"imu": scenario.gyro_rate_hz, "gnss": 20.0}
        for capability, rate_hz in rates.items():
            clock, count = UniformClock.of(rate_hz), int(last_s * rate_hz) + 1
            for name in sorted(CAPABILITIES[capability]):
                values = np.full(count, 4.0) if name == "gnss_quality" else rng.random(count)
                yield Channel.of(name, values, clock)

    @staticmethod
    def _span(channel):
        """From the first to the last sample: recordings lose samples at their beginning alone."""
        begin, end = channel.span_s
        return end - begin


@pytest.fixture
def right_bench():
    return RightBench
