"""A standstill takes no further memory however long it lasts, and no point is lost or cut."""

import numpy as np
import pytest

from floatref.measures import high_pass

RATE, LAG_S, INTERVAL_M, SPEED = 25.0, 8.0, 0.5, 9.0
WAVELENGTH_M = 91.44
THREE_HOURS_S = 60.0 + 84 * 128
"""A whole number of the SDK's segments longer than a minute: marks lie alike on either side."""


def stopping(drives, lasts, seed=1):
    """Return a drive of 30 s and a stop at 12 s, and a sample in the middle of the stop."""
    v = drives.speeds(30.0 + min(lasts, 60.0), RATE, SPEED, 12.0, min(lasts, 60.0))
    drive = drives.heaving(RATE, drives.travelled(v, RATE), seed)
    middle = round((12.0 + min(lasts, 60.0) / 2) * RATE)
    return drive.standing_on(middle, round(lasts - min(lasts, 60.0))), middle


@pytest.mark.parametrize("lasts", [1.0, 60.0, pytest.param(THREE_HOURS_S, id="3h")])
def test_points_before_a_stop_wait_for_what_is_behind_it(drives, road, lasts):
    drive, middle = stopping(drives, lasts)
    made = road(drive, INTERVAL_M, lag_s=LAG_S)
    parts = made.push(drive, 0, middle), made.push(drive, middle), made.take("finish")
    counts = [points.flags.size for points in parts]
    assert sum(counts) == drive.at_points(INTERVAL_M).size
    assert np.isfinite(np.concatenate([points.elevation for points in parts])).all()
    # What was reached in the last moving seconds before the stop has not come out in it.
    reached = (drive.at_points(INTERVAL_M) < 12.0 * RATE).sum()
    latest = (drive.at_points(INTERVAL_M) < (12.0 - LAG_S / 2) * RATE).sum()
    assert counts[0] <= latest < reached


@pytest.mark.parametrize("lasts", [1.0, 60.0])
def test_through_a_stop_it_is_the_sdk_s(drives, smoothed, of_sdk, lasts):
    drive, _ = stopping(drives, lasts)
    made = smoothed(drive, INTERVAL_M, lag_s=drives.whole)
    expected = of_sdk(drive, INTERVAL_M)
    atol = 1e-7 * np.abs(drive.h).max()
    np.testing.assert_allclose(made.elevation, expected.elevation, rtol=0, atol=atol)


@pytest.mark.parametrize("lag_s", [LAG_S, 1000.0])
def test_three_hours_at_a_fixed_mark_leave_the_road_as_a_minute_does(drives, smoothed, lag_s):
    """More readings in between change the elevation by no more than its accuracy."""
    made = [
        smoothed(stopping(drives, lasts)[0], INTERVAL_M, lag_s=lag_s)
        for lasts in (60.0, THREE_HOURS_S)
    ]
    off = made[0].elevation - made[1].elevation
    filtered = high_pass(off - off[0], INTERVAL_M, WAVELENGTH_M)
    assert (np.abs(filtered) < 4.0 * made[0].sigma).all()
    np.testing.assert_allclose(made[0].sigma, made[1].sigma, rtol=0.2)
