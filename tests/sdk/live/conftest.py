"""Drives of a few kilometres at low rates, whose samples can come in any pieces."""

from collections.abc import Iterator

import numpy as np
import pytest

from floatref.values.channels import STANDARD_GRAVITY
from floatref.values.clock import StampedClock, UniformClock
from floatref.values.recording import Channel, Recording, Setup

STEP_S = 0.01
CHANGE = 1.5
"""Acceleration and braking in m/s²."""
BOUNCE_M, BOUNCE_HZ = 0.01, 1.3
INTERVAL_M = 0.1


def travel(legs):
    """Return times in s and distances in m of a vehicle that takes these speeds for these times."""
    wanted = np.concatenate([np.full(round(s / STEP_S), v) for v, s in legs])
    speed = np.empty(wanted.size)
    now = wanted[0]
    for k, target in enumerate(wanted):
        now = min(max(target, now - CHANGE * STEP_S), now + CHANGE * STEP_S)
        speed[k] = now
    return STEP_S * np.arange(wanted.size), np.cumsum(speed) * STEP_S


def road(x, seed=0):
    """Return a road of waves of 3 to 60 m at places ``x`` in m, in m."""
    rng = np.random.default_rng(seed)
    lengths = np.geomspace(3.0, 60.0, 12)
    phases = rng.uniform(0.0, 2.0 * np.pi, lengths.size)
    return sum(
        2e-4 * w**0.8 * np.sin(2.0 * np.pi * x / w + p)
        for w, p in zip(lengths, phases, strict=True)
    )


def make_drive(
    legs,
    rate_hz=200.0,
    tracks=("left",),
    start_s=0.0,
    height_hz=None,
    distance="rate",
    count_m=0.0,
    at_m=0.0,
):
    """Return a recording: a body that bounces over `road`, and exact sensors.

    ``distance`` is "rate", or "times" for a sample at every ten centimetres, with its time.
    """
    times, places = travel(legs)
    end_s = times[-1]

    def at(rate):
        own = np.arange(0.0, end_s, 1.0 / rate)
        return own, np.interp(own, times, places)

    force_s, _ = at(rate_hz)
    height_s, height_m = at(height_hz or rate_hz)
    clock, slower = (UniformClock.of(r, start_s) for r in (rate_hz, height_hz or rate_hz))
    channels = []
    for n, track in enumerate(tracks):
        # The bounce begins at rest; that of two wheel paths differs.
        omega = 2.0 * np.pi * (BOUNCE_HZ + 0.2 * n)
        force = STANDARD_GRAVITY + BOUNCE_M * omega**2 * np.cos(omega * force_s)
        height = 0.3 + BOUNCE_M * (1.0 - np.cos(omega * height_s)) - road(height_m, n)
        channels.append(Channel.of("vertical_specific_force", force, clock, track))
        channels.append(Channel.of("height", height, slower, track))
    if distance == "times":
        marks = np.arange(0.0, places[-1], 0.1)
        stamps = start_s + np.interp(marks, places, times)
        stamps = np.maximum.accumulate(stamps + 1e-9 * np.arange(marks.size))
        channels.append(Channel.of("distance", at_m + marks, StampedClock.of(stamps)))
    else:
        _, where = at(rate_hz)
        where = count_m * np.floor(where / count_m) if count_m else where
        channels.append(Channel.of("distance", at_m + where, clock))
    return Recording(tuple(channels), Setup(profile_interval_m=INTERVAL_M))


def in_pieces(recording, seed, most_s=3.0, lateness_s=0.0) -> Iterator[dict]:
    """Yield the samples of ``recording`` in drawn pieces.

    Behind each of them every channel is at most ``lateness_s`` behind the others, drawn anew.
    """
    rng = np.random.default_rng(seed)
    now_s = min(c.span_s[0] for c in recording.channels)
    end_s = max(c.span_s[1] for c in recording.channels) + lateness_s
    done = dict.fromkeys((c.id for c in recording.channels), 0)
    times = {c.id: c.times_s for c in recording.channels}
    while now_s <= end_s:
        now_s += rng.uniform(0.01, most_s)
        found = {}
        for channel in recording.channels:
            until_s = now_s - rng.uniform(0.0, lateness_s) if now_s <= end_s else np.inf
            piece = _take(channel, times[channel.id], done, until_s)
            if piece is not None:
                found[str(channel.id)] = piece
        yield found


def _take(channel, times, done, until_s):
    first, end = done[channel.id], int(np.searchsorted(times, until_s))
    if end <= first:
        return None
    done[channel.id] = end
    values = channel.values[first:end]
    return (times[first:end], values) if isinstance(channel.clock, StampedClock) else values


def assert_same(one, other):
    """Assert that two profiles are equal bit for bit."""
    assert (one.interval_m, one.start_m) == (other.interval_m, other.start_m)
    for a, b in zip(one.tracks, other.tracks, strict=True):
        np.testing.assert_array_equal(a.elevation, b.elevation)
        np.testing.assert_array_equal(a.valid, b.valid)
        if a.sigma is not None or b.sigma is not None:
            np.testing.assert_array_equal(a.sigma, b.sigma)


@pytest.fixture(scope="session")
def drive():
    return make_drive


@pytest.fixture(scope="session")
def pieces():
    return in_pieces


@pytest.fixture(scope="session")
def same():
    return assert_same


@pytest.fixture(scope="module", autouse=True)
def cold():
    """Start streams without the drive that loads kernels: tests replace parts of what it runs."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("floatref.live.stream.warm", lambda order, provisional: None)
        yield
