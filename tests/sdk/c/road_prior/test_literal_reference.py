"""C, SDK and reference make the same of drawn drives: whole, and part by part."""

from math import ceil

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from tests.sdk.estimators.road_prior.literal_constants import literal_constants

from floatref.estimators.road_prior import RoadPrior
from floatref_reference.road_prior.encoder import inputs
from floatref_reference.road_prior.fixed_lag import fixed_lag
from floatref_reference.road_prior.lag_sections import Sections, divide
from floatref_reference.road_prior.symbols import recorded

INTERVAL_M = 0.5
SETTINGS = {
    "acceleration": 2e-3,
    "walk_along": 5e-3,
    "reading_m": 1e-3,
    "road_m": 1e-5,
    "long_waves_per_m": 3e-6,
    "road_memory_m": 1e15,
    "edge_sigmas": 1e6,
}
"""The reference's road is the same all the way, and it has no edges."""
IN_SDK = {"road_m": "road", "long_waves_per_m": "long_waves"}
BOUND = 1e-7
"""Of the largest height: rounding of covariances with condition numbers of 1e8 and more, in three
orders of operations; the reference in double differs by as much from itself in more digits."""
laws = settings(deadline=None, max_examples=6, phases=[Phase.explicit, Phase.generate])


def literally(drive, sections):
    """Return the height by the reference, shape (n,)."""
    c = RoadPrior(**{IN_SDK.get(name, name): x for name, x in SETTINGS.items()})
    u_1, u_2 = inputs(drive.distance, 1 / drive.rate)
    constants = literal_constants(c, (c.lean_sigma_rad, c.tilt_sigma))
    times, h = np.arange(drive.a.size) / drive.rate, drive.h - drive.h[0]
    run = recorded(times, drive.distance, drive.a, h, np.stack((u_1, u_2), axis=-1), u_1)
    return fixed_lag(run, constants, sections) + drive.h[0]


def drawn(drives, seed, rate, seconds, stop, missing):
    v = drives.speeds(seconds, rate, 9.0, *stop)
    drive = drives.heaving(rate, drives.travelled(v, rate), seed, noise=0.01)
    rng = np.random.default_rng(seed)
    drive.h[1:][rng.uniform(size=drive.h.size - 1) < missing] = np.nan
    return drive


SEEDS = st.integers(0, 2**32 - 1)
STOPS = st.tuples(st.floats(1.0, 2.0), st.floats(0.1, 1.0))


@pytest.mark.slow
@laws
@given(seed=SEEDS, rate=st.sampled_from([80, 150, 300]), stop=STOPS, missing=st.floats(0.0, 0.6))
def test_whole_runs_agree(drives, smoothed, of_sdk, seed, rate, stop, missing):
    drive = drawn(drives, seed, rate, 3.9, stop, missing)
    at, c = drive.at_points(INTERVAL_M), {IN_SDK.get(n, n): x for n, x in SETTINGS.items()}
    made = smoothed(drive, INTERVAL_M, lag_s=drives.whole, missing=1, **SETTINGS)
    sdk = of_sdk(drive, INTERVAL_M, RoadPrior(**c))
    reference = (literally(drive, Sections([], [False] * drive.a.size)) - drive.h)[at]
    seen = ~np.isnan(drive.h[at])
    atol = BOUND * np.nanmax(np.abs(drive.h))
    np.testing.assert_allclose(made.elevation[seen], reference[seen], rtol=0, atol=atol)
    np.testing.assert_allclose(made.elevation[seen], sdk.elevation[seen], rtol=0, atol=atol)


@laws
@given(seed=SEEDS, rate=st.sampled_from([60, 100]), stop=STOPS, lag_s=st.floats(0.8, 2.5))
def test_parts_and_their_joints_agree(drives, smoothed, seed, rate, stop, lag_s):
    """Short of the first four seconds, so that lean and tilt do not begin anew."""
    drive = drawn(drives, seed, rate, 7.9, (stop[0] + 1.0, stop[1]), 0.0)
    at = drive.at_points(INTERVAL_M)
    reached = np.searchsorted(at, np.arange(drive.a.size))
    reach = max(1, round(0.12 * rate))
    sections = divide(reached, max(ceil(0.5 * lag_s * rate), reach + 8), max(4, ceil(0.25 * rate)))
    made = smoothed(drive, INTERVAL_M, lag_s=lag_s, **SETTINGS)
    expected = (literally(drive, sections) - drive.h)[at]
    assert len(sections.ends) > 2
    atol = BOUND * np.abs(drive.h).max()
    np.testing.assert_allclose(made.elevation, expected, rtol=0, atol=atol)
