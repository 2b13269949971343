"""Behind a stage that levels the acceleration, the smoother is that of the SDK."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

laws = settings(max_examples=6, deadline=None)
RATE, INTERVAL_M = 100.0, 0.25


def stopping(drives, seed):
    v = drives.speeds(14.0, RATE, 9.0, 5.0, 2.0)
    return drives.heaving(RATE, drives.travelled(v, RATE), seed)


@laws
@given(
    seed=st.integers(0, 2**32 - 1), nodes_hz=st.sampled_from([100.0, 25.0]), names=st.integers(0, 3)
)
def test_shares_are_taken_as_the_sdk_takes_them(drives, road, of_sdk, seed, nodes_hz, names):
    drive, rng = stopping(drives, seed), np.random.default_rng(seed)
    shares = {"levelled": None, "missing": None}
    if names & 1:
        shares["levelled"] = np.clip(np.cumsum(rng.normal(0.0, 0.05, drive.a.size)), 0.0, 1.0)
    if names & 2:
        shares["missing"] = (rng.uniform(size=drive.a.size) < 0.1) * rng.uniform(size=drive.a.size)
    made = road(drive, INTERVAL_M, lag_s=drives.whole)
    made.take("push_levelled", drive.a, drive.h, drive.counts, *shares.values())
    given_shares = {name: x for name, x in shares.items() if x is not None}
    sdk = of_sdk(drive, INTERVAL_M, **given_shares)
    atol = 1e-7 * np.abs(drive.h).max()
    np.testing.assert_allclose(made.take("finish").elevation, sdk.elevation, rtol=0, atol=atol)


def test_levelling_changes_what_a_brake_is_taken_for(drives, road):
    drive = stopping(drives, 1)
    found = []
    for share in (0.0, 1.0):
        made = road(drive, INTERVAL_M, lag_s=drives.whole)
        levelled = np.full(drive.a.size, share)
        made.take("push_levelled", drive.a, drive.h, drive.counts, levelled, None)
        found.append(made.take("finish"))
    assert np.median(found[1].sigma) < 0.9 * np.median(found[0].sigma)


@pytest.mark.parametrize("call", ["push", "push_levelled"])
def test_shares_of_zero_are_no_shares(drives, road, call):
    drive = stopping(drives, 2)
    made, shares = road(drive, INTERVAL_M, lag_s=2.0), [np.zeros(drive.a.size)] * 2
    extra = shares if call == "push_levelled" else []
    points = made.take(call, drive.a, drive.h, drive.counts, *extra)
    expected = road(drive, INTERVAL_M, lag_s=2.0).push(drive)
    assert (points.elevation == expected.elevation).all()
