"""Readings of GNSS time, however they count, are the receiver's own time."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref.mapping.clocks.epochs import since_zero
from floatref.values.native import Epoch

GPS_ZERO, LEAPS, DAY, WEEK = 315_964_800, 18, 86_400, 604_800
moments = st.integers(1_500_000_000, 2_000_000_000)
"""Unix s from 2017 on, since when GPS time is 18 s ahead."""


def own_zero(utc: int, epoch: Epoch) -> Fraction:
    """Return the whole second ``utc`` as a receiver of ``epoch`` counts it."""
    counts = {Epoch.UTC: utc, Epoch.DAY: utc % DAY, Epoch.GPS: utc - GPS_ZERO + LEAPS}
    return Fraction(counts[epoch])


@pytest.mark.slow
@settings(deadline=None, max_examples=200)
@given(
    utc=moments,
    late=st.integers(-900, 900),
    epoch=st.sampled_from([Epoch.UTC, Epoch.DAY, Epoch.GPS]),
    counted=st.sampled_from(["week", "gps", "unix", "day"]),
)
def test_readings_are_the_receivers_own_time(
    utc: int, late: int, epoch: Epoch, counted: str
) -> None:
    now = utc + late
    gps = now - GPS_ZERO + LEAPS
    reading = {"week": gps % WEEK, "gps": gps, "unix": now, "day": now % DAY}[counted]
    of_utc = counted in ("unix", "day")
    # What nobody can tell apart: a day of GPS time, and the first day of the week.
    if epoch is Epoch.GPS and of_utc:
        return
    if epoch is not Epoch.GPS and counted == "week" and reading <= DAY:
        return
    if epoch is Epoch.DAY and counted == "unix":
        return
    found, warnings = since_zero(np.array([reading + 0.25]), float(own_zero(utc, epoch)), epoch)
    expected = late + 0.25
    if epoch is Epoch.DAY or counted == "day":
        off = (float(found[0]) - expected + DAY / 2) % DAY - DAY / 2
    else:
        off = float(found[0]) - expected
    assert off == pytest.approx(0.0, abs=1e-6)
    ahead = epoch is not Epoch.GPS and not of_utc
    assert any("ahead of the receiver's own" in line for line in warnings) == ahead


def test_a_receiver_that_counts_for_itself_is_taken_at_its_word() -> None:
    found, warnings = since_zero(np.array([5.0]), 3.0, Epoch.LOCAL)
    assert found.tolist() == [5.0]
    assert warnings == ()
