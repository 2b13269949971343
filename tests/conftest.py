"""What every test needs: a cache of its own, time enough, and signals that arrive."""

import signal

import pytest
from hypothesis import HealthCheck, settings

# Timing never decides a test: a loaded machine takes as long as it takes. Every run draws anew.
settings.register_profile(
    "floatref", settings(), deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("floatref")


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
