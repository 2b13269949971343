"""Points of a drawn road as a stream gives them, and a run that is shown."""

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from floatref.live.points import LivePoints, State
from floatref.values.profile import Profile, ProfileTrack


def make_profile(seed, length_m=1200.0, interval_m=0.1, names=("left",), first=0, sigma=True):
    """Return a profile with stretches that are not valid, from point ``first`` on."""
    rng = np.random.default_rng(seed)
    count = round(length_m / interval_m)
    tracks = []
    for name in names:
        z = np.cumsum(rng.normal(0.0, 2e-3 * np.sqrt(interval_m), count))
        valid = np.ones(count, np.bool_)
        for _ in range(rng.integers(0, 6)):
            low = int(rng.integers(0, count))
            valid[low : low + round(rng.exponential(30.0) / interval_m)] = False
        z = z + 5.0 * ~valid
        known = rng.uniform(1e-4, 3e-3) * np.linspace(1.0, 2.0, count) if sigma else None
        tracks.append(ProfileTrack.of(name, z, valid, known))
    return Profile(interval_m, tuple(tracks), start_m=first * interval_m)


def in_points(profile, seed, state=State.FINAL, most_m=700.0, events=()):
    """Return ``profile`` as points in drawn pieces."""
    rng = np.random.default_rng(seed)
    count, first = profile.tracks[0].elevation.size, round(profile.start_m / profile.interval_m)
    most = max(round(most_m / profile.interval_m), 2)
    cuts = [0]
    while cuts[-1] < count:
        cuts.append(min(cuts[-1] + int(rng.integers(1, most)), count))
    return [
        LivePoints(first + a, profile.interval_m, cut(profile, a, b), state, "test", events)
        for a, b in pairwise(cuts)
    ]


def cut(profile, low, high):
    return tuple(
        ProfileTrack(
            t.name,
            t.elevation[low:high],
            t.valid[low:high],
            None if t.sigma is None else t.sigma[low:high],
        )
        for t in profile.tracks
    )


@pytest.fixture(scope="session")
def made():
    """Return what makes profiles and points, by name."""
    return SimpleNamespace(profile=make_profile, points=in_points, cut=cut)
