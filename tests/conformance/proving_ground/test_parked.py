"""The plates of the stationary tests, and how a parked vehicle's motion is made."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floatref_conformance.checks.stationary.parked_checks import BOUNCE, QUIESCENT
from floatref_conformance.proving_ground.drives.artificial import artificial_drive
from floatref_conformance.proving_ground.parked import APART_M, park, plates_of
from floatref_conformance.proving_ground.scenario import Scenario
from floatref_conformance.proving_ground.simulate import Simulation, stationary
from floatref_conformance.proving_ground.vehicles import motion

SCORED_END_M = max(check.end_m for check in (QUIESCENT, BOUNCE))


@pytest.fixture(scope="module", params=["quiescent", "bounce"])
def simulation(request: pytest.FixtureRequest) -> Simulation:
    return stationary(request.param, seed=3, rate_hz=2000.0)


@given(st.integers(0, 2**63 - 1), st.integers(1, 12))
@settings(deadline=None, max_examples=60)
def test_plates_lie_apart_clear_of_what_is_scored_and_of_the_ends(seed: int, count: int) -> None:
    tracks = tuple(f"track-{n}" for n in range(count))
    plates = plates_of(Scenario(seed=seed, tracks=tracks))
    assert tuple(plates) == tracks
    starts = sorted(plate.start_m for plate in plates.values())
    assert starts[0] - 2.0 - 91.44 > SCORED_END_M
    assert starts[-1] + 4.0 + 2.0 < artificial_drive().length_m - 106.0
    closest = np.diff(starts).min(initial=np.inf)
    assert closest > min(APART_M, 70.0 / count) - 0.011
    assert {plate.height_m for plate in plates.values()} == {0.005}
    assert all(2.0 <= plate.length_m <= 4.0 for plate in plates.values())


def test_plates_follow_from_the_seed_and_differ_between_seeds() -> None:
    drawn = [plates_of(Scenario(seed=seed)) for seed in range(40)]
    assert drawn[7] == plates_of(Scenario(seed=7, manoeuvre="bounce", rate_hz=4000.0))
    for name in ("left", "right"):
        assert len({plates[name].start_m for plates in drawn}) > 35
        assert len({plates[name].length_m for plates in drawn}) > 30
    assert len({plates["left"].start_m < plates["right"].start_m for plates in drawn}) == 2


def test_the_truth_is_flat_but_for_the_plate_of_its_wheel_path(simulation: Simulation) -> None:
    for name, plate in plates_of(Scenario(seed=3)).items():
        x, z = simulation.truth.distance_m, simulation.truth.track(name).elevation
        end = plate.start_m + plate.length_m
        assert np.abs(z[(x < plate.start_m - 0.02) | (x > end + 0.02)]).max() < 1e-12
        assert z[(x > plate.start_m + 0.04) & (x < end - 0.04)] == pytest.approx(0.005, abs=1e-12)


def test_each_laser_sees_the_plate_of_its_own_wheel_path_alone(simulation: Simulation) -> None:
    distance = simulation.recording.channel("distance").values
    plates = plates_of(Scenario(seed=3))
    for name in plates:
        height = simulation.recording.channel("height", name).values
        for other, plate in plates.items():
            middle = np.abs(distance - plate.start_m - plate.length_m / 2)
            top = height[middle < plate.length_m / 2 - 0.1].mean()
            beside = height[(middle > plate.length_m / 2 + 0.1) & (middle < 4.0)].mean()
            expected = 0.005 if other == name else 0.0
            assert beside - top == pytest.approx(expected, abs=3e-5)


@pytest.mark.parametrize("stretch", [999, 32_768])
def test_the_stretches_in_which_the_motion_is_made_change_no_bit(
    simulation: Simulation, stretch: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind = "bounce" if np.ptp(simulation.motion.pitch) > 0 else "quiescent"
    monkeypatch.setattr(motion, "STRETCH", stretch)
    again = stationary(kind, seed=3, rate_hz=2000.0)
    for one, other in zip(simulation.recording.channels, again.recording.channels, strict=True):
        np.testing.assert_array_equal(one.values, other.values)
    for track, other in zip(simulation.truth.tracks, again.truth.tracks, strict=True):
        np.testing.assert_array_equal(track.elevation, other.elevation)


def test_a_parked_motion_takes_little_more_than_it_holds() -> None:
    scenario = Scenario(seed=3, manoeuvre="quiescent", rate_hz=16000.0)
    # What is compiled and loaded first is not counted.
    park(Scenario(seed=3, manoeuvre="quiescent", rate_hz=1000.0))
    tracemalloc.start()
    try:
        held, _ = park(scenario)
        at_rest, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert held.distance.size > 500_000
    assert peak < 1.3 * at_rest
