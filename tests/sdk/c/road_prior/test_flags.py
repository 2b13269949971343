"""What the flags of a point say: missing samples, leaps, an uncertain or an unsettled elevation."""

import numpy as np
import pytest

from floatref.measures import high_pass
from floatref.values.arrays import Flag

MISSING, LEAP, UNCERTAIN, UNSETTLED = 1, 2, 4, 8
RATE, INTERVAL_M = 100.0, 0.25


def stopping(drives, seconds=30.0, lasts=5.0, seed=4):
    v = drives.speeds(seconds, RATE, 9.0, 12.0, lasts)
    return drives.heaving(RATE, drives.travelled(v, RATE), seed)


def at_sample(drive, sample):
    """Return the first point that is reached at ``sample`` or later."""
    return int(np.searchsorted(drive.at_points(INTERVAL_M), sample))


def test_points_with_missing_samples_are_flagged_and_no_others(drives, smoothed):
    drive = stopping(drives)
    at = drive.at_points(INTERVAL_M)
    drive.a[700:760] = np.nan
    drive.h[at[400]] = np.nan
    made = smoothed(drive, INTERVAL_M, lag_s=4.0, missing=1)
    lost = np.cumsum(np.isnan(drive.a))[at]
    expected = np.diff(lost, prepend=0) > 0
    expected[400] = True
    assert expected.sum() > 20
    np.testing.assert_array_equal((made.flags & MISSING) > 0, expected)


def test_a_gap_is_as_the_sdk_has_it(drives, smoothed, of_sdk):
    drive = stopping(drives)
    drive.a[700:900] = np.nan
    made = smoothed(drive, INTERVAL_M, lag_s=drives.whole, missing=1)
    sdk = of_sdk(drive, INTERVAL_M)
    atol = 1e-7 * np.abs(drive.h).max()
    np.testing.assert_allclose(made.elevation, sdk.elevation, rtol=0, atol=atol)


def test_an_edge_under_the_laser_is_as_the_sdk_has_it(drives, smoothed, of_sdk):
    """The readings jump by 6 mm for a second of the stop: the road is another one there."""
    drive = stopping(drives)
    drive.h[1350:1450] += 0.006
    made = smoothed(drive, INTERVAL_M, lag_s=drives.whole)
    sdk = of_sdk(drive, INTERVAL_M)
    atol = 1e-7 * np.abs(drive.h).max()
    np.testing.assert_allclose(made.elevation, sdk.elevation, rtol=0, atol=atol)
    deaf = smoothed(drive, INTERVAL_M, lag_s=drives.whole, edge_sigmas=1e6)
    assert np.abs(deaf.elevation - made.elevation).max() > 1e-3


@pytest.mark.parametrize("lag_s", [4.0, 1000.0])
def test_a_leap_at_a_standstill_flags_the_points_on_either_side(drives, smoothed, lag_s):
    drive = stopping(drives)
    leap = 1400
    drive.h[leap:1500] += 0.05
    made = smoothed(drive, INTERVAL_M, lag_s=lag_s)
    behind = at_sample(drive, leap)
    np.testing.assert_array_equal(np.flatnonzero(made.flags & LEAP), [behind - 1, behind])
    drive.h[leap:1500] -= 0.045
    assert not (smoothed(drive, INTERVAL_M, lag_s=lag_s).flags & LEAP).any()


def test_a_large_sigma_is_flagged_as_in_the_sdk(drives, smoothed, of_sdk):
    drive = stopping(drives)
    made, sdk = smoothed(drive, INTERVAL_M, lag_s=drives.whole), of_sdk(drive, INTERVAL_M)
    ours, theirs = (made.flags & UNCERTAIN) > 0, (sdk.flags & Flag.UNCERTAIN) > 0
    assert 0 < theirs.sum() < theirs.size
    # Marks at the ends of the standstill, which the SDK has not, change the 1-sigma about it.
    assert (ours != theirs).mean() < 0.02


def test_what_a_lag_was_too_short_for_is_flagged_and_the_rest_stays(drives, smoothed):
    """Against the whole run, behind the high-pass."""
    drive, tolerance_m = stopping(drives, 120.0), 3e-4
    whole = smoothed(drive, INTERVAL_M, lag_s=drives.whole)
    assert not (whole.flags & UNSETTLED).any()
    flagged = []
    for lag_s in (3.0, 10.0, 30.0, 60.0):
        made = smoothed(drive, INTERVAL_M, lag_s=lag_s, tolerance_m=tolerance_m)
        off = made.elevation - whole.elevation
        filtered = np.abs(high_pass(off - off[0], INTERVAL_M, 91.44))
        settled = (made.flags & UNSETTLED) == 0
        flagged.append(1.0 - settled.mean())
        if lag_s >= 10.0:
            assert filtered[settled].max() < 4.0 * tolerance_m
    assert flagged == sorted(flagged, reverse=True)
    assert flagged[0] > 0.5 > 0.3 > flagged[-1]


def test_with_a_tolerance_of_zero_only_the_end_of_the_run_is_settled(drives, smoothed):
    drive = stopping(drives)
    made = smoothed(drive, INTERVAL_M, lag_s=4.0, tolerance_m=0.0, wavelength_m=20.0)
    unsettled = (made.flags & UNSETTLED) > 0
    last = at_sample(drive, drive.a.size - 1 - 3 * 2.0 * RATE)
    assert unsettled[: last - 40].all()
    assert not unsettled[-10:].any()
