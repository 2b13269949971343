"""What the road prior makes of stops and brakes, against the road that was driven over.

The wheel hardly slips and the laser is at its accelerometer, as in edition 2026.1: the axis of
distance, which no profiler with one wheel knows better, is judged by tables of families.
"""

from collections.abc import Callable
from dataclasses import replace

import pytest

import floatref
from floatref.measures import agreement, high_pass, iri
from floatref_conformance.proving_ground import scenario_of_run, simulate
from floatref_conformance.proving_ground.scenario import FIRST_DEFAULTS

pytestmark = pytest.mark.slow

SECTION_M = (220.0, 380.9)
"""Where the dissertation's averages are taken, 100 m of run-in before its section."""


@pytest.fixture(scope="module")
def scored() -> Callable[[str, str], list[tuple[float, float]]]:
    """Return what tells cross correlation and IRI error in percent of both wheel paths."""

    def score(run: str, pipeline: str) -> list[tuple[float, float]]:
        scenario = scenario_of_run(run, 3, imu=False, gnss=False, **FIRST_DEFAULTS)
        simulation = simulate(replace(scenario, rate_hz=4000.0))
        found = []
        profile = floatref.process(simulation.recording, pipeline)
        inside = slice(*(round(end / profile.interval_m) for end in SECTION_M))
        for track in profile.tracks:
            true = simulation.truth.track(track.name).elevation
            expected = high_pass(true, profile.interval_m)[inside]
            ours = track.elevation[inside]
            alike = agreement(expected, ours, profile.interval_m).cross_correlation
            ratio = iri(ours, profile.interval_m) / iri(expected, profile.interval_m)
            found.append((alike, 100.0 * (ratio - 1.0)))
        return found

    return score


@pytest.mark.parametrize(
    "run", ["sg_2.1s_0.33g", "sg_10.7s_0.20g", "ns_72-11_0.20g", "brk_49-34_0.84g", "const_16"]
)
def test_it_measures_the_road_with_nominal_sensors(scored, run) -> None:
    """Where no suppression of chapter 5 reaches more than 0.9 at a stop."""
    for alike, iri_error in scored(run, "road-prior-smoother"):
        assert alike > 0.96
        assert abs(iri_error) < 3.0


def test_at_a_stop_suppression_does_not(scored) -> None:
    for alike, _ in scored("sg_2.1s_0.33g", "temporal-adaptive-hpf-spatial-backward"):
        assert alike < 0.92
