"""What a brake that is not known leaves unsure lies about the brake."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.sdk.estimators.road_slope.test_stretches import drive_at, speeds, stop

from floatref.estimators.road_slope.constants import Places, SlopeModel
from floatref.estimators.road_slope.levelled import LOST_REACH_M, UNKNOWN_M, Levelled
from floatref.estimators.road_slope.readings import Drive
from floatref.estimators.road_slope.stretches import find_active, near_brakes

PLACES = Places(1.5, -1.5, 0.3)


def unsure_bins(drive: Drive, at: int) -> np.ndarray:
    """Return which bins have a sigma if the encoder is lost in the bin ``at``."""
    lost = np.arange(drive.speed.size) == at
    found = Levelled.of(drive._replace(lost=lost), PLACES, SlopeModel(), 105.91)
    assert not found.share.any()
    return found.sigma_m > 0.5 * UNKNOWN_M


@given(slow=st.floats(3.0, 9.0), braking=st.floats(2.0, 6.0), where=st.floats(0.1, 0.9))
def test_the_end_of_a_brake_is_unsure_however_long_the_vehicle_goes_on_as_slow(
    slow: float, braking: float, where: float
) -> None:
    """At the speed behind the brake the least is anywhere: rounding decides."""
    fast = 20.0
    braked_s = (fast - slow) / braking
    drive = drive_at(speeds((30, fast), (braked_s, slow), (60, slow)))
    noise = 1e-9 * np.sin(np.arange(drive.speed.size))
    drive = drive._replace(speed=drive.speed + noise)
    active = np.flatnonzero(find_active(drive))
    unsure = unsure_bins(drive, active[round(where * (active.size - 1))])
    assert unsure[active[-1]]
    distance = drive.distance[unsure]
    assert np.ptp(distance) <= 2 * LOST_REACH_M + 1.0


@given(braking=st.floats(1.0, 6.0), where=st.floats(0.1, 0.9))
def test_a_stop_is_unsure_about_its_standstill(braking: float, where: float) -> None:
    drive = drive_at(stop(15.0, braking, 3.0))
    active = np.flatnonzero(find_active(drive))
    unsure = unsure_bins(drive, active[round(where * (active.size - 1))])
    stood = np.flatnonzero(drive.speed < 0.01)
    assert unsure[[stood[0], stood[-1]]].all()


@given(braking=st.floats(1.0, 6.0))
def test_near_a_brake_is_the_brake_and_half_a_second(braking: float) -> None:
    drive = drive_at(stop(15.0, braking, 30.0))
    active, near = find_active(drive), near_brakes(drive)
    assert near[active].all()
    edges = np.flatnonzero(np.diff(near))
    assert all(np.abs(np.flatnonzero(active) - edge).min() <= 26 for edge in edges)
    assert not near_brakes(drive_at(np.full(2, 10.0))).any()
