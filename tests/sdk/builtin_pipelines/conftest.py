"""What holds of a profile by the road prior."""

from collections.abc import Callable

import numpy as np
import pytest

from floatref.values.profile import Profile, ProfileTrack


@pytest.fixture(scope="session")
def assert_other() -> Callable[[Profile, Profile], None]:
    """Return what checks that elevation, 1-sigma or flags are not those of another profile."""

    def check(one: Profile, other: Profile) -> None:
        (a,), (b,) = one.tracks, other.tracks
        assert a.sigma is not None
        assert b.sigma is not None
        pairs = ((a.elevation, b.elevation), (a.sigma, b.sigma), (a.valid, b.valid))
        assert not all(np.array_equal(x, y) for x, y in pairs)

    return check


@pytest.fixture(scope="session")
def assert_all_known() -> Callable[[Profile], tuple[ProfileTrack, ...]]:
    """Return what checks that all points have elevation and 1-sigma, and some are not valid."""

    def check(profile: Profile) -> tuple[ProfileTrack, ...]:
        (track,) = profile.tracks
        assert track.sigma is not None
        assert np.isfinite(track.elevation).all()
        assert (track.sigma > 0.0).all()
        assert not track.valid.all()
        return profile.tracks

    return check
