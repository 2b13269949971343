"""What happened on a run: stops, slow travel, hard braking, and where samples are missing."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from floatref.stages.marks import SLOW_MPS
from floatref.values.arrays import BoolArray, FloatArray, IndexArray
from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.profile import Profile
from floatref.values.recording import Channel, Recording
from floatref.values.scanning import chunks
from floatref.viewer.journey import Journey

STOP_MPS, STOP_S = 0.05, 0.5
"""Below this speed in m/s for this time in s the vehicle stands."""
HARD_G = 0.16
"""Braking up to this many g rarely raised the roughness (section 3.3.1.3)."""
BRAKING_S = 1.0
"""Time in s over which a deceleration is taken."""
SHORTEST_S = 0.1
"""Shortest time in s of missing samples that is an event."""
ROUNDING_S = 1e-6
"""A time in s that the difference of two times of an epoch may be off."""
MOST_PLACES = 100_000
"""Places at which a recorded speed is compared with a limit."""
MOST = 200
"""Most events of one kind; the longest are kept."""


class Event(NamedTuple):
    """From ``begin`` to ``end``, in s or in m by ``domain``, with what a table says of it."""

    begin: float
    end: float
    kind: str
    detail: str
    domain: str = "time"


def events_of_journey(journey: Journey) -> list[Event]:
    """Return stops, slow travel and hard braking of ``journey``, with times in s, in order."""
    times, speed = journey.times_s, journey.speed_over(STOP_S)
    stops = [
        Event(begin, end, "stop", f"{end - begin:.1f} s")
        for begin, end in _spans(times, speed < STOP_MPS)
        if end - begin >= STOP_S
    ]
    slow = [
        Event(begin, end, "slow", f"below {3.6 * SLOW_MPS:.0f} km/h for {end - begin:.1f} s")
        for begin, end in _spans(times, speed < SLOW_MPS)
        if end - begin >= STOP_S
    ]
    return sorted([*_longest(stops), *_longest(slow), *_braking(journey)])


def missing_samples(channel: Channel) -> list[Event]:
    """Return where samples of ``channel`` are missing for `SHORTEST_S` or longer, in order.

    Times are those of the channel, in s.
    """
    found = [
        Event(begin, end, "missing", f"{channel.id}, {end - begin:.2f} s")
        for begin, end in _missing(channel)
        if end - begin >= SHORTEST_S - ROUNDING_S
    ]
    return sorted(_longest(found))


def events_of_recording(
    recording: Recording, journey: Journey | None, origin_s: float
) -> list[Event]:
    """Return all events of ``recording``, with times in s after ``origin_s``, in order."""
    travelled = [] if journey is None else events_of_journey(journey)
    missing = [event for channel in recording.channels for event in missing_samples(channel)]
    late = [e._replace(begin=e.begin - origin_s, end=e.end - origin_s) for e in _longest(missing)]
    return sorted([*travelled, *late])


def invalid_stretches(profile: Profile, name: str) -> list[Event]:
    """Return the stretches of the profile called ``name`` that are not valid, in m."""
    found = []
    for track in profile.tracks:
        edges = np.flatnonzero(np.diff(~track.valid, prepend=False, append=False)).reshape(-1, 2)
        for first, end in _widest(edges):
            begin = profile.start_m + first * profile.interval_m
            length = (end - 1 - first) * profile.interval_m
            detail = f"{name}, {track.name}, {length:.2f} m"
            found.append(Event(begin, begin + length, "not valid", detail, "distance"))
    return sorted(found)


def slow_stretches(along_m: FloatArray, speed_mps: FloatArray) -> list[Event]:
    """Return where a speed over the distance in m is below that at which pipelines lose waves."""
    dense = np.linspace(along_m[0], along_m[-1], MOST_PLACES)
    along_m, speed_mps = dense, np.interp(dense, along_m, speed_mps)
    return [
        Event(begin, end, "slow", f"below {3.6 * SLOW_MPS:.0f} km/h", "distance")
        for begin, end in _spans(along_m, speed_mps < SLOW_MPS)
    ]


def _braking(journey: Journey) -> list[Event]:
    speed = journey.speed_over(STOP_S)
    half = max(1, round(BRAKING_S / journey.step_s / 2.0))
    if speed.size <= 2 * half:
        return []
    lost_mps2 = (speed[: -2 * half] - speed[2 * half :]) / (2 * half * journey.step_s)
    lost_g = lost_mps2 / STANDARD_GRAVITY
    times = journey.times_s[half:-half]
    found = []
    for begin, end in _spans(times, lost_g > HARD_G):
        most = lost_g[(times >= begin) & (times <= end)].max()
        found.append(Event(begin, end, "braking", f"up to {most:.2f} g"))
    return _longest(found)


def _spans(places: FloatArray, met: BoolArray) -> Iterator[tuple[float, float]]:
    """Yield first and last place of every stretch in which a condition is ``met``."""
    edges = np.flatnonzero(np.diff(met, prepend=False, append=False)).reshape(-1, 2)
    for first, end in edges.tolist():
        yield float(places[first]), float(places[end - 1])


def _missing(channel: Channel) -> Iterator[tuple[float, float]]:
    """Yield the times of the first missing sample of every stretch and of the one behind it."""
    edges: list[int] = []
    before = False
    for first, chunk in chunks(channel.values):
        missing = np.isnan(chunk)
        edges += (first + np.flatnonzero(np.diff(missing, prepend=before))).tolist()
        before = bool(missing[-1])
    if len(edges) % 2:
        edges.append(channel.values.size - 1)
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield float(channel.clock.times(1, begin)[0]), float(channel.clock.times(1, end)[0])


def _longest(events: list[Event]) -> list[Event]:
    return sorted(events, key=lambda event: event.begin - event.end)[:MOST]


def _widest(edges: IndexArray) -> list[tuple[int, int]]:
    order = np.argsort(edges[:, 0] - edges[:, 1], kind="stable")[:MOST]
    return [(int(first), int(end)) for first, end in edges[order]]
