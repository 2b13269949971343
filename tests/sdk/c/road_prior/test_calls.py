"""Splits, copies and refusals of the road-prior smoother, as of every object of the library."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

laws = settings(max_examples=8, deadline=None)
RATE, LENGTH = 100.0, 1500
SETTINGS = {"lag_s": 1.5, "node_rate_hz": 50.0, "missing": 1}
SEEDS = st.integers(0, 2**32 - 1)


def drawn(drives, seed, uncounted=9):
    """Return 15 s with a stop, some samples of all sensors missing."""
    v = drives.speeds(LENGTH / RATE, RATE, 9.0, 5.0, 3.0)
    drive, rng = drives.heaving(RATE, drives.travelled(v, RATE), seed), np.random.default_rng(seed)
    for x in (drive.a, drive.h):
        x[rng.integers(1, LENGTH, 9)] = np.nan
    drive.counts[rng.integers(1, LENGTH, uncounted)] = -(2**63)
    return drive


def bits(points):
    return b"".join(x.tobytes() for x in vars(points).values())


@pytest.mark.parametrize("interval_m", [0.05, 0.25])
@laws
@given(seed=SEEDS, cuts=st.lists(st.integers(0, LENGTH), max_size=6))
def test_any_split_gives_the_same_bits(drives, smoothed, interval_m, seed, cuts):
    drive = drawn(drives, seed)
    whole = smoothed(drive, interval_m, **SETTINGS)
    assert bits(smoothed(drive, interval_m, cuts, **SETTINGS)) == bits(whole)
    assert whole.flags.size > 200


@pytest.mark.slow
def test_sample_by_sample_gives_the_same_bits(drives, smoothed):
    drive = drawn(drives, 1)
    whole = smoothed(drive, **SETTINGS)
    assert bits(smoothed(drive, cuts=range(1, LENGTH), **SETTINGS)) == bits(whole)


@laws
@given(seed=SEEDS, cut=st.integers(0, LENGTH))
def test_a_copy_of_the_memory_goes_on_alike(drives, road, seed, cut):
    drive = drawn(drives, seed)
    made, other = road(drive, **SETTINGS), road(drive, **SETTINGS)
    made.push(drive, 0, cut)
    other.made = made.made.copy()
    expected = bits(made.push(drive, cut)) + bits(made.take("finish"))
    made.made.memory[:] = 0
    assert bits(other.push(drive, cut)) + bits(other.take("finish")) == expected


def refused(made, name, call, *inputs, **options):
    """Check that a call is refused with status ``name`` and has changed nothing."""
    before = made.made.memory.copy()
    status, points = made.call(call, *inputs, **options)
    assert status == name
    assert (made.made.memory == before).all()
    assert np.isnan(points.elevation).all()
    assert (points.flags == 99).all()


def test_bad_samples_are_refused_and_change_nothing(drives, road):
    drive = drives.heaving(RATE, drives.travelled(np.full(400, 9.0), RATE))
    made = road(drive, **{**SETTINGS, "missing": 0})
    made.push(drive, 0, 200)
    rest = [x[200:] for x in (drive.a, drive.h, drive.counts)]
    for place in (0, 1):
        for value in (np.nan, np.inf, -1.1e6):
            bad = [x.copy() for x in rest]
            bad[place][7] = value
            refused(made, "FR_BAD_SAMPLE", "push", *bad)
    back = [*rest[:2], rest[2] - 10_000]
    refused(made, "FR_GOES_BACK", "push", *back)
    refused(made, "FR_BAD_SAMPLE", "push", *rest[:2], rest[2] + 2**51)
    for share in (-0.1, 1.1, np.nan):
        for shares in ((np.full(200, share), None), (None, np.full(200, share))):
            refused(made, "FR_BAD_SAMPLE", "push_levelled", *rest, *shares)
    made.take("push", *rest)


def test_a_leap_of_the_encoder_that_no_lag_holds_is_refused(drives, road):
    """Four times the points of half a lag at the fastest speed are held."""
    drive = drives.heaving(RATE, drives.travelled(np.full(400, 9.0), RATE))
    made = road(drive, **SETTINGS)
    made.push(drive, 0, 200)
    rest = [x[200:] for x in (drive.a, drive.h, drive.counts)]
    held_m = 4 * 0.5 * SETTINGS["lag_s"] * 30.0
    refused(made, "FR_BAD_SAMPLE", "push", *rest[:2], rest[2] + round(held_m / drives.count_m))
    # 18 m have not come out by then, and 4 m more come before a section does.
    leap = round((held_m - 30.0) / drives.count_m)
    made.take("push", *rest[:2], rest[2] + leap)
    made.take("finish")


def test_without_room_the_call_says_how_much_it_needs(drives, road):
    drive = drawn(drives, 2)
    made = road(drive, **SETTINGS)
    signals = drive.a, drive.h, drive.counts
    refused(made, "FR_OUTPUT_FULL", "push", *signals, room=3)
    needed = made.written
    status, points = made.call("push", *signals, room=needed)
    assert (status, points.flags.size) == ("FR_OK", needed)
    refused(made, "FR_OUTPUT_FULL", "finish", room=1)
    status, rest = made.call("finish", room=made.written)
    assert status == "FR_OK"
    assert points.flags.size + rest.flags.size == drive.at_points(0.25).size
    refused(made, "FR_WRONG_ORDER", "push", *signals)
    refused(made, "FR_WRONG_ORDER", "finish")


def test_null_pointers_are_refused(drives, road):
    drive = drawn(drives, 3, uncounted=0)
    made, ffi = road(drive, **SETTINGS), road(drive).library.ffi
    arrays = [made.library.array(x) for x in (drive.a, drive.h, drive.counts)]
    made.push(drive, 0, 1000)
    results, flags = np.empty((2, 9999)), np.empty(9999, np.uint8)
    pointers = [
        *map(made.library.at, arrays),
        LENGTH,
        *map(made.library.at, results),
        ffi.from_buffer("uint8_t[]", flags),
        9999,
        ffi.new("size_t *"),
    ]
    arrays[2] += drive.counts[-1]
    before = made.made.memory.copy()
    for place in (0, 1, 2, 4, 5, 6, 8):
        arguments = [ffi.NULL if k == place else value for k, value in enumerate(pointers)]
        assert made.library.status[made.made.call("push", *arguments)] == "FR_NULL_POINTER"
    assert (made.made.memory == before).all()


@pytest.mark.parametrize("count", [0, 1, 2, 30])
def test_a_run_of_a_few_samples_ends(drives, road, count):
    drive = drives.heaving(RATE, drives.travelled(np.full(40, 9.0), RATE))
    made = road(drive, **SETTINGS)
    made.push(drive, 0, count)
    points = made.take("finish")
    assert points.flags.size == (drive.at_points(0.25) < count).sum()
    assert np.isfinite([points.elevation, points.sigma]).all()


def test_the_first_height_is_never_missing(drives, road):
    drive = drives.heaving(100.0, drives.travelled(np.full(400, 9.0), 100.0), 3)
    drive.h[0] = np.nan
    made = road(drive, lag_s=4.0, missing=1)
    before = made.made.memory.copy()
    status, _ = made.call("push", drive.a, drive.h, drive.counts)
    assert status == "FR_BAD_SAMPLE"
    assert (made.made.memory == before).all()
    made.push(drive, 1)
