"""Counts that are missing: the way across them is no travel of the vehicle, as in the SDK."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

laws = settings(max_examples=8, deadline=None)
RATE, INTERVAL_M, SECONDS = 100.0, 0.25, 14
NO_COUNT = -(2**63)
LEAP_COUNTS = 2**18
"""4 m."""


def drawn(drives, seed, stops=False, rate=RATE):
    """Return 14 s with or without a stop."""
    v = drives.speeds(SECONDS, rate, 9.0, 7.0 if stops else 1e3, 2.0)
    return drives.heaving(rate, drives.travelled(v, rate), seed)


def leaping(drive, first, behind, by=LEAP_COUNTS):
    """Return ``drive`` with counts that leap, and that with those missing before they do."""
    leapt = np.array(drive.counts)
    leapt[behind:] += by
    known = np.array(leapt)
    known[first:behind] = NO_COUNT
    return replace(drive, counts=leapt), replace(drive, counts=known)


def apart(drive, first, behind):
    """Return which points lie on no way that is not known."""
    places = np.arange(drive.at_points(INTERVAL_M).size) * INTERVAL_M
    return (places <= drive.distance[first - 1]) | (places >= drive.distance[behind])


@laws
@given(
    seed=st.integers(0, 2**32 - 1),
    at_s=st.floats(0.1, SECONDS - 1.0),
    length=st.integers(1, 60),
    by=st.sampled_from([0, LEAP_COUNTS, -LEAP_COUNTS // 64]),
    rate=st.sampled_from([100.0, 1500.0]),
    stops=st.booleans(),
)
@example(seed=1, at_s=7.99, length=2, by=LEAP_COUNTS, rate=1500.0, stops=False)
@example(seed=0, at_s=7.0, length=1, by=-4096, rate=1500.0, stops=False)
@example(seed=1, at_s=7.2, length=40, by=0, rate=100.0, stops=True)
def test_a_leap_is_as_the_sdk_has_it(drives, smoothed, of_sdk, seed, at_s, length, by, rate, stops):
    first = round(at_s * rate)
    behind = first + length
    leapt, known = leaping(drawn(drives, seed, stops, rate), first, behind, by)
    options = {"lag_s": drives.whole, "missing": 1, "back": 1}
    made = smoothed(known, INTERVAL_M, **options)
    sdk = of_sdk(leapt, INTERVAL_M, lost=slice(first, behind))
    there = apart(leapt, first, behind)[: made.elevation.size]
    atol = 1e-7 * np.abs(leapt.h).max()
    np.testing.assert_allclose(
        made.elevation[there], sdk.elevation[: there.size][there], rtol=0, atol=atol
    )
    assert made.elevation.size >= sdk.elevation.size - 1


def test_a_leap_that_is_known_tells_nothing_of_the_road(drives, smoothed):
    """It hardly changes the 1-sigma 40 m before; taken as travel, it is a brake."""
    drive, options = drawn(drives, 4), {"lag_s": drives.whole, "missing": 1}
    leapt, known = leaping(drive, 900, 902)
    plain, left_out, taken = (
        smoothed(d, INTERVAL_M, **options).sigma[: round(40 / INTERVAL_M)]
        for d in (drive, known, leapt)
    )
    assert np.max(left_out / plain) < 1.3
    assert np.max(taken / plain) > 2.0


def test_points_across_missing_counts_are_flagged(drives, smoothed):
    leapt, known = leaping(drawn(drives, 5), 900, 902)
    flags = smoothed(known, INTERVAL_M, lag_s=4.0, missing=1).flags
    first = int(np.ceil(leapt.distance[899] / INTERVAL_M))
    assert (flags & 1).nonzero()[0].tolist() == [first]


@pytest.mark.parametrize(("place", "missing"), [(0, 1), (5, 0)])
def test_the_first_count_is_never_missing_nor_any_where_none_is_bridged(
    drives, road, place, missing
):
    drive = drawn(drives, 6)
    drive.counts[place] = NO_COUNT
    made = road(drive, INTERVAL_M, lag_s=4.0, missing=missing)
    before = made.made.memory.copy()
    status, _ = made.call("push", drive.a, drive.h, drive.counts)
    assert status == "FR_BAD_SAMPLE"
    assert (made.made.memory == before).all()
