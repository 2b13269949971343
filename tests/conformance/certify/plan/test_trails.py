"""Where a run was: on the axis of its profile, and with it where that is moved."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floatref.files import write_recording
from floatref.measures.locating.placement import Placement
from floatref.values.profile import Profile, ProfileTrack
from floatref_conformance.certify.plan.trails import STEP_M, Trail, place_trail, read_trail
from floatref_conformance.proving_ground import Scenario, simulate
from floatref_conformance.proving_ground.sensors.satellite import EARTH_RADIUS_M, START_RAD

RUN = Profile(0.5, (ProfileTrack.of("left", np.zeros(201)),), 10.0)


def trail_of_run() -> Trail:
    """Return a trail whose latitude is the distance from the start of `RUN`."""
    at = RUN.start_m + np.arange(0.0, RUN.length_m + 0.1, STEP_M)
    return Trail(at, at - RUN.start_m, np.zeros(at.size))


@given(
    reversed_=st.booleans(),
    offset_m=st.floats(-50.0, 50.0),
    factor=st.sampled_from([1.0, 0.3048]),
    at=st.integers(0, 200),
)
def test_a_place_keeps_to_its_point(reversed_, offset_m, factor, at) -> None:
    """Point ``at`` of the run lies where `apply_placement` lays it, and so does its place."""
    placement = Placement(True, 1.0, reversed=reversed_, offset_m=offset_m, distance_factor=factor)
    placed = place_trail(trail_of_run(), RUN, placement)
    assert (np.diff(placed.distance_m) > 0).all()
    index = 200 - at if reversed_ else at
    there = RUN.start_m * factor - offset_m + RUN.interval_m * factor * index
    if not placement.moves:
        there = RUN.start_m + RUN.interval_m * at
    found = np.interp(there, placed.distance_m, placed.latitude)
    assert found == pytest.approx(RUN.interval_m * at, abs=1e-6)


@pytest.mark.slow
def test_the_trail_of_a_recording_is_where_it_drove(tmp_path: Path) -> None:
    drive = Scenario(length_m=120.0, rate_hz=1000.0, imu=False, response=False)
    recording = simulate(drive).recording
    write_recording(recording, tmp_path / "run")
    profile = Profile(0.5, (ProfileTrack.of("left", np.zeros(161)),), 20.0)
    found = read_trail(tmp_path / "run", profile)
    assert found is not None
    assert found.within(20.0, 100.0)
    north = (np.radians(found.latitude) - START_RAD[0]) * EARTH_RADIUS_M
    assert np.abs(np.diff(north) - STEP_M).max() < 0.6
    assert abs(north[-1] - north[0] - 80.0) < 1.0
