"""What a pipeline calls valid is right: its rules on runs with known truth."""

import numpy as np
import pytest

import floatref
from floatref.measures import high_pass, iri_trace
from floatref_conformance.proving_ground.scenario import Scenario, scenario_of_run
from floatref_conformance.proving_ground.simulate import Simulation, simulate

pytestmark = pytest.mark.slow

NOMINAL = [name for name in floatref.pipelines() if not floatref.pipeline_capabilities(name)]
RUNS = (
    *("sg_1.1s_0.20g", "sg_2.1s_0.33g", "sg_5.8s_0.17g", "sg_10.7s_0.20g"),
    *("ns_72-11_0.20g", "brk_71-30_0.19g", "brk_49-20_0.25g", "brk_49-34_0.84g"),
)
THROUGH_STOPS = ("road-prior-smoother", "road-prior-smoother-spatial")
"""Pipelines that measure in brakes and at stops."""
UNSUPPRESSED = ("temporal-basic", "temporal-mean-removal", "spatial-basic", "spatial-hpf")
LONG = {
    "long mild brake": ("braking", 100.0, 20.0, 0.17),
    "long hard brake": ("braking", 100.0, 20.0, 0.55),
    "long mild near-stop": ("near-stop", 86.0, 8.0, 0.17),
    "long hard near-stop": ("near-stop", 100.0, 8.0, 0.4),
}
"""Manoeuvre, initial and event speed in km/h, deceleration in g."""


@pytest.fixture(scope="module", params=(*RUNS, *LONG))
def driven(request: pytest.FixtureRequest) -> Simulation:
    if request.param in RUNS:
        return simulate(scenario_of_run(request.param, 4, imu=False, gnss=False))
    manoeuvre, speed, event_speed, deceleration = LONG[request.param]
    return simulate(
        Scenario(
            seed=4,
            manoeuvre=manoeuvre,
            speed_kmh=speed,
            event_speed_kmh=event_speed,
            deceleration_g=deceleration,
            dwell_s=1.0,
            event_at_m=460.0,
            length_m=720.0,
            rate_hz=4000.0,
            imu=False,
            gnss=False,
        )
    )


def flagged_m(driven: Simulation, profile: floatref.Profile, track: int) -> float:
    """Flagged length in m beyond 53 m from the ends and where travel is below 16 km/h."""
    x = profile.distance_m
    speed = np.interp(x, driven.motion.distance, driven.motion.speed)
    inner = (x > x[0] + 53.0) & (x < x[-1] - 53.0) & (speed > 16 / 3.6)
    return float(np.count_nonzero(inner & ~profile.tracks[track].valid) * profile.interval_m)


@pytest.mark.parametrize("pipeline", NOMINAL)
def test_the_iri_of_valid_points_is_that_of_the_road(driven: Simulation, pipeline: str) -> None:
    profile = floatref.process(driven.recording, pipeline)
    interval = profile.interval_m
    for number, track in enumerate(profile.tracks):
        true = iri_trace(high_pass(driven.truth.track(track.name).elevation, interval), interval)
        ours = iri_trace(track.elevation, interval)
        count = min(true.size, ours.size)
        trusted = track.valid[:count]
        assert 0.15 < trusted.mean() < (0.95 if pipeline in THROUGH_STOPS else 0.8)
        right, found = (np.abs(z[:count][trusted]).mean() for z in (true, ours))
        assert abs(found - right) < max(0.05 * right, 0.1), (track.name, found, right)
        if pipeline not in UNSUPPRESSED:
            assert flagged_m(driven, profile, number) <= 110.0
