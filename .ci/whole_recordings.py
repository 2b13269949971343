"""Six whole recordings, simulated from fixed scenarios, and the numbers of a profile.

`outputs.py` runs every pipeline on them.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cache
from math import nan

import numpy as np

import floatref
from floatref.measures.valid_iri import profile_iri
from floatref.values.profile import Profile
from floatref.values.recording import Channel, Recording
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import simulate

INTERVAL_M, RATE_HZ = 0.05, 2000.0
BASE = Scenario(seed=26, rate_hz=RATE_HZ, profile_interval_m=INTERVAL_M, response=False)
UNITS = ("m/km", "m/km", "mm", "mm", "m", "mm", "mm", "mm", "mm", "mm")
NAMES = ("iri_left", "iri_right", "rms", "largest", "flagged", "sigma", "z_1", "z_2", "z_3", "z_4")
Row = tuple[float, ...]


@dataclass(frozen=True)
class Whole:
    """A recording: its scenario, where elevations are listed, and what is taken out of it.

    Attributes:
        scenario: what is driven.
        at_m: four places in m.
        gap_m: from and to in m, without heights of the left wheel path.
        has_height: whether it has a height sensor at all.
    """

    scenario: Scenario
    at_m: tuple[float, float, float, float]
    gap_m: tuple[float, float] = (0.0, 0.0)
    has_height: bool = True

    @property
    def capabilities(self) -> frozenset[str]:
        """The capabilities that its channels allow."""
        flags = ("imu", "gnss", "response")
        return frozenset(name for name in flags if getattr(self.scenario, name))

    def takes(self, pipeline: str) -> bool:
        """Return whether ``pipeline`` has all its channels."""
        needed = frozenset(floatref.pipeline_capabilities(pipeline))
        return needed <= self.capabilities and (self.has_height or "response" in needed)


def _drive(manoeuvre: str, **numbers: float) -> Scenario:
    return replace(BASE, manoeuvre=manoeuvre, **numbers)


RECORDINGS: Mapping[str, Whole] = {
    "stop": Whole(
        _drive(
            "stop",
            speed_kmh=45.0,
            event_at_m=120.0,
            dwell_s=4.0,
            final_speed_kmh=35.0,
            length_m=220.0,
        ),
        (60.0, 115.0, 125.0, 180.0),
    ),
    "brake": Whole(
        _drive(
            "braking", deceleration_g=0.35, event_speed_kmh=25.0, event_at_m=140.0, length_m=240.0
        ),
        (60.0, 110.0, 140.0, 200.0),
    ),
    "crawl": Whole(
        _drive("creeping", speed_kmh=3.0, event_speed_kmh=9.0, length_m=60.0),
        (15.0, 25.0, 35.0, 45.0),
    ),
    "drop-out": Whole(
        replace(_drive("constant", speed_kmh=60.0, length_m=240.0), response=True),
        (60.0, 97.0, 110.0, 200.0),
        gap_m=(90.0, 104.0),
    ),
    "bends": Whole(
        _drive(
            "constant",
            speed_kmh=50.0,
            length_m=240.0,
            curvature_per_km=12.0,
            grade_percent=5.0,
            cross_slope_percent=4.0,
            crown_mm=60.0,
            crown_at_m=120.0,
        ),
        (60.0, 110.0, 120.0, 200.0),
    ),
    "response": Whole(
        replace(
            _drive("constant", speed_kmh=60.0, length_m=240.0),
            vehicle="minivan",
            imu=False,
            gnss=False,
            response=True,
        ),
        (60.0, 100.0, 150.0, 200.0),
        has_height=False,
    ),
}


@cache
def record(name: str) -> Recording:
    """Return the recording ``name`` as its sensors and its gap leave it."""
    whole = RECORDINGS[name]
    recording = simulate(whole.scenario).recording
    channels = recording.channels
    if not whole.has_height:
        channels = tuple(each for each in channels if each.id.name != "height")
    distance = recording.channel("distance")
    cut = (_cut(c, distance, whole.gap_m) if _is_cut(c) else c for c in channels)
    return Recording(tuple(cut), recording.setup)


def _is_cut(channel: Channel) -> bool:
    return (channel.id.name, channel.id.track) == ("height", "left")


def _cut(channel: Channel, distance: Channel, gap_m: tuple[float, float]) -> Channel:
    """Return ``channel`` without its samples between two places in m."""
    times = channel.clock.times(channel.values.size)
    place = np.interp(times, distance.clock.times(distance.values.size), distance.values)
    gap = (place >= gap_m[0]) & (place < gap_m[1])
    return replace(channel, values=np.where(gap, nan, channel.values))


def measure(profile: Profile, at_m: Collection[float]) -> Row:
    """Return the numbers of ``profile`` in the order of `NAMES`; elevations and sigma of the left.

    NaN for what it does not have.
    """
    left = profile["left"]
    every = np.concatenate([track.elevation for track in profile.tracks]) * 1e3
    finite = every[np.isfinite(every)]
    sigma = np.empty(0) if left.sigma is None else left.sigma[np.isfinite(left.sigma)] * 1e3
    invalid = sum(int((~track.valid).sum()) for track in profile.tracks)
    places = [round((x - profile.start_m) / profile.interval_m) for x in at_m]
    return (
        *(track.valid_m_per_km for track in profile_iri(profile).tracks),
        float(np.sqrt(np.mean(finite**2))) if finite.size else nan,
        float(np.abs(finite).max()) if finite.size else nan,
        invalid * profile.interval_m,
        float(sigma.mean()) if sigma.size else nan,
        *(float(1e3 * left.elevation[k]) if k < left.elevation.size else nan for k in places),
    )
