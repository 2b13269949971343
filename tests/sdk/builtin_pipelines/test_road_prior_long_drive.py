"""Behind some kilometres the road prior is as good as at first, and keeps no more of the run."""

from functools import cache

import numpy as np
import pytest

from floatref.engine.run import run
from floatref.estimators.smoothing.backlog import Backlog
from floatref.measures import cross_correlation, high_pass, iri_trace
from floatref.values.profile import Profile
from floatref_conformance.proving_ground import Scenario, Simulation, simulate

pytestmark = pytest.mark.slow
STOPS_M = (900.0, 2100.0, 3300.0)
INTERVAL_M = 0.05
DRIVE = Scenario(
    seed=1,
    slip_percent_per_g=0.3,
    laser_ahead_m=0.0,
    road="sayers-asphalt-long-waves",
    iri_m_per_km=1.8,
    manoeuvre="stop",
    stops=3,
    stop_spacing_m=1200.0,
    event_at_m=STOPS_M[0],
    speed_kmh=60.0,
    final_speed_kmh=60.0,
    dwell_s=8.0,
    length_m=4400.0,
    rate_hz=1000.0,
    profile_interval_m=INTERVAL_M,
    tracks=("left",),
    imu=False,
    gnss=False,
)


@cache
def driven() -> tuple[Simulation, Profile, int]:
    """Return the drive, its profile, and how many segments were kept at most."""
    made, kept, ended = simulate(DRIVE), [0], Backlog._end_segment

    def watched(backlog: Backlog) -> None:
        ended(backlog)
        kept.append(len(backlog.lines["left"].segments))

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Backlog, "_end_segment", watched)
        return made, run(made.recording, "road-prior-smoother").profile, max(kept)


@pytest.mark.parametrize("stop_m", STOPS_M)
def test_every_stop_is_adequate(stop_m: float) -> None:
    made, profile, _ = driven()
    (track,) = profile.tracks
    encoder, motion = made.recording.channel("distance"), made.motion
    counted = np.interp(motion.times_s, encoder.times_s, encoder.values)
    points = encoder.values[0] + INTERVAL_M * np.arange(track.elevation.size)
    road = high_pass(np.interp(points, counted, motion.tracks["left"].road_m), INTERVAL_M)
    inside = slice(round((stop_m - 80.0) / INTERVAL_M), round((stop_m + 80.0) / INTERVAL_M))
    traces = (iri_trace(z, INTERVAL_M)[inside] for z in (road, track.elevation))
    found = cross_correlation(*traces, INTERVAL_M, 1.0)
    assert found.cross_correlation >= 0.97


def test_some_three_minutes_wait_and_no_more() -> None:
    made, _, kept = driven()
    seconds = made.recording.channel("distance").times_s[-1]
    assert seconds > 280.0
    assert kept * 4.096 < 190.0
