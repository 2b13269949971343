"""What every test needs: a cache of its own."""

import pytest


@pytest.fixture(scope="session", autouse=True)
def cache_of_its_own(tmp_path_factory):
    """Keep simulated recordings in a folder of the session, in this and every other process."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("FLOATREF_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield
