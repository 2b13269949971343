"""What every test needs: a cache of its own, time enough, and signals that arrive; a white road."""

import signal
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from floatref.measures import high_pass
from floatref.values.profile import Profile, ProfileTrack

FINE_M = 0.005
SECTION_M = 160.9
BEGINS_M = 60.0

# Timing never decides a test: a loaded machine takes as long as it takes. Every run draws anew.
patient = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
# Where a test states no number of its own: a few for every change, many for the night.
settings.register_profile("floatref", patient, max_examples=30)
settings.register_profile("floatref-nightly", patient, max_examples=200)
settings.load_profile("floatref")


def pytest_collection_modifyitems(items):
    """Leave out, on Windows, the tests that say they need more."""
    if sys.platform != "win32":
        return
    for item in items:
        if item.get_closest_marker("posix"):
            item.add_marker(pytest.mark.skip(reason="needs what Windows lacks: see the test"))


@pytest.fixture(scope="session", autouse=True)
def cache_of_its_own(tmp_path_factory):
    """Keep simulated recordings in a folder of the session, in this and every other process."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("FLOATREF_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session", autouse=True)
def interruptions_arrive():
    """Let SIGINT reach the tests and what they start; in the background, shells have it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@dataclass(frozen=True)
class WhiteRoad:
    """Elevation of two wheel paths every `FINE_M`, the section `BEGINS_M` from its beginning."""

    left: np.ndarray
    right: np.ndarray

    def reference(self, interval_m=0.025, length_m=SECTION_M):
        """The section as surveyed: unfiltered, with its hills."""
        at = np.arange(0.0, length_m, interval_m)
        hills = 100.0 + 3.0 * np.sin(at / 150.0)
        return self._profile(BEGINS_M + at, interval_m, 0.0, lambda z: z + hills)

    def run(
        self,
        start_m=0.0,
        length_m=SECTION_M + 1.0,
        interval_m=0.04,
        scale=1.0,
        gain=1.0,
        noise=0.0,
        seed=0,
    ):
        """A run from ``start_m`` of the section on, starting at 0: high-passed, with errors.

        ``noise`` is that of slope, in its share of the road's.
        """
        rng = np.random.default_rng(seed)
        at = np.arange(0.0, length_m * scale, interval_m) / scale

        def measured(z):
            slopes = rng.standard_normal(z.size) * noise * 1e-3 / np.sqrt(interval_m)
            return high_pass(gain * (z + np.cumsum(slopes) * interval_m), interval_m)

        return self._profile(BEGINS_M + start_m + at, interval_m, 0.0, measured)

    def _profile(self, at, interval_m, start_m, measured):
        fine = FINE_M * np.arange(self.left.size)
        tracks = tuple(
            ProfileTrack.of(name, measured(np.interp(at, fine, z)))
            for name, z in (("left", self.left), ("right", self.right))
        )
        return Profile(interval_m, tracks, start_m)


def road_of(seed, length_m=700.0):
    """Return a road of white slope, 1e-3 per root of wave number, but for waves below 0.5 m."""
    rng = np.random.default_rng(seed)
    count = int(length_m / FINE_M)
    wave_number = np.fft.rfftfreq(count, FINE_M)
    smoothing = 1.0 / (1.0 + np.square(0.3 * wave_number))
    slopes = rng.standard_normal((2, count)) * 1e-3 / np.sqrt(FINE_M)
    slopes = np.fft.irfft(np.fft.rfft(slopes) * smoothing, count)
    return WhiteRoad(*(np.cumsum(slopes, axis=1) * FINE_M))


def with_tracks(profile, change):
    """Return ``profile`` with the name and elevation of every track as ``change`` gives them."""
    tracks = [change(t.name, t.elevation) for t in profile.tracks]
    return replace(profile, tracks=tuple(ProfileTrack.of(*t) for t in tracks))


@pytest.fixture(scope="session")
def road():
    return road_of(7)


@pytest.fixture(scope="session")
def roads():
    return road_of


@pytest.fixture(scope="session")
def changed():
    return with_tracks
